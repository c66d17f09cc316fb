#include "lessons/guide_exercises.hpp"

#include <cmath>

namespace navvi_feedback::lessons {
namespace {

constexpr double kRoomError = navvi_types::radians(35.0);  // an hour, and a little
constexpr double kShare = 0.6;       // of a distance that is told, to have driven it
constexpr double kReaction = 1.0;    // s, from a word to the free stick
constexpr double kWait = 2.5;        // s, of standing, until it goes on
constexpr double kHesitation = 8.0;  // s, after a word to drive
constexpr double kBefore = 1.0;      // s, of standing in silence, before such a word

cues::Utterance words_of(CueKind kind, navvi_types::ThingClass thing, int hour, double distance) {
  cues::Utterance words;
  words.kind = kind;
  words.fillings.thing = thing;
  words.fillings.side = cues::Side::ahead;
  words.fillings.hour = hour;
  words.fillings.distance = distance;
  return words;
}

/// The end of a pause, after which a word to drive comes.
class Pause {
 public:
  /// \return the robot has stood in silence for long enough
  bool over(const Instant& now) {
    if (!now.settled() || now.seen.voice_busy)
      since_.reset();
    else if (!since_)
      since_ = now.time;
    return since_ && now.time - *since_ >= kBefore;
  }

 private:
  std::optional<double> since_;  ///< s
};

class WaitExercise : public Exercise {
 public:
  WaitExercise(const Step& step, int tries) : amount_(step.amount), motion_(tries) {}
  Verdict judge(const Instant& now) override {
    wait_.observe(now);
    go_on_.observe(now);
    if (now.moved.driven < -kBack) return {false, "back"};
    if (std::abs(now.moved.turned) > kAstray) return {false, "crooked"};
    if (!wait_.heard()) return drive(now);
    if (!since_) return let_go(now);
    return go_on_.heard() ? drive_on(now) : stand(now);
  }

 private:
  Verdict drive(const Instant& now) {
    if (motion_.due(now))
      wait_.say(now, "said_wait",
                words_of(CueKind::blocked, navvi_types::ThingClass::forklift, 12, amount_));
    return now.settled() && now.moved.driven > 0.05 ? Verdict{false, "early"} : Verdict{};
  }
  Verdict let_go(const Instant& now) {
    if (neutral(now.seen.stick)) {
      since_ = now.time;
      return {};
    }
    return now.time - *wait_.heard() > kReaction ? Verdict{false, "late"} : Verdict{};
  }
  Verdict stand(const Instant& now) {
    if (!neutral(now.seen.stick)) return {false, "moved"};
    if (now.time - *since_ >= kWait && now.settled()) {
      cues::Utterance on = words_of(CueKind::straight, navvi_types::ThingClass::other, 12, amount_);
      on.goes_on = true;
      go_on_.say(now, "said_go_on", on);
      from_ = now.moved.driven;
    }
    return {};
  }
  Verdict drive_on(const Instant& now) {
    const double driven = now.moved.driven - from_;
    if (driven >= amount_ && !neutral(now.seen.stick)) enough_.tell(now, "enough");
    if (!now.settled()) return {};
    if (driven < 0.03)
      return now.time - *go_on_.heard() > kHesitation ? Verdict{false, "stood"} : Verdict{};
    return driven >= kShare * amount_ ? Verdict{true} : Verdict{false, "short"};
  }

  double amount_;
  WordInMotion motion_;
  Word wait_, go_on_, enough_;
  std::optional<double> since_;  ///< s, of the free stick
  double from_ = 0.0;            ///< m, driven when it went on
};

class BackAwayExercise : public Exercise {
 public:
  explicit BackAwayExercise(const Step& step) : amount_(step.amount) {}
  Verdict judge(const Instant& now) override {
    back_.observe(now);
    const Moved& moved = now.moved;
    if (std::abs(moved.turned) > kAstray) return {false, "not_back"};
    if (moved.driven > kBack) return {false, "forward"};
    if (!back_.heard() && moved.driven < -0.05) return {false, "soon"};
    if (pause_.over(now))
      back_.say(now, "said_back_away",
                words_of(CueKind::back_away, navvi_types::ThingClass::shelf, 6, amount_));
    if (moved.driven < -2.0 * amount_ && !neutral(now.seen.stick)) enough_.tell(now, "enough");
    if (!now.settled() || moved.driven > -0.03) return {};
    return moved.driven <= -kShare * amount_ ? Verdict{true} : Verdict{false, "short"};
  }

 private:
  double amount_;
  Pause pause_;
  Word back_, enough_;
};

class MakeRoomExercise : public Exercise {
 public:
  explicit MakeRoomExercise(const Step& step)
      : target_(navvi_types::radians(step.amount)),
        hour_((static_cast<int>(std::lround(step.amount / 30.0)) + 11) % 12 + 1) {}
  Verdict judge(const Instant& now) override {
    move_.observe(now);
    const Moved& moved = now.moved;
    const double left = moved.to.norm();
    if (!move_.heard() && (left > kBack || std::abs(moved.turned) > kAstray))
      return {false, "soon"};
    if (pause_.over(now))
      move_.say(now, "said_make_room",
                words_of(CueKind::make_room, navvi_types::ThingClass::forklift, hour_, kRoom));
    if (!move_.heard()) return {};
    if (left < kBack) count_down(now, target_ + moved.turned, target_, stop_);
    if (moved.turned * target_ > 0.0 && std::abs(moved.turned) > kAstray) return {false, "side"};
    if (left > kRoom && !neutral(now.seen.stick)) enough_.tell(now, "enough");
    if (!now.settled() || left < kBack) return {};
    const double bearing = std::atan2(-moved.to.y(), moved.to.x());
    if (std::abs(navvi_types::wrap(bearing - target_)) > kRoomError) return {false, "place"};
    return left >= kShare * kRoom ? Verdict{true} : Verdict{false, "short"};
  }

 private:
  static constexpr double kRoom = 1.0;  // m
  double target_;
  int hour_;
  Pause pause_;
  Word move_, stop_, enough_;
};

}  // namespace

std::unique_ptr<Exercise> begin_wait(const Step& step, int tries) {
  return std::make_unique<WaitExercise>(step, tries);
}

std::unique_ptr<Exercise> begin_back_away(const Step& step) {
  return std::make_unique<BackAwayExercise>(step);
}

std::unique_ptr<Exercise> begin_make_room(const Step& step) {
  return std::make_unique<MakeRoomExercise>(step);
}

}  // namespace navvi_feedback::lessons
