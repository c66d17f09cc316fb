#include "navvi_nav/hold.hpp"

namespace navvi_nav {
namespace {

/// Neither going on nor waiting is safe.
bool evades(const Way& way) { return way.hits_waiting && std::isfinite(way.hits_in); }

}  // namespace

void HoldConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"hold_time", Range{0.0, 60.0}, "s",
         "a path cut by moving things is kept so long at most; 0: never kept"},
        hold_time);
  visit({"hold_choice", Range{0.0, 60.0}, "s",
         "a path that was chosen because of what moves is kept so long at least, if nothing is run "
         "into within as long"},
        hold_choice);
  visit({"hold_meeting", Range{0.0, 60.0}, "s",
         "what comes along the path is evaded only when it is so close: it may turn off"},
        hold_meeting);
  visit({"hold_detour", Range{0.0, 100.0}, "m",
         "nobody is led round farther than this for what moves while the path may be kept"},
        hold_detour);
  visit({"wait_distance", Range{0.0, 100.0}, "m",
         "nearer than this a person is told to wait for what crosses, or closes the only way"},
        wait_distance);
}

bool Hold::goes_on(double time, bool held) {
  if (!held) {
    since_.reset();
    return false;
  }
  if (!since_) since_ = time;
  return time - *since_ < config_.hold_time;
}

void Hold::reset() {
  since_.reset();
  chosen_.reset();
}

bool Hold::is_far(const Way& way) const {
  return config_.hold_time > 0.0 && way.state == Way::State::comes &&
         way.meets_in > config_.hold_meeting;
}

bool Hold::waits(double time, const Way& way) {
  if (is_far(way)) return true;
  if (way.state == Way::State::clears || rests(way)) return goes_on(time, true) && !evades(way);
  if (way.state != Way::State::comes) since_.reset();
  return false;
}

bool Hold::keeps(double time, const Choice& followed, const Choice& fresh) {
  const Way& way = followed.way;
  const bool safer = evades(way) && fresh.path.size() >= 2 && fresh.way.hits_in > way.hits_in;
  if (is_far(way)) return true;
  const bool far_round = way.state == Way::State::comes &&
                         length_of(fresh.path) > length_of(followed.path) + config_.hold_detour;
  const bool passes = way.state == Way::State::clears || rests(way) || far_round;
  if (goes_on(time, passes && !safer)) return true;
  if (config_.hold_time <= 0.0 || way.hits_in <= config_.hold_choice) return false;
  const bool just_chosen = chosen_ && time - *chosen_ < config_.hold_choice;
  return just_chosen || (fresh.path.size() >= 2 && fresh.way.hits_in <= config_.hold_choice);
}

/// Who waits for something that runs into nobody who waits.
bool Hold::rests(const Way& way) const { return must_wait(way) && !way.hits_waiting; }

bool Hold::must_wait(const Way& way) const {
  return config_.hold_time > 0.0 && way.wait && is_near(way.wait->at);
}

}  // namespace navvi_nav
