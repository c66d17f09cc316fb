#pragma once

#include <optional>
#include <set>

#include "cues/phrases.hpp"
#include "cues/tick.hpp"

namespace navvi_feedback::cues {

/// Tells each notice when it comes, and knows since when the trial is over.
class NoticeCues {
 public:
  /// \param last_words  s, without directions after the end of a trial
  explicit NoticeCues(double last_words) : last_words_(last_words) {}

  [[nodiscard]] Utterances update(const Tick& tick);

  [[nodiscard]] bool trial_over() const { return trial_over_.has_value(); }
  /// And just now: the session may be about to end, too.
  [[nodiscard]] bool trial_just_over(double time) const {
    return trial_over_ && time - *trial_over_ < last_words_;
  }

 private:
  double last_words_;
  std::set<Content> noticed_;         ///< as of the last update
  std::optional<double> trial_over_;  ///< s
};

}  // namespace navvi_feedback::cues
