// What the hand of a simulated person does: the first rule that decides.

#include <algorithm>
#include <cmath>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {

constexpr double kOneSided = 0.8;    // of one motor over the other: very near at a side
constexpr double kTicksOver = 1.2;   // s; ticks that paused for so long are over
constexpr double kLeansAway = 0.07;  // rad, from what is felt at a side
constexpr double kTriesAfter = 1.0;  // s, without an answer
// Of a continuous display, as the lesson teaches it.
constexpr double kOnTheSpot = 0.8;   // rad
constexpr double kStillShown = 2.0;  // s; what is shown for so long after "stop" is followed again
// s, that speech adds to reactions: Mohebbi, Gray and Tan 2009, 16 people
constexpr double kTalkToEar = 0.148;
constexpr double kTalkToHand = 0.053;

StickAndButtons SimulatedOperator::act(double time, double dt) {
  static constexpr Rule kRules[] = {
      &SimulatedOperator::follow_display, &SimulatedOperator::wait, &SimulatedOperator::follow_ticks,
      &SimulatedOperator::turn,           &SimulatedOperator::drive, &SimulatedOperator::back};
  for (const Rule rule : kRules)
    if (const std::optional<StickAndButtons> hand = (this->*rule)(time, dt)) return *hand;
  // Where nobody speaks, nor answers, one tries.
  const bool unanswered = now_.asked > *now_.start && time - now_.asked > kTriesAfter;
  const bool led = now_.spoken_to || now_.told_to_halt || now_.shown >= *now_.start;
  if (now_.mode == Mode::waiting && unanswered && !led) now_.try_ahead();
  return {};
}

/// By a continuous sound, or the pulses of the motors: to where they show, as fast as they show,
/// and no faster than is liked. They are "go", too: after a word to stop one waits until they end
/// and come again, or go on all the same.
std::optional<StickAndButtons> SimulatedOperator::follow_display(double time, double dt) {
  const bool by_hand = config_.lead == "hand";
  if (!by_hand && config_.lead != "flow") return std::nullopt;
  if (by_hand)
    tracking_.show(pulses_.update(time), time);
  else
    tracking_.show(ears_.noisy(dt) ? std::nullopt : flow_, time);
  const double talk = !ears_.listen() ? 0.0 : by_hand ? kTalkToHand : kTalkToEar;
  const std::optional<Aim> aim = tracking_.update(time, dt, talk);
  if (!aim || now_.busy()) return std::nullopt;
  now_.mode = Mode::waiting;
  now_.news = now_.shown = time;
  if (now_.waits && *tracking_.since() < *now_.waits && time - *now_.waits < kStillShown)
    return StickAndButtons{};
  now_.waits.reset();
  now_.told_to_halt = false;
  if (attention_.elsewhere(time)) return held_;
  const DrivingConfig& driving = config_.driving;
  held_ = {};
  held_.left = driving_.stick_for(-tracking_.gain() * aim->turn / driving.kTurnRate);
  if (std::abs(aim->turn) < kOnTheSpot)
    held_.forward = driving_.stick_for(std::min(driving_.shaped(driving.cruise), aim->speed));
  return held_;
}

/// For "go on".
std::optional<StickAndButtons> SimulatedOperator::wait(double, double) {
  if (!now_.waits || now_.busy()) return std::nullopt;
  now_.mode = Mode::waiting;
  return StickAndButtons{};
}

/// A large turn is made on the spot, a small one on the way.
std::optional<StickAndButtons> SimulatedOperator::follow_ticks(double time, double) {
  if (now_.ticks && time - now_.ticks->last > kTicksOver) now_.ticks.reset();
  if (!now_.ticks || (now_.mode != Mode::turning && now_.mode != Mode::driving))
    return std::nullopt;
  now_.mode = Mode::driving;
  now_.course.target = now_.at.heading;
  now_.ticks_led = time;
  const double side = now_.ticks->side == Instruction::Side::left ? 1.0 : -1.0;
  const bool large = now_.ticks->much;
  StickAndButtons hand;
  hand.left = side * (large ? 1.0 : 0.55);
  if (large || now_.left() <= 0.0) return hand;
  hand.forward = (time < now_.careful_until ? 0.5 : 0.7) * config_.driving.kSlow;
  return hand;
}

std::optional<StickAndButtons> SimulatedOperator::turn(double, double dt) {
  if (now_.mode != Mode::turning) return std::nullopt;
  const double error = now_.course.target - now_.at.heading;
  if (std::abs(error) < std::max(0.02, 0.6 * config_.driving.kTurnRate * dt)) {
    now_.mode = Mode::driving;
    return std::nullopt;
  }
  StickAndButtons hand;
  hand.left = std::copysign(1.0, error);
  hand.forward = now_.course.turn_speed;
  return hand;
}

std::optional<StickAndButtons> SimulatedOperator::drive(double time, double) {
  if (now_.mode != Mode::driving) return std::nullopt;
  const Situation::Course& course = now_.course;
  if (now_.at.odometer >= course.stop_at) {
    now_.ask_soon(time);
    return std::nullopt;
  }
  StickAndButtons hand;
  // Near a corner the hand waits for the end of a sentence.
  if (ears_.listen() && now_.left() < Situation::kListenFirst) return hand;
  const double slow = config_.driving.kSlow;
  double speed = time < now_.careful_until ? std::min(course.speed, slow) : course.speed;
  if (now_.left() < Situation::kNearTheEnd) speed = std::min(speed, slow);
  const double both = std::min(felt_.left, felt_.right);
  const double strong = config_.feeling.kStrong;
  if (both > strong)
    speed = std::min(speed, slow * (1.0 - 0.5 * (both - strong) / std::max(0.05, 1.0 - strong)));
  double aim = course.target + (time < course.veer_until ? course.veer : 0.0);
  const double lean = felt_.left - felt_.right;
  if (std::abs(lean) > kOneSided) aim += lean > 0.0 ? -kLeansAway : kLeansAway;
  hand.forward = speed;
  const double error = aim - now_.at.heading;
  if (std::abs(error) > 0.04)
    hand.left = std::copysign(std::clamp(std::abs(error) * 1.5, 0.35, 0.6), error);
  return hand;
}

std::optional<StickAndButtons> SimulatedOperator::back(double time, double) {
  if (now_.mode != Mode::backing) return std::nullopt;
  StickAndButtons hand;
  hand.forward = -1.0;
  if (time >= now_.backs_until) now_.ask_soon(time);
  return hand;
}

}  // namespace navvi_people::people
