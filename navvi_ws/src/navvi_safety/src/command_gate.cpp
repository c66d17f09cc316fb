#include "navvi_safety/command_gate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace navvi_safety {
namespace {

bool within(double value, double limit) { return std::isfinite(value) && std::abs(value) <= limit; }

/// True if at most `span`, s, lies between the two on both clocks. False if time ran backwards.
bool younger_than(double span, const Instant& then, const Instant& now) {
  const auto young = [span](double from, double to) { return to >= from && to - from <= span; };
  return young(then.wall, now.wall) && young(then.sim, now.sim);
}

}  // namespace

void CommandGateConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(timeout, "timeout", Range{0.05, 0.25}, "s",
        "longest age of the last valid command, by wall clock and by sim clock");
  visit(max_linear, "max_linear", Range{0.1, 3.0}, "m/s", "commands beyond are clamped");
  visit(max_angular, "max_angular", Range{0.1, 6.0}, "rad/s", "commands beyond are clamped");
  visit(foresight, "foresight", navvi_config::Any{}, "",
        "guidance is ahead of the robot by the measured delay of the connection, where that is "
        "felt, and speed is limited by it");
  visit(assistance, "assistance", navvi_config::OneOf{{"off", "stop", "steer"}}, "",
        "before what the robot would hit: leave the command as it is, slow it to a stop, or bend "
        "it away, too, never against the person's turn and never faster");
  visit(driver, "driver", navvi_config::Any{}, "",
        "the node whose commands are taken, such as /feedback_node; those of any other are ignored "
        "and announced; empty: any node may drive, one at a time");
}

bool CommandGate::admit(const std::string& node, unsigned link) {
  if (!config_.driver.empty() && node != config_.driver) {
    intruder_ = node;
    return false;
  }
  if (link_ && link != *link_) {
    stop(Reason::driver_changed);
    if (link < latest_link_) intruder_ = node;  // the later link has not replaced this one
  }
  link_ = link;
  latest_link_ = std::max(latest_link_, link);
  return true;
}

void CommandGate::receive(const Command& command, const Instant& now) {
  expire(now);
  const auto& velocity = command.velocity;
  if (!velocity || !within(velocity->linear, config_.max_linear * config_.kAbsurdFactor) ||
      !within(velocity->angular, config_.max_angular * config_.kAbsurdFactor) ||
      !(command.age >= -config_.kAhead)) {
    ++rejected_;
    bad_since_valid_ = true;
    return;
  }
  if (link_meter_.overtaken(command.seq)) return;
  const LinkMeter::Late late = link_meter_.lateness(command.age);
  link_meter_.add(command.age, command.seq, now.wall);
  if (late == LinkMeter::Late::too_late) return;
  command_.linear = std::clamp(velocity->linear, -config_.max_linear, config_.max_linear);
  command_.angular = std::clamp(velocity->angular, -config_.max_angular, config_.max_angular);

  const bool neutral = std::abs(command_.linear) <= config_.kNeutralLinear &&
                       std::abs(command_.angular) <= config_.kNeutralAngular;
  if (!neutral) {
    neutral_since_.reset();
  } else if (!neutral_since_) {
    neutral_since_ = now;
  }
  if (late == LinkMeter::Late::slow) {
    command_.linear *= config_.kLateShare;
    command_.angular *= config_.kLateShare;
  }
  last_valid_ = now;
  bad_since_valid_ = false;
}

navvi_types::LinkState CommandGate::link_state(std::int64_t stamp) const {
  constexpr double kFelt = 0.1, kMost = 3.0;  // s
  navvi_types::LinkState state = link_meter_.state(stamp);
  if (config_.foresight && state.round_trip >= kFelt)
    state.foresight = std::min(state.round_trip, kMost);
  return state;
}

bool CommandGate::outrun(const Instant& now) const {
  return state_ == State::running && last_valid_ &&
         now.wall - last_valid_->wall <= config_.timeout &&
         now.sim - last_valid_->sim > 0.9 * config_.timeout;
}

void CommandGate::stop(Reason reason) {
  last_valid_.reset();
  if (state_ == State::waiting && reason != Reason::emergency_stop) return;
  state_ = State::stopped;
  reason_ = reason;
}

navvi_types::Velocity CommandGate::update(const Instant& now) {
  turned_ += wheels_.angular * std::clamp(now.sim - updated_, 0.0, config_.timeout);
  updated_ = now.sim;
  navvi_types::Velocity wheels = assistance_.assist(held_or_driven(now), now.sim);
  const bool unknown = zone_at_ && !younger_than(config_.kZoneStale, *zone_at_, now);
  const double most = unknown ? config_.kZoneLost : navvi_types::kFastest;
  double ahead = zone_.forward, behind = zone_.backward;
  if (std::cos(turned_) < 0.0) std::swap(ahead, behind);
  wheels.linear = std::clamp(wheels.linear, -std::min(behind, most), std::min(ahead, most));
  wheels.angular = std::clamp(wheels.angular, -config_.max_angular, config_.max_angular);
  return wheels_ = wheels;
}

navvi_types::Velocity CommandGate::held_or_driven(const Instant& now) {
  expire(now);
  if (state_ != State::running) {
    const bool held = neutral_since_ && now.wall - neutral_since_->wall >= config_.kNeutralHold &&
                      now.sim - neutral_since_->sim >= config_.kNeutralHold;
    if (!held) return {};
    state_ = State::running;
    reason_ = Reason::none;
  }
  return command_;
}

void CommandGate::expire(const Instant& now) {
  if (last_valid_ && younger_than(config_.timeout, *last_valid_, now)) return;
  const bool back = last_valid_ && now.sim < last_valid_->sim;
  neutral_since_.reset();
  if (state_ == State::running)
    stop(back               ? Reason::clock_jumped
         : bad_since_valid_ ? Reason::command_invalid
                            : Reason::command_lost);
}

}  // namespace navvi_safety
