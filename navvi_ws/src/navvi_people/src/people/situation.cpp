#include "navvi_people/people/situation.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>
#include <utility>

#include "navvi_people/people/driving.hpp"

namespace navvi_people::people {
namespace {

constexpr double kAwaited = 3.0;      // s, that a person waits for what a press does
constexpr double kSameBump = 15.0;    // s
constexpr double kBackOff = 0.7;      // s
constexpr double kCareful = 5.0;      // s, one goes slowly after hearing of something near
constexpr double kSlowTicks = 0.28;   // s, between two: much is left to turn
constexpr double kBackAgain = 0.6;    // of a turn back from where one has just turned
constexpr double kBlindTurn = 3.0;    // m to drive after "turn now", which has no distance
constexpr double kShownLately = 8.0;  // s
constexpr double kSlow = DrivingConfig::kSlow;

bool beside(Situation::Side side) {
  return side == Situation::Side::left || side == Situation::Side::right;
}

}  // namespace

void Situation::hear_tick(Side side, std::optional<bool> much, double time) {
  news = time;
  // Before a corner they announce the turn, and what lasts leads round it.
  if (shown_lately(time)) return;
  const bool slow = !ticks || ticks->side != side || time - ticks->last > kSlowTicks;
  ticks = Ticks{side, time, much.value_or(slow)};
  if (mode == Mode::waiting && !told_to_halt) mode = Mode::driving;
}

void Situation::end_ticks(double time) {
  news = time;
  ticks.reset();
  if (mode != Mode::turning && mode != Mode::driving) return;
  mode = Mode::driving;
  course.target = at.heading;
  course.straight_before = true;
  course.stop_at = std::max(course.stop_at, at.odometer + kTrust);
  course.speed = cruise;
}

void Situation::keep_course(double time) {
  news = time;
  course.stop_at = std::max(course.stop_at, at.odometer + 0.5 * kTrust);
}

void Situation::change_way() {
  if (mode == Mode::driving) course.stop_at = std::min(course.stop_at, at.odometer + kNearTheEnd);
}

void Situation::stand(double time) {
  if (mode != Mode::backing) mode = Mode::waiting;
  careful_until = time + kCareful;
}

double Situation::angle_of(const Instruction& told) const {
  if (told.slight) return told.hour == 1 ? 0.17 : -0.17;
  if (course.straight_before && told.hour == 1) return 0.35;
  if (course.straight_before && told.hour == 11) return -0.35;
  const double angle = told.hour * navvi_types::kPi / 6.0;
  return angle > navvi_types::kPi + 1e-9 ? angle - 2.0 * navvi_types::kPi : angle;
}

double Situation::begin_turn(double angle, double time) {
  const bool back = turned.to && angle * *turned.to < 0.0 && time - turned.at < kShortly;
  turned = {angle, time};
  return back ? kBackAgain * angle : angle;
}

void Situation::turn(const Sentence& sentence, const Instruction& told, double angle, double made) {
  course.target = sentence.at.heading - made;
  const bool on_the_way = std::abs(angle) < 0.4 && mode == Mode::driving &&
                          told.distance.value_or(0.0) > kListenFirst;
  course.turn_speed = on_the_way ? kSlow * 0.7 : 0.0;
  mode = Mode::turning;
  go_for(sentence, told);
  course.speed = std::min(course.speed, 0.5 * (kSlow + cruise));
  course.straight_before = false;
}

void Situation::go(const Sentence& sentence, const Instruction& told) {
  // A turn that ticks have led since is not turned back.
  if (ticks_led < sentence.begun) course.target = sentence.at.heading;
  course.turn_speed = 0.0;
  mode = std::abs(course.target - at.heading) > 0.1 ? Mode::turning : Mode::driving;
  go_for(sentence, told);
  course.straight_before = true;
}

void Situation::go_for(const Sentence& sentence, const Instruction& told) {
  const double begun = mode == Mode::turning ? at.odometer : sentence.at.odometer;
  course.stop_at = std::max(begun + told.distance.value_or(kBlindTurn), at.odometer + 0.6);
  course.speed = left() > 3.0 ? cruise : kSlow;
}

void Situation::expect_turn(const Sentence& sentence, const Instruction& told) {
  if (mode != Mode::driving) return;
  course.stop_at = sentence.at.odometer + told.distance.value_or(kBlindTurn);
  if (left() < 3.0) course.speed = std::min(course.speed, kSlow);
}

void Situation::veer(Side side, double angle, double until) {
  if (!beside(side)) return;
  course.veer = side == Side::left ? -angle : angle;
  course.veer_until = until;
}

void Situation::shy_away(Side side, bool very_close, double time) {
  careful_until = std::max(careful_until, time + kCareful);
  if (!very_close) return veer(side, 0.1, time + 1.5);
  veer(side, 0.3, time + 2.0);
  // The heading led very near to the thing, so it is not taken up again.
  if (beside(side)) course.target += side == Side::left ? -0.12 : 0.12;
}

void Situation::back_off(Side side, double time) {
  mode = side == Side::behind ? Mode::waiting : Mode::backing;
  // After a second bump into the same thing: further back, and on at an angle.
  const bool again = time - std::exchange(bumped, time) < kSameBump;
  careful_until = time + 2.0 * kCareful;
  backs_until = time + (again ? 2.0 : 1.0) * kBackOff;
  course.target = at.heading;
  if (beside(side)) return veer(side, 0.25, time + 8.0);
  if (!again) return;
  off_left = !off_left;
  veer(off_left ? Side::left : Side::right, 0.3, time + 6.0);
}

void Situation::wait_for_go_on(const Sentence& sentence) {
  waits = std::max(waits.value_or(sentence.begun), sentence.begun);
  told_to_halt = true;
}

void Situation::ask_soon(double time) {
  mode = Mode::waiting;
  news = time - idle_patience + 0.4;
}

void Situation::try_ahead(double way) {
  mode = Mode::driving;
  course.target = at.heading;
  course.stop_at = at.odometer + way;
  course.speed = kSlow;
}

void Situation::press_start(double time) {
  if (time - pressed > kAwaited) pressed = time;
}

bool Situation::shown_lately(double time) const { return time - shown < kShownLately; }

}  // namespace navvi_people::people
