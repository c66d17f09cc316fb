#include "navvi_feedback/core/feedback.hpp"

#include <algorithm>
#include <utility>

#include "navvi_feedback/haptics/rumble_output.hpp"

namespace navvi_feedback::core {
namespace {

constexpr double kLongestTick = 0.1;  // s; whoever was held up longer does not catch up

bool deflected(const drive::Stick& stick) { return stick.x != 0.0 || stick.y != 0.0; }

}  // namespace

void FeedbackConfig::describe(navvi_config::Visitor& visit) {
  visit(stale, "stale", navvi_config::Range{0.2, 10.0}, "s",
        "guidance, proximity or odometry older than this (wall clock) is lost");
  visit.group("drive", drive);
  visit.group("haptics", haptics);
  visit.group("cues", cues);
}

Feedback::Feedback(const FeedbackConfig& config, cues::Phrases phrases)
    : config_(config),
      drive_(config.drive),
      haptics_(config.haptics),
      policy_(config.cues, std::move(phrases)) {}

Feedback::Output Feedback::update(const Input& input, double time) {
  const double dt = std::clamp(time - last_update_.value_or(time), 0.0, kLongestTick);
  last_update_ = time;
  seen_hands_ = seen_hands_ || input.hands.live;
  Output out;
  out.command = drive(input.hands, dt);
  out.alarm_begins = alarm_begins(input, time);
  out.rumble = feel(time, dt);
  out.cues = policy_.update(situation(input, time), time);
  contacts_.clear();
  last_hands_ = input.hands;
  return out;
}

std::optional<Velocity> Feedback::drive(const drive::InputState& hands, double dt) {
  // A device that was opened anew between two ticks was lost between them.
  const bool live = hands.live && (!last_hands_.live || hands.session == last_hands_.session);
  const std::optional<Velocity> velocity =
      drive_.update(live ? std::optional<drive::Stick>(hands.stick()) : std::nullopt, dt);
  commanded_ = velocity.value_or(Velocity{});
  held_unarmed_ = live && !drive_.armed() && deflected(drive_.shaped(hands.stick()));
  // The last word of a lost stick is zero; after it, silence.
  return velocity || last_hands_.live ? std::optional(commanded_) : std::nullopt;
}

haptics::Rumble Feedback::feel(double time, double dt) {
  const bool fresh = nearby_.link(time, config_.stale) == cues::Link::alive &&
                     motion_.link(time, config_.stale) != cues::Link::lost;
  const haptics::Rumble near =
      haptics_.update(nearby_.value.value_or(std::vector<NearThing>{}), fresh, dt);
  const double alarm = alarm_since_ ? haptics::alarm_force(time - *alarm_since_) : 0.0;
  return {std::max(near.left, alarm), std::max(near.right, alarm)};
}

/// A missing audio device is told by what still works (safety rule 3), once there are motors.
bool Feedback::alarm_begins(const Input& input, double time) {
  if (input.audio == cues::Link::alive) {
    alarm_since_.reset();
  } else if (!alarm_since_ && input.motors) {
    alarm_since_ = time;
    return true;
  }
  return false;
}

cues::Situation Feedback::situation(const Input& input, double time) const {
  cues::Situation result;
  result.guidance = guidance_.value;
  result.goal_angle = input.goal_angle;
  result.guidance_link = guidance_.link(time, config_.stale);
  result.proximity_link = nearby_.link(time, config_.stale);
  result.simulator_link = motion_.link(time, config_.stale);
  if (result.proximity_link == cues::Link::alive) result.nearby = *nearby_.value;
  if (result.simulator_link == cues::Link::alive) result.measured = motion_.value;
  result.contacts = contacts_;
  result.commanded = commanded_;
  result.stick_held_unarmed = held_unarmed_;
  result.gate = gate_;
  result.pad_link = pad_link(input.hands);
  result.audio_link = input.audio;
  result.repeat_pressed = input.hands.button(0) && !last_hands_.button(0);
  result.goal_pressed = input.hands.button(1) && !last_hands_.button(1);
  result.voice_busy = input.voice_busy;
  result.notices = input.notices;
  return result;
}

cues::Link Feedback::pad_link(const drive::InputState& hands) const {
  if (hands.live) return cues::Link::alive;
  return seen_hands_ ? cues::Link::lost : cues::Link::never;
}

}  // namespace navvi_feedback::core
