// What a simulated person makes of a sentence, a tone and a pattern.

#include <algorithm>
#include <cmath>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kAwaited = 3.0;         // s, that a person waits for what a press does
constexpr double kSameBump = 15.0;       // s
constexpr double kBackOff = 0.7;         // s
constexpr double kCareful = 5.0;         // s, one goes slowly after hearing of something near
constexpr double kSlowTicks = 0.28;      // s, between two: much is left to turn
constexpr double kShortly = 5.0;         // s; what is told after a turn is the rest of it
constexpr double kBackAgain = 0.6;
constexpr double kStartled = 0.4;    // s, from a word to the hand
constexpr double kBlindTurn = 3.0;   // m to drive after "turn now", which has no distance
constexpr double kShownLately = 8.0;  // s

/// rad, clockwise, to an hour on the clock face.
/// \param from_straight  it was 12 before: who then hears 1 or 11 knows that the edge has just been
/// passed
double angle_of(int hour, bool slight, bool from_straight) {
  if (slight) return hour == 1 ? 0.17 : -0.17;
  if (from_straight && hour == 1) return 0.35;
  if (from_straight && hour == 11) return -0.35;
  const double angle = hour * kPi / 6.0;
  return angle > kPi + 1e-9 ? angle - 2.0 * kPi : angle;
}

}  // namespace

void SimulatedOperator::react(const Tone& tone, double time) {
  switch (tone.earcon) {
    case Earcon::turn:
    case Earcon::turn_click:
      return follow_tick(tone, time);
    case Earcon::on_course:
      when_.news = time;
      course_.stop_at = std::max(course_.stop_at, at_.odometer + 0.5 * config_.kTrust);
      return;
    case Earcon::turn_stop:
      return stop_turn(time);
    case Earcon::hit_shelf:
    case Earcon::hit_obstacle:
      if (mode_ != Mode::arrived && mode_ != Mode::backing) mode_ = Mode::waiting;
      return;
    case Earcon::shelf_near:
    case Earcon::worker_near:
    case Earcon::forklift_near:
    case Earcon::pallet_robot_near:
    case Earcon::thing_near:
      return shy_away({Ask::beware, 12, {}, tone.side}, time);
    case Earcon::shelf_close:
    case Earcon::worker_close:
    case Earcon::forklift_close:
    case Earcon::pallet_robot_close:
    case Earcon::thing_close:
      return shy_away({Ask::beware, 12, {}, tone.side, true}, time);
    case Earcon::arrived:
    case Earcon::beacon:
    case Earcon::unsaid:
    case Earcon::flow:
      return;
  }
}

void SimulatedOperator::follow_tick(const Tone& tick, double time) {
  when_.news = time;
  // Before a corner they announce the turn, and what lasts leads round it.
  if (time - when_.shown < kShownLately) return;
  const bool same = sounds_.ticks && sounds_.ticks->side == tick.side;
  const bool slow = !same || time - sounds_.ticks->last > kSlowTicks;
  sounds_.ticks = Ticks{tick.side, time, tick.much.value_or(slow)};
  if (mode_ == Mode::waiting && !words_.told_to_halt) mode_ = Mode::driving;
}

void SimulatedOperator::stop_turn(double time) {
  when_.news = time;
  sounds_.ticks.reset();
  if (mode_ != Mode::turning && mode_ != Mode::driving) return;
  mode_ = Mode::driving;
  course_.target = at_.heading;
  course_.straight_before = true;
  course_.stop_at = std::max(course_.stop_at, at_.odometer + config_.kTrust);
  course_.speed = config_.driving.cruise;
}

/// Words and taps ask for it at about the same time.
void SimulatedOperator::press_start(double time) {
  if (time - when_.pressed > kAwaited) when_.pressed = time;
}

