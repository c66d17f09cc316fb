#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// The rule that is taught: after "stop" or "wait" a person stays until "go on". One state,
/// waiting, and one way out of it: a sentence that says "go on" with the direction, heard to its
/// end. Nobody knows whether it was understood: it is owed, and each direction says it, until the
/// person drives. A new route, a new goal or a lost link changes nothing.
class Halt {
 public:
  static constexpr double kObeyed = 2.0;  ///< s; a person hears the word, and lets go of the stick

  /// \param again  s, after which "go on" is said again to a person who stands
  explicit Halt(double again) : again_(again) {}

  /// A word to stop is about to be said.
  void say(const Utterance& words, double time);
  /// More was said that is not to be contradicted at once.
  void repeat(double time);
  /// The sentence that says "go on" is about to be said.
  void release(const std::string& text);
  /// "Go on" needs no words: what leads comes again. To a person who does not drive then, it is
  /// owed in words as soon as words lead.
  void end(double time);
  /// Takes note of what became of these words.
  /// \param replaced  another word of the kind is said instead
  void note(const CueEvent& event, bool replaced, double time);

  /// Call it at each update. \param follows  there is a path to be followed now
  /// \param comes  something would soon reach the robot
  /// \return whether "go on" is due
  [[nodiscard]] bool over(const Observation& now, bool follows, bool comes, double time);

  [[nodiscard]] bool halted() const { return state_ == State::waiting; }
  /// Nothing speaks against "go on" any more: it is due within a few seconds.
  [[nodiscard]] bool ends_soon() const { return halted() && clear_since_; }
  /// The person has not driven since "go on" was said to its end.
  [[nodiscard]] bool owes() const { return state_ != State::free; }
  /// s, when a person who waits was told to; nullopt: nobody waits
  [[nodiscard]] std::optional<double> told() const {
    return halted() ? std::optional(said_) : std::nullopt;
  }
  /// A person has not obeyed it yet.
  [[nodiscard]] bool fresh(double time) const { return halted() && time - said_ < kObeyed; }
  [[nodiscard]] const Utterance& words() const { return words_; }

 private:
  enum class State {
    free,
    waiting,   ///< for "go on"
    released,  ///< that is being said
    told,      ///< it was, and the person has not driven since
  };

  double again_;  ///< s
  State state_ = State::free;
  State before_ = State::free;  ///< it was released
  Utterance words_;
  int due_ = 0;          ///< words to stop that the voice has not begun yet
  bool heard_ = false;   ///< the voice has begun a word to stop since the person was free
  bool begun_ = false;   ///< and the last of them
  double said_ = 0.0;    ///< s, when that was said
  double last_ = 0.0;    ///< s, when it was said last, or "go on" was
  std::string release_;  ///< the sentence that says "go on"
  std::optional<std::uint32_t> release_id_;  ///< its cue, once it is queued
  std::optional<double> led_since_;          ///< s, there is a path to be followed
  std::optional<double> clear_since_;        ///< s, and nothing that speaks against it
};

}  // namespace navvi_feedback::cues
