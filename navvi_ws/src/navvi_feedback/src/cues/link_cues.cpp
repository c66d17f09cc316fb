#include "cues/link_cues.hpp"

#include <algorithm>
#include <utility>

namespace navvi_feedback::cues {

Content lost_stick(const Observation& now) {
  const auto& states = now.devices.states;
  if (std::count(states.begin(), states.end(), CueKind::pad_too_late) > 0)
    return CueKind::pad_too_late;
  return {CueKind::stick_lost, now.devices.keyboard ? About::keyboard : About::pad};
}

Content lost_robot(const Observation& now) {
  if (now.cut_off) return CueKind::connection_lost;
  return {CueKind::robot_lost, now.simulated ? About::simulator : About::odometry};
}

Link Flapping::judge(Link now, double time) {
  constexpr double kFlaps = 20.0;  // s; what comes back twice within it flaps.
  constexpr double kSteady = 5.0;  // s, of being alive, before what flaps counts as back.
  const bool comes_back = std::exchange(last_, now) == Link::lost && now == Link::alive;
  if (comes_back) flaps_ = time - std::exchange(back_, time) < kFlaps;
  const bool held = counts_ == Link::lost && now == Link::alive && flaps_;
  if (!held || time - back_ >= kSteady) counts_ = now;
  return counts_;
}

const Links& LinkCues::judge(const Observation& now, double time) {
  // s; what dies with the simulator may be missed by so much before it.
  constexpr double kTogether = 0.3;
  if (!first_) first_ = time;
  const bool waited = time - *first_ > patience_;
  const auto judged = [&](Link link) { return link == Link::never && waited ? Link::lost : link; };
  Links links = now.links;
  if (now.robotless) links = {links.pad, Link::alive, Link::alive, Link::alive, links.audio};
  if (links.proximity != Link::lost) sensed_ = time;
  const bool just_lost = links.proximity == Link::lost && time - sensed_ < kTogether;
  const Link near = just_lost ? Link::alive : judged(links.proximity);
  last_ = links_;
  links_ = {pad_.judge(judged(links.pad), time), judged(links.simulator),
            proximity_.judge(near, time), judged(links.guidance), audio_.judge(links.audio, time)};
  return links_;
}

Utterances LinkCues::update(const Observation& now) {
  Utterances told;
  const auto say = [&](const Content& content) { told.push_back({content}); };
  const auto lost = [&](Link Links::*link) {
    return last_.*link != Link::lost && links_.*link == Link::lost;
  };
  const auto back = [&](Link Links::*link) {
    return last_.*link == Link::lost && links_.*link == Link::alive;
  };
  // NoticeCues says of one that comes too late.
  if (lost(&Links::pad) && lost_stick(now) != CueKind::pad_too_late) say(lost_stick(now));
  const auto again = [&](About device) { say({CueKind::back, device}); };
  if (back(&Links::pad)) now.devices.keyboard ? again(About::keyboard) : say(CueKind::pad_back);
  if (lost(&Links::simulator)) say(lost_robot(now));
  if (lost(&Links::simulator)) cut_off_ = now.cut_off;
  if (back(&Links::simulator) && cut_off_) again(About::connection);
  if (back(&Links::audio)) again(About::audio);
  const bool simulated = links_.simulator != Link::lost;
  if (simulated && lost(&Links::proximity)) say(CueKind::proximity_lost);
  if (simulated && back(&Links::proximity)) say(CueKind::proximity_back);
  // Also where this guide replaces one that was lost, and never saw it run.
  const bool stopped =
      last_gate_.value_or(DriveState::State::running) == DriveState::State::running &&
      now.gate == DriveState::State::stopped;
  if (simulated && stopped && links_.pad != Link::lost) say(CueKind::robot_stopped);
  if (now.gate) last_gate_ = now.gate;
  return told;
}

}  // namespace navvi_feedback::cues