void SimulatedOperator::react(Meaning meaning, double time) {
  if (mode_ == Mode::arrived) return;
  switch (meaning) {
    case Meaning::none:
      return;
    case Meaning::stuck:
      // Where nothing is said, the lesson has taught to back up a little.
      if (config_.lead == "hand" && !ears_.listen()) back_off(Instruction::Side::none, time);
      return;
    case Meaning::ready:
      // Once under way, what feels like it is something else.
      if (at_.odometer == 0.0) press_start(time);
      return;
    case Meaning::begun:
      words_.told_to_halt = false;
      when_.news = time;
      return;
    case Meaning::new_way:
      // The old direction no longer holds; there is a word or a pull to wait for.
      if (mode_ == Mode::driving)
        course_.stop_at = std::min(course_.stop_at, at_.odometer + kNearTheEnd);
      return;
    case Meaning::hit:
      if (config_.lead == "hand" && !ears_.listen()) return back_off(Instruction::Side::none, time);
      [[fallthrough]];
    case Meaning::halt:
    case Meaning::stop:
      if (mode_ != Mode::backing) mode_ = Mode::waiting;
      when_.careful_until = time + kCareful;
      return;
    case Meaning::arrived:
      mode_ = Mode::arrived;
      return;
  }
}

void SimulatedOperator::turn_to(const Sentence& sentence, const Instruction& instruction,
                                double time) {
  double angle = angle_of(instruction.hour, instruction.slight, course_.straight_before);
  if (turned_.to && sentence.begun > turned_.at && sentence.begun - turned_.at < kShortly)
    learning_.turned(*turned_.to, angle);
  // Sent back from where one has just turned, one turns back by less.
  const bool back = turned_.to && angle * *turned_.to < 0.0 && time - turned_.at < kShortly;
  turned_.to = angle;
  turned_.at = time;
  if (back) angle *= kBackAgain;
  const double learnt = std::copysign(learning_.bias(), angle);
  course_.target = sentence.at.heading - turning_.made((angle + learnt) * driving_.turn_gain());
  const bool far = instruction.distance.value_or(0.0) > kListenFirst;
  course_.turn_speed =
      std::abs(angle) < 0.4 && far && mode_ == Mode::driving ? config_.driving.kSlow * 0.7 : 0.0;
  mode_ = Mode::turning;
  go_for(sentence, instruction);
  course_.speed = std::min(course_.speed, 0.5 * (config_.driving.kSlow + config_.driving.cruise));
}

void SimulatedOperator::go_for(const Sentence& sentence, const Instruction& instruction) {
  const double distance = instruction.distance.value_or(kBlindTurn);
  const double begun = mode_ == Mode::turning ? at_.odometer : sentence.at.odometer;
  course_.stop_at = std::max(begun + distance, at_.odometer + 0.6);
  course_.speed =
      course_.stop_at - at_.odometer > 3.0 ? config_.driving.cruise : config_.driving.kSlow;
}

void SimulatedOperator::veer(Instruction::Side side, double angle, double until) {
  if (side != Instruction::Side::left && side != Instruction::Side::right) return;
  course_.veer = side == Instruction::Side::left ? -angle : angle;
  course_.veer_until = until;
}

void SimulatedOperator::back_off(Instruction::Side side, double time) {
  mode_ = side == Instruction::Side::behind ? Mode::waiting : Mode::backing;
  // After a second bump into the same thing: further back, and on at an angle.
  const bool again = time - when_.bumped < kSameBump;
  when_.bumped = time;
  when_.careful_until = time + 2.0 * kCareful;
  backing_.until = time + (again ? 2.0 : 1.0) * kBackOff;
  course_.target = at_.heading;
  if (side == Instruction::Side::left || side == Instruction::Side::right) {
    veer(side, 0.25, time + 8.0);
  } else if (again) {
    backing_.other_side = !backing_.other_side;
    veer(backing_.other_side ? Instruction::Side::left : Instruction::Side::right, 0.3, time + 6.0);
  }
}

void SimulatedOperator::ask_soon(double time) {
  when_.news = time - config_.attention.idle_patience + 0.4;
}

