#include "cues/notice_cues.hpp"

namespace navvi_feedback::cues {

Utterances NoticeCues::update(const Tick& tick) {
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

}  // namespace navvi_feedback::cues
