#include "cues/notice_cues.hpp"

namespace navvi_feedback::cues {

Utterances NoticeCues::update(const Situation& now, double time) {
  Utterances told;
  const std::set<CueKind> notices(now.notices.begin(), now.notices.end());
  for (const CueKind notice : notices) {
    if (noticed_.count(notice) > 0) continue;
    told.push_back({notice});
    told.back().fillings.person = now.person;
    if (family_of(notice) == Family::trial_end) trial_over_ = time;
  }
  noticed_ = notices;
  return told;
}

}  // namespace navvi_feedback::cues
