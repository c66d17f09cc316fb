#pragma once

#include <map>
#include <string>
#include <vector>

#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Puts what is to be told into words, sounds or touch: not too soon after the same kind, and not
/// in the same words twice within some seconds.
class Phrasing {
 public:
  /// \param same_text  s, within which the same words are not said twice
  Phrasing(Phrases phrases, double same_text)
      : phrases_(std::move(phrases)), plates_(phrases_), same_text_(same_text) {
    use(phrases_.wording());
  }

  void use(const WordingConfig& wording);

  /// \return the most urgent first
  [[nodiscard]] std::vector<Cue> cues_of(const std::vector<Utterance>& utterances,
                                         const Observation& now, double time);
  /// As it stands in the picture: the way in few words, all else as it is said.
  [[nodiscard]] std::string shown(const Utterance& utterance) const;
  /// It would not be said now.
  [[nodiscard]] bool too_soon(const Content& content, double time) const {
    return last_said_.too_soon(content, time);
  }
  /// s, when "straight ahead" was last said
  [[nodiscard]] double straight_said() const { return straight_said_; }

  void heard(const CueEvent& event, double time) { last_text_[event.text] = {time, time}; }
  /// It was not heard, and may be said at once.
  void forget(const CueEvent& event);

 private:
  static constexpr double kNever = -1e9;  ///< s

  struct Times {
    double last = kNever;    ///< s, when it was decided last, or heard
    double before = kNever;  ///< s, before that
  };
  struct Sentence {
    std::string text;
    std::vector<sounds::Play> scan;  ///< of its parts
  };
  [[nodiscard]] Sentence word(const Utterance& whole, bool again) const;
  [[nodiscard]] Utterance shortened(Utterance around) const;

  Phrases phrases_;
  Phrases plates_;  ///< likewise, in few words
  double same_text_;
  LastSaid last_said_;
  std::map<std::string, Times> last_text_;  ///< by text
  double straight_said_ = kNever;           ///< s
};

}  // namespace navvi_feedback::cues
