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

/// Straight on for `amount` m.
class DriveExercise : public Exercise {
 public:
  explicit DriveExercise(const Step& step) : amount_(step.amount) {}
  Verdict judge(const Instant& now) override {
    const Moved& moved = now.moved;
    if (std::abs(moved.turned) > kAstray) return {false, "crooked"};
    if (moved.driven < -kBack) return {false, "back"};
    if (amount_ > 1.0 && moved.driven >= amount_ && !neutral(now.seen.stick))
      enough_.tell(now, "enough");
    if (!now.settled() || moved.driven < 0.03) return {};
    return moved.driven >= amount_ ? Verdict{true} : Verdict{false, "short"};
  }

 private:
  double amount_;
  Word enough_;
};

/// Let go within `amount` s of the word.
class HaltExercise : public Exercise {
 public:
  HaltExercise(const Step& step, int tries) : amount_(step.amount), motion_(tries) {}
  Verdict judge(const Instant& now) override {
    stop_.observe(now);
    if (now.moved.driven < -kBack) return {false, "back"};
    if (motion_.due(now)) stop_.tell(now, "stop");
    if (!stop_.heard())
      return now.settled() && now.moved.driven > 0.05 ? Verdict{false, "early"} : Verdict{};
    if (neutral(now.seen.stick)) return {true};
    return now.time - *stop_.heard() > amount_ ? Verdict{false, "late"} : Verdict{};
  }

 private:
  double amount_;
  WordInMotion motion_;
  Word stop_;
};

/// By `amount` degrees clockwise.
class TurnExercise : public Exercise {
 public:
  explicit TurnExercise(const Step& step) : target_(step.amount * kDegree) {}
  Verdict judge(const Instant& now) override {
    const double turned = now.moved.turned, off = target_ + turned;
    count_down(now, off, target_, stop_);
    if (std::abs(now.moved.driven) > 0.5) return {false, "driven"};
    if (turned * target_ > 0.0 && std::abs(turned) > kAstray) return {false, "side"};
    if (std::abs(turned) < 0.1 || !now.settled()) return {};
    if (std::abs(off) <= kTurnError) return {true};
    return {false, off * target_ < 0.0 ? "too_far" : "too_little"};
  }

 private:
  double target_;
  Word stop_;
};

/// Follow a display that lasts to a place `amount` degrees clockwise.
class FollowExercise : public Exercise {
 public:
  explicit FollowExercise(const Step& step)
      : lead_(step.task == Task::by_hand ? Lead::hand : Lead::flow),
        place_(kWay * std::cos(step.amount * kDegree), -kWay * std::sin(step.amount * kDegree)) {}
  Verdict judge(const Instant& now) override {
    const Eigen::Vector2d left = place_ - now.moved.to;
    if (left.norm() < kThere) {
      arrived_ = true;
      return now.settled() ? Verdict{true} : Verdict{};
    }
    if (!begun_) begun_ = now.time;
    if (arrived_ || left.norm() > 1.5 * kWay || now.time - *begun_ > kPatience)
      return {false, "place"};
    const double off =
        navvi_types::wrap(-std::atan2(left.y(), left.x()) + now.moved.turned);
    const double speed = std::max(0.0, 0.5 * (1.0 - std::abs(off) / lead::kOnTheSpot));
    now.taught.course = Shown{{off, speed}, lead_};
    return {};
  }

 private:
  static constexpr double kWay = 1.5;    // m
  static constexpr double kThere = 0.4;  // m
  static constexpr double kPatience = 40.0;  // s
  Lead lead_;
  Eigen::Vector2d place_;  ///< m, in base_link as it was at first
  std::optional<double> begun_;  ///< s
  bool arrived_ = false;
};

/// Tell on which side something is near.
class SideExercise : public Exercise {
 public:
  explicit SideExercise(const Step& step) : side_(step.side) {}
  Verdict judge(const Instant& now) override {
    if (!clicked_ && now.seen.voice_busy) return {};
    navvi_types::NearThing thing;
    thing.thing_class = navvi_types::ThingClass::box;
    thing.gap = kNearGap;
    thing.nearest = 2.0 * cues::direction_of(side_);
    now.taught.near.push_back(thing);
    if (!clicked_ || now.time - *clicked_ > kClick) {
      clicked_ = now.time;
      if (now.seen.audible)
        now.taught.plays.push_back({sounds::Earcon::shelf_near, cues::direction_of(side_), 0.8});
    }
    const drive::Stick& stick = now.seen.stick;
    if (std::max(std::abs(stick.x), std::abs(stick.y)) < kDeflected) return {};
    if (cues::side_of({stick.y, stick.x}) == side_) return {true};
    return {false, side_ == cues::Side::left    ? "was_left"
                   : side_ == cues::Side::right ? "was_right"
                                                : "was_ahead"};
  }

 private:
  cues::Side side_;
  std::optional<double> clicked_;  ///< s
};

class PressExercise : public Exercise {
 public:
  explicit PressExercise(const Step& step) : button_(step.button) {}
  Verdict judge(const Instant& now) override {
    for (const Button button : now.seen.pressed)
      if (button <= Button::help && button != Button::repeat)
        return button == button_ ? Verdict{true} : Verdict{false, "button"};
    return {};
  }

 private:
  Button button_;
};

class GoalExercise : public Exercise {
 public:
  Verdict judge(const Instant& now) override {
    const bool runs = now.seen.trial == TrialState::State::running;
    begun_ = begun_ || runs;
    if (begun_ && now.seen.arrived()) return {true};
    return begun_ && !runs ? Verdict{false, "no_goal"} : Verdict{};
  }

 private:
  bool begun_ = false;
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
  if (!stands(seen))
    still.reset();
  else if (!still)
    still = time;
}

bool Instant::settled() const { return moved.still && time - *moved.still >= kSettled; }

std::unique_ptr<Exercise> begin_exercise(const Step& step, int tries) {
  switch (step.task) {
    case Task::drive:
      return std::make_unique<DriveExercise>(step);
    case Task::halt:
      return std::make_unique<HaltExercise>(step, tries);
    case Task::wait:
      return begin_wait(step, tries);
    case Task::back_away:
      return begin_back_away(step);
    case Task::turn:
      return std::make_unique<TurnExercise>(step);
    case Task::by_sound:
    case Task::by_hand:
      return std::make_unique<FollowExercise>(step);
    case Task::make_room:
      return begin_make_room(step);
    case Task::side:
      return std::make_unique<SideExercise>(step);
    case Task::press:
      return std::make_unique<PressExercise>(step);
    case Task::goal:
      break;
  }
  return std::make_unique<GoalExercise>();
}

}  // namespace navvi_feedback::lessons
