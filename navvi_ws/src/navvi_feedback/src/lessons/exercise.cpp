#include "lessons/exercise.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>

#include "lessons/guide_exercises.hpp"

namespace navvi_feedback::lessons {
namespace {

using drive::Button;

constexpr double kDegree = navvi_types::radians(1.0);
constexpr double kStill = 0.03;   // m/s and rad/s
constexpr double kSettled = 0.4;  // s, of standing, before a try is judged
constexpr double kTurnError = 15.0 * kDegree;
constexpr double kClick = 1.2;      // s, from one to the next
constexpr double kNearGap = 0.3;    // m
constexpr double kDeflected = 0.4;  // of the stick, to be an answer

/// Straight on.
struct DriveExercise {
  double amount;  ///< m
  Word enough = {};

  Verdict operator()(const Instant& now) {
    const Moved& moved = now.moved;
    if (std::abs(moved.turned) > kAstray) return {false, "crooked"};
    if (moved.driven < -kBack) return {false, "back"};
    if (amount > 1.0 && moved.driven >= amount && !neutral(now.seen.stick))
      enough.tell(now, "enough");
    if (!now.settled() || moved.driven < 0.03) return {};
    return moved.driven >= amount ? Verdict{true} : Verdict{false, "short"};
  }
};

/// Let go at the word.
struct HaltExercise {
  double within;  ///< s
  WordInMotion motion;
  Word stop = {};

  Verdict operator()(const Instant& now) {
    stop.observe(now);
    if (now.moved.driven < -kBack) return {false, "back"};
    if (motion.due(now)) stop.tell(now, "stop");
    if (!stop.heard())
      return now.settled() && now.moved.driven > 0.05 ? Verdict{false, "early"} : Verdict{};
    if (neutral(now.seen.stick)) return {true};
    return now.time - *stop.heard() > within ? Verdict{false, "late"} : Verdict{};
  }
};

struct TurnExercise {
  double target;  ///< rad, clockwise
  Word stop = {};

  Verdict operator()(const Instant& now) {
    const double turned = now.moved.turned, off = target + turned;
    count_down(now, off, target, stop);
    if (std::abs(now.moved.driven) > 0.5) return {false, "driven"};
    if (turned * target > 0.0 && std::abs(turned) > kAstray) return {false, "side"};
    if (std::abs(turned) < 0.1 || !now.settled()) return {};
    if (std::abs(off) <= kTurnError) return {true};
    return {false, off * target < 0.0 ? "too_far" : "too_little"};
  }
};

/// Follow a display that lasts to a place.
struct FollowExercise {
  static constexpr double kWay = 1.5;        // m
  static constexpr double kThere = 0.4;      // m
  static constexpr double kPatience = 40.0;  // s

  Lead by;
  double aside;                      ///< rad, clockwise, to the place
  std::optional<double> begun = {};  ///< s
  bool arrived = false;

  Verdict operator()(const Instant& now) {
    const Eigen::Vector2d place(kWay * std::cos(aside), -kWay * std::sin(aside));
    const Eigen::Vector2d left = place - now.moved.to;
    if (left.norm() < kThere) {
      arrived = true;
      return now.settled() ? Verdict{true} : Verdict{};
    }
    if (!begun) begun = now.time;
    if (arrived || left.norm() > 1.5 * kWay || now.time - *begun > kPatience)
      return {false, "place"};
    const double off = navvi_types::wrap(-std::atan2(left.y(), left.x()) + now.moved.turned);
    const double speed = std::max(0.0, 0.5 * (1.0 - std::abs(off) / lead::kOnTheSpot));
    now.taught.course = Shown{{off, speed}, by};
    return {};
  }
};

/// Tell on which side something is near.
struct SideExercise {
  cues::Side side;
  std::optional<double> clicked = {};  ///< s

  Verdict operator()(const Instant& now) {
    if (!clicked && now.seen.voice_busy) return {};
    navvi_types::NearThing thing;
    thing.thing_class = navvi_types::ThingClass::box;
    thing.gap = kNearGap;
    thing.nearest = 2.0 * cues::direction_of(side);
    now.taught.near.push_back(thing);
    if (!clicked || now.time - *clicked > kClick) {
      clicked = now.time;
      if (now.seen.audible)
        now.taught.plays.push_back({sounds::Earcon::shelf_near, cues::direction_of(side), 0.8});
    }
    const drive::Stick& stick = now.seen.stick;
    if (std::max(std::abs(stick.x), std::abs(stick.y)) < kDeflected) return {};
    if (cues::side_of({stick.y, stick.x}) == side) return {true};
    return {false, side == cues::Side::left    ? "was_left"
                   : side == cues::Side::right ? "was_right"
                                                : "was_ahead"};
  }
};

struct PressExercise {
  Button wanted;

  Verdict operator()(const Instant& now) const {
    for (const Button button : now.seen.pressed)
      if (button <= Button::help && button != Button::repeat)
        return button == wanted ? Verdict{true} : Verdict{false, "button"};
    return {};
  }
};

struct GoalExercise {
  bool begun = false;

  Verdict operator()(const Instant& now) {
    const bool runs = now.seen.trial == TrialState::State::running;
    begun = begun || runs;
    if (begun && now.seen.arrived()) return {true};
    return begun && !runs ? Verdict{false, "no_goal"} : Verdict{};
  }
};

}  // namespace

bool stands(const Observation& seen) {
  return neutral(seen.stick) && std::abs(seen.motion().linear) < kStill &&
         std::abs(seen.motion().angular) < kStill;
}

std::string tutorial_key(const std::string& name) { return "tutorial_" + name; }

void Moved::observe(const Observation& seen, double dt, double time) {
  const double step = seen.motion().linear * dt;
  driven += step;
  to += step * Eigen::Vector2d(std::cos(turned), std::sin(turned));
  turned += seen.motion().angular * dt;
  still = since_when(stands(seen), still, time);
}

bool Instant::settled() const { return moved.still && time - *moved.still >= kSettled; }

Exercise begin_exercise(const Step& step, int tries) {
  switch (step.task) {
    case Task::drive:
      return DriveExercise{step.amount};
    case Task::halt:
      return HaltExercise{step.amount, WordInMotion(tries)};
    case Task::wait:
      return begin_wait(step, tries);
    case Task::back_away:
      return begin_back_away(step);
    case Task::turn:
      return TurnExercise{step.amount * kDegree};
    case Task::by_sound:
      return FollowExercise{Lead::flow, step.amount * kDegree};
    case Task::by_hand:
      return FollowExercise{Lead::hand, step.amount * kDegree};
    case Task::make_room:
      return begin_make_room(step);
    case Task::side:
      return SideExercise{step.side};
    case Task::press:
      return PressExercise{step.button};
    case Task::goal:
      break;
  }
  return GoalExercise{};
}

}  // namespace navvi_feedback::lessons
