#pragma once

#include <optional>
#include <set>
#include <utility>

#include "cues/phrasing.hpp"
#include "cues/tick.hpp"

namespace navvi_feedback::cues {

/// Tells each notice when it comes, or, while it was told too short a time ago, a little later if
/// it lasts; and knows since when the trial is over, until the next one runs.
class NoticeCues {
 public:
  /// \param last_words  s, without directions after the end of a trial
  explicit NoticeCues(double last_words) : last_words_(last_words) {}

  [[nodiscard]] Utterances update(const Tick& tick, const Phrasing& phrasing) {
    Utterances told;
    std::set<Content> notices(tick.now.notices.begin(), tick.now.notices.end());
    if (tick.asked.menu_closed) notices.insert({CueKind::menu_closed, About::menu_closed});
    const std::set<Content> noticed = std::exchange(noticed_, {});
    const bool ran = std::exchange(runs_, tick.now.trial == TrialState::State::running);
    if (runs_ && !ran) trial_over_.reset();
    for (const Content& notice : notices) {
      const bool known = noticed.count(notice) > 0;
      if (!known && family_of(notice.kind) == Family::trial_end) trial_over_ = tick.time;
      if (!known && phrasing.too_soon(notice, tick.time)) continue;
      noticed_.insert(notice);
      if (known) continue;
      told.push_back({notice});
      told.back().fillings.place_name = tick.now.zone;
      told.back().fillings.person = tick.now.devices.person;
    }
    return told;
  }

  [[nodiscard]] bool trial_over() const { return trial_over_.has_value(); }
  /// And just now: the session may be about to end, too.
  [[nodiscard]] bool trial_just_over(double time) const {
    return trial_over_ && time - *trial_over_ < last_words_;
  }

 private:
  double last_words_;
  std::set<Content> noticed_;         ///< told, and there at the last update
  bool runs_ = false;                 ///< a trial did, likewise
  std::optional<double> trial_over_;  ///< s
};

}  // namespace navvi_feedback::cues
