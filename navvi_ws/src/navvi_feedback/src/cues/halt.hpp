#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "cues/phrases.hpp"
#include "cues/situation.hpp"

namespace navvi_feedback::cues {

/// A word to stop holds until a person can have obeyed it and the way is clear again; then they are
/// told to go on. So no word to stop is left without its end.
class Halt {
 public:
  static constexpr double kObeyed = 2.0;  ///< s; a person hears the word, and lets go of the stick

  /// A word to stop was said.
  void say(const Utterance& words, double time);
  /// While it holds, more was said that is not to be contradicted at once.
  void repeat(double time);
  /// The voice has begun to say it.
  void heard(double time) {
    if (std::exchange(heard_, true))
      repeat(time);
    else if (said_)
      begin(time);
  }
  /// It was dropped.
  void not_heard() {
    if (!heard_) said_.reset();
  }
  /// \param follows  there is a path to be followed now
  /// \param comes  something will soon reach the robot
  /// \return whether the word still holds
  [[nodiscard]] bool update(const Situation& now, bool follows, bool comes, double time);
  /// Once the word no longer holds: that the person may go on, with the direction, or alone if
  /// there is none soon, or a sound leads.
  [[nodiscard]] std::vector<Utterance> go_on(std::vector<Utterance> directions, bool sound,
                                             double time);
  /// There is no path on which to go on.
  void forget() {
    said_.reset();
    over_since_.reset();
  }

  [[nodiscard]] bool halted() const { return said_.has_value(); }
  /// A person has not obeyed it yet.
  [[nodiscard]] bool fresh(double time) const { return said_ && time - *said_ < kObeyed; }
  /// What was said, while halted.
  [[nodiscard]] const Utterance& words() const { return words_; }

 private:
  void begin(double time) { said_ = last_ = time; }

  Utterance words_;
  std::optional<double> said_;  ///< s
  double last_ = 0.0;           ///< s, when it was said last
  bool heard_ = false;
  std::optional<double> clear_since_;  ///< s
  std::optional<double> over_since_;   ///< s, until that is said
};

}  // namespace navvi_feedback::cues