void SimulatedOperator::shy_away(const Instruction& instruction, double time) {
  when_.careful_until = std::max(when_.careful_until, time + kCareful);
  if (!instruction.very_close) return veer(instruction.side, 0.1, time + 1.5);
  veer(instruction.side, 0.3, time + 2.0);
  // The heading led very near to the thing, so it is not taken up again.
  if (instruction.side == Instruction::Side::left) course_.target -= 0.12;
  if (instruction.side == Instruction::Side::right) course_.target += 0.12;
}

/// Some first words are enough.
void SimulatedOperator::be_startled(double time) {
  for (const auto& [id, sentence] : ears_.begun()) {
    const double heard = (time - sentence.begun - kStartled) * kLettersPerSecond;
    const Listener::FirstWord word = ears_.listener().first_word(sentence.text, heard);
    if (mode_ == Mode::arrived || heard <= 0.0 || !word.startles) continue;
    mode_ = Mode::waiting;
    wait_for_go_on(sentence, word.holds);
  }
}

void SimulatedOperator::wait_for_go_on(const Sentence& sentence, bool holds) {
  if (!holds) return;
  words_.waits = std::max(words_.waits.value_or(sentence.begun), sentence.begun);
  words_.told_to_halt = true;
}

void SimulatedOperator::react(const Sentence& sentence, double time) {
  const std::vector<Instruction>& parts = sentence.parts;
  wait_for_go_on(sentence, !parts.empty() && parts.front().holds);
  if (!parts.empty() && parts.front().goes_on && words_.waits && sentence.begun > *words_.waits)
    words_.waits.reset();
  // Where a display leads, its end is to stand, whatever direction is told besides.
  const bool shown = time - when_.shown < kShownLately;
  for (const Instruction& part : parts) {
    const bool leads = part.asks == Ask::turn || part.asks == Ask::go;
    if (!(leads && (words_.waits || shown))) obey(sentence, part, time);
  }
}

void SimulatedOperator::expect_turn(const Sentence& sentence, const Instruction& turn) {
  course_.stop_at = sentence.at.odometer + turn.distance.value_or(kBlindTurn);
  if (course_.stop_at - at_.odometer < 3.0)
    course_.speed = std::min(course_.speed, config_.driving.kSlow);
}

void SimulatedOperator::obey(const Sentence& sentence, const Instruction& instruction,
                             double time) {
  if (instruction.asks == Ask::halt || instruction.asks == Ask::back) words_.told_to_halt = true;
  if (instruction.asks == Ask::ready || instruction.asks == Ask::turn ||
      instruction.asks == Ask::go)
    words_.told_to_halt = false;
  switch (instruction.asks) {
    case Ask::nothing:
    case Ask::ready:
      break;
    case Ask::turn:
      // A sound that leads this turn leads it whether or not the words are kept in mind.
      if (!memory_.keeps(config_.driving.cruise, time)) break;
      turn_to(sentence, instruction, time);
      course_.straight_before = false;
      break;
    case Ask::go:
      // A turn that a sound has led since is not turned back.
      if (sounds_.turned < sentence.begun) course_.target = sentence.at.heading;
      course_.turn_speed = 0.0;
      mode_ = std::abs(course_.target - at_.heading) > 0.1 ? Mode::turning : Mode::driving;
      go_for(sentence, instruction);
      course_.straight_before = true;
      break;
    case Ask::turn_ahead:
      if (mode_ == Mode::driving) expect_turn(sentence, instruction);
      break;
    case Ask::beware:
      if (instruction.side == Instruction::Side::ahead && mode_ == Mode::driving) {
        mode_ = Mode::waiting;
        ask_soon(time);
      }
      shy_away(instruction, time);
      break;
    case Ask::back:
      back_off(instruction.side, time);
      break;
    case Ask::halt:
      mode_ = Mode::waiting;
      break;
    case Ask::begin:
      press_start(time);
      break;
    case Ask::rest:
      mode_ = Mode::arrived;
      break;
  }
}

}  // namespace navvi_people::people
