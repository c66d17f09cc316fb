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

  [[nodiscard]] Utterances update(const Tick& tick) {
    Utterances told;
    std::set<Content> notices(tick.now.notices.begin(), tick.now.notices.end());
    if (tick.asked.menu_closed) notices.insert({CueKind::menu_closed, About::menu_closed});
    for (const Content& notice : notices) {
      if (noticed_.count(notice) > 0) continue;
      told.push_back({notice});
      told.back().fillings.place_name = tick.now.zone;
      told.back().fillings.person = tick.now.devices.person;
      if (family_of(notice.kind) == Family::trial_end) trial_over_ = tick.time;
    }
    noticed_ = notices;
    return told;
  }

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
