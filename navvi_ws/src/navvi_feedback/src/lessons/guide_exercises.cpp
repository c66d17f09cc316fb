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
    since_ = since_when(now.settled() && !now.seen.voice_busy, since_, now.time);
    return since_ && now.time - *since_ >= kBefore;
  }

 private:
  std::optional<double> since_;  ///< s
};

struct WaitExercise {
  double amount;  ///< m, to drive after "go on"
  WordInMotion motion;
  Word wait = {}, go_on = {}, enough = {};
  std::optional<double> since = {};  ///< s, of the free stick
  double from = 0.0;                 ///< m, driven when it went on

  Verdict operator()(const Instant& now) {
    wait.observe(now);
    go_on.observe(now);
    if (now.moved.driven < -kBack) return {false, "back"};
    if (std::abs(now.moved.turned) > kAstray) return {false, "crooked"};
    if (!wait.heard()) return drive(now);
    if (!since) return let_go(now);
    return go_on.heard() ? drive_on(now) : stand(now);
  }
  Verdict drive(const Instant& now) {
    if (motion.due(now))
      wait.say(now, "said_wait",
               words_of(CueKind::blocked, navvi_types::ThingClass::forklift, 12, amount));
    return now.settled() && now.moved.driven > 0.05 ? Verdict{false, "early"} : Verdict{};
  }
  Verdict let_go(const Instant& now) {
    if (neutral(now.seen.stick)) {
      since = now.time;
      return {};
    }
    return now.time - *wait.heard() > kReaction ? Verdict{false, "late"} : Verdict{};
  }
  Verdict stand(const Instant& now) {
    if (!neutral(now.seen.stick)) return {false, "moved"};
    if (now.time - *since >= kWait && now.settled()) {
      cues::Utterance on = words_of(CueKind::straight, navvi_types::ThingClass::other, 12, amount);
      on.goes_on = true;
      go_on.say(now, "said_go_on", on);
      from = now.moved.driven;
    }
    return {};
  }
  Verdict drive_on(const Instant& now) {
    const double driven = now.moved.driven - from;
    if (driven >= amount && !neutral(now.seen.stick)) enough.tell(now, "enough");
    if (!now.settled()) return {};
    if (driven < 0.03)
      return now.time - *go_on.heard() > kHesitation ? Verdict{false, "stood"} : Verdict{};
    return driven >= kShare * amount ? Verdict{true} : Verdict{false, "short"};
  }
};

struct BackAwayExercise {
  double amount;  ///< m
  Pause pause = {};
  Word back = {}, enough = {};

  Verdict operator()(const Instant& now) {
    back.observe(now);
    const Moved& moved = now.moved;
    if (std::abs(moved.turned) > kAstray) return {false, "not_back"};
    if (moved.driven > kBack) return {false, "forward"};
    if (!back.heard() && moved.driven < -0.05) return {false, "soon"};
    if (pause.over(now))
      back.say(now, "said_back_away",
               words_of(CueKind::back_away, navvi_types::ThingClass::shelf, 6, amount));
    if (moved.driven < -2.0 * amount && !neutral(now.seen.stick)) enough.tell(now, "enough");
    if (!now.settled() || moved.driven > -0.03) return {};
    return moved.driven <= -kShare * amount ? Verdict{true} : Verdict{false, "short"};
  }
};

struct MakeRoomExercise {
  static constexpr double kRoom = 1.0;  // m

  double target;  ///< rad, clockwise
  int hour;       ///< likewise
  Pause pause = {};
  Word move = {}, stop = {}, enough = {};

  Verdict operator()(const Instant& now) {
    move.observe(now);
    const Moved& moved = now.moved;
    const double left = moved.to.norm();
    if (!move.heard() && (left > kBack || std::abs(moved.turned) > kAstray))
      return {false, "soon"};
    if (pause.over(now))
      move.say(now, "said_make_room",
               words_of(CueKind::make_room, navvi_types::ThingClass::forklift, hour, kRoom));
    if (!move.heard()) return {};
    if (left < kBack) count_down(now, target + moved.turned, target, stop);
    if (moved.turned * target > 0.0 && std::abs(moved.turned) > kAstray) return {false, "side"};
    if (left > kRoom && !neutral(now.seen.stick)) enough.tell(now, "enough");
    if (!now.settled() || left < kBack) return {};
    const double bearing = std::atan2(-moved.to.y(), moved.to.x());
    if (std::abs(navvi_types::wrap(bearing - target)) > kRoomError) return {false, "place"};
    return left >= kShare * kRoom ? Verdict{true} : Verdict{false, "short"};
  }
};

}  // namespace

Exercise begin_wait(const Step& step, int tries) {
  return WaitExercise{step.amount, WordInMotion(tries)};
}

Exercise begin_back_away(const Step& step) { return BackAwayExercise{step.amount}; }

Exercise begin_make_room(const Step& step) {
  const int hour = (static_cast<int>(std::lround(step.amount / 30.0)) + 11) % 12 + 1;
  return MakeRoomExercise{navvi_types::radians(step.amount), hour};
}

}  // namespace navvi_feedback::lessons
