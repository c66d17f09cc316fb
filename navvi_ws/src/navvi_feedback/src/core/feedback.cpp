#include "navvi_feedback/core/feedback.hpp"

#include <algorithm>

#include "cues/cue_policy.hpp"
#include "navvi_feedback/haptics/rumble_output.hpp"

namespace navvi_feedback::core {
namespace {

constexpr double kLongestTick = 0.1;  // s; a longer delay is not made up for

bool deflected(const drive::Stick& stick) { return stick.x != 0.0 || stick.y != 0.0; }

}  // namespace

void FeedbackConfig::describe(navvi_config::Visitor& visit) {
  visit(stale, "stale", navvi_config::Range{0.2, 10.0}, "s",
        "guidance, proximity or odometry older than this (wall clock) is lost");
  visit.group("drive", drive);
  visit.group("haptics", haptics);
  visit.group("cues", cues);
}

struct Feedback::Deciders {
  drive::Drive drive;
  haptics::Haptics haptics;
  cues::CuePolicy cues;
};

Feedback::Feedback(const FeedbackConfig& config, const std::filesystem::path& phrases)
    : config_(config),
      deciders_(new Deciders{
          drive::Drive(config.drive), haptics::Haptics(config.haptics),
          cues::CuePolicy(config.cues, cues::Phrases(phrases, config.cues.words()))}) {}

Feedback::~Feedback() = default;

void Feedback::note(const std::vector<CueEvent>& events) { deciders_->cues.note(events); }

Feedback::Output Feedback::update(const Input& input, double time) {
  const double dt = std::clamp(time - last_update_.value_or(time), 0.0, kLongestTick);
  last_update_ = time;
  seen_hands_ = seen_hands_ || input.hands.live;
  Output out;
  out.command = drive(input.hands, dt);
  out.alarm_begins = alarm_begins(input, time);
  out.rumble = feel(time, dt);
  out.cues = decide_cues(input, time);
  contacts_.clear();
  last_hands_ = input.hands;
  return out;
}

std::optional<Velocity> Feedback::drive(const drive::InputState& hands, double dt) {
  // A device that was opened anew between two ticks was lost between them.
  const bool live = hands.live && (!last_hands_.live || hands.session == last_hands_.session);
  const std::optional<Velocity> velocity =
      deciders_->drive.update(live ? std::optional<drive::Stick>(hands.stick()) : std::nullopt, dt);
  commanded_ = velocity.value_or(Velocity{});
  held_unarmed_ =
      live && !deciders_->drive.armed() && deflected(deciders_->drive.shaped(hands.stick()));
  // The last command of a lost stick is zero; none follows it.
  return velocity || last_hands_.live ? std::optional(commanded_) : std::nullopt;
}

haptics::Rumble Feedback::feel(double time, double dt) {
  const bool fresh = nearby_.link(time, config_.stale) == cues::Link::alive &&
                     motion_.link(time, config_.stale) != cues::Link::lost;
  const haptics::Rumble near =
      deciders_->haptics.update(nearby_.value.value_or(std::vector<NearThing>{}), fresh, dt);
  const double alarm = alarm_since_ ? haptics::alarm_force(time - *alarm_since_) : 0.0;
  return {std::max(near.left, alarm), std::max(near.right, alarm)};
}

/// The motors report a missing audio device (safety rule 3), once there are any.
bool Feedback::alarm_begins(const Input& input, double time) {
  if (input.audio == cues::Link::alive) {
    alarm_since_.reset();
  } else if (!alarm_since_ && input.motors) {
    alarm_since_ = time;
    return true;
  }
  return false;
}

std::vector<cues::Cue> Feedback::decide_cues(const Input& input, double time) {
  cues::Situation now;
  now.guidance = guidance_.value;
  now.goal_angle = input.goal_angle;
  const auto link = [&](const auto& latest) { return latest.link(time, config_.stale); };
  now.links = {pad_link(input.hands), link(motion_), link(nearby_), link(guidance_), input.audio};
  if (now.links.proximity == cues::Link::alive) now.nearby = *nearby_.value;
  if (now.links.simulator == cues::Link::alive) now.measured = motion_.value;
  now.keyboard = input.keyboard;
  now.contacts = contacts_;
  now.commanded = commanded_;
  now.stick_held_unarmed = held_unarmed_;
  now.gate = gate_;
  now.repeat_pressed = input.hands.button(0) && !last_hands_.button(0);
  now.goal_pressed = input.hands.button(1) && !last_hands_.button(1);
  now.voice_busy = input.voice_busy;
  now.notices = input.notices;
  return deciders_->cues.update(now, time);
}

cues::Link Feedback::pad_link(const drive::InputState& hands) const {
  if (hands.live) return cues::Link::alive;
  return seen_hands_ ? cues::Link::lost : cues::Link::never;
}

}  // namespace navvi_feedback::core
