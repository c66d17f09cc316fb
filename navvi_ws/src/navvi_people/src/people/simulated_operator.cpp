#include "navvi_people/people/simulated_operator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace navvi_people::people {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNeutralAtStart = 1.0;      // s
constexpr double kPress = 0.15;              // s, a button is held
constexpr double kSameBump = 15.0;           // s
constexpr double kBackOff = 0.7;             // s
constexpr double kCareful = 5.0;             // s, one goes slowly after hearing of something near
constexpr double kCharactersPerSecond = 14;  // at which a sentence without an end is over
constexpr double kNearTheEnd = 1.5;          // m to where one expects to stop
constexpr double kListenFirst = 2.5;         // m, likewise
constexpr double kOneSided = 0.8;            // of one motor over the other: very near at a side
constexpr double kTicksOver = 1.2;           // s; ticks that paused for so long are over
constexpr double kMuchForce = 0.6;           // of the motor that attracts: much is left to turn
constexpr double kSlowTicks = 0.28;          // s, between two: much is left to turn
constexpr std::uint64_t kEar = 0x9e3779b97f4a7c15;  // so that the ear draws numbers of its own
constexpr double kBlindTurn = 3.0;  // m to drive after "turn now", which has no distance

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

/// nullopt where the words alone tell what they are.
std::optional<CueKind> label(CueKind kind) {
  return kind == CueKind::lesson ? std::nullopt : std::optional(kind);
}

}  // namespace

void SimulatedOperatorConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(min_reaction, "min_reaction", Range{0.0, 5.0}, "s",
        "quickest from the end of a sentence to the hand");
  visit(max_reaction, "max_reaction", Range{0.0, 5.0}, "s", "slowest; not below min_reaction");
  visit(turn_rate, "turn_rate", Range{0.1, 5.0}, "rad/s", "believed, at full stick");
  visit(full_speed, "full_speed", Range{0.1, 5.0}, "m/s", "believed, at full stick");
  visit(dead_zone, "dead_zone", Range{0.0, 0.5}, "", "believed, of the stick");
  visit(expo, "expo", Range{0.0, 1.0}, "", "believed, of the stick: 0 linear, 1 cubic");
  visit(gain_error, "gain_error", Range{0.0, 0.5}, "",
        "standard deviation of how wrong these beliefs are");
  visit(turn_error, "turn_error", Range{0.0, 1.0}, "rad", "standard deviation of each turn");
  visit(cruise, "cruise", Range{0.05, 1.0}, "", "stick on a straight way");
  visit(slow, "slow", Range{0.05, 1.0}, "", "stick when something is near");
  visit(patience, "patience", Range{1.0, 60.0}, "s", "of silence while driving before asking");
  visit(idle_patience, "idle_patience", Range{0.5, 60.0}, "s",
        "of silence while waiting before asking");
  visit(strong_rumble, "strong_rumble", Range{0.0, 1.0}, "",
        "motors above this on both sides slow the hand");
  visit(touch, "touch", navvi_config::OneOf{{"repulsive", "attractive"}}, "",
        "what the person was told that a motor means, as feedback/haptics/steer");
  visit(min_sound_reaction, "min_sound_reaction", Range{0.0, 2.0}, "s",
        "of the quickest person, from a short sound to the hand; assumed");
  visit(max_sound_reaction, "max_sound_reaction", Range{0.0, 2.0}, "s", "of the slowest; assumed");
  visit(missed_sounds, "missed_sounds", Range{0.0, 1.0}, "", "share of short sounds; assumed");
  visit(trust, "trust", Range{1.0, 100.0}, "m",
        "driven on without a word after a turn that a sound has ended; assumed");
  visit(obeys, "obeys", navvi_config::Any{}, "",
        "true: after \"stop\" and \"wait\" nothing but \"go on\" moves the hand, as is taught");
}

SimulatedOperator::SimulatedOperator(const SimulatedOperatorConfig& config, std::uint64_t seed,
                                     const std::filesystem::path& phrases)
    : config_(config), listener_(phrases), random_(seed), ear_random_(seed ^ kEar) {
  const double share = std::uniform_real_distribution<double>(0.0, 1.0)(ear_random_);
  sound_reaction_ = config_.min_sound_reaction +
                    share * std::max(0.0, config_.max_sound_reaction - config_.min_sound_reaction);
  std::normal_distribution<double> error(0.0, config_.gain_error);
  turn_gain_ = 1.0 + std::clamp(error(random_), -0.3, 0.3);
  speed_gain_ = 1.0 + std::clamp(error(random_), -0.3, 0.3);
}

void SimulatedOperator::hear(const CueEvent& cue, double time) {
  using navvi_types::CueStage;
  if (const auto* const earcon = std::get_if<Earcon>(&cue.what))
    return hear_sound(*earcon, cue.left, cue.right, time);
  const auto* const spoken = std::get_if<navvi_types::Spoken>(&cue.what);
  if (spoken == nullptr) return;
  if (cue.stage == CueStage::started) {
    hearing_[cue.id] = {spoken->kind, cue.text, heading_, odometer_, time, time};
  } else if (cue.stage == CueStage::cut) {
    hearing_.erase(cue.id);
  } else if (cue.stage == CueStage::ended) {
    understood(cue.id, time);
  }
}

void SimulatedOperator::hear_sound(Earcon earcon, double left, double right, double time) {
  using Side = Instruction::Side;
  if (std::uniform_real_distribution<double>(0.0, 1.0)(ear_random_) < config_.missed_sounds) return;
  const double lean = left - right;
  const bool aside = std::abs(lean) > 0.3 * (left + right);
  heard_.push_back({earcon,
                    !aside       ? Side::ahead
                    : lean > 0.0 ? Side::left
                                 : Side::right,
                    time + sound_reaction_});
}

void SimulatedOperator::follow(const Heard& sound, double time) {
  switch (sound.earcon) {
    case Earcon::turn:
    case Earcon::turn_click:
      return follow_tick(sound, time);
    case Earcon::on_course:
      last_news_ = time;
      stop_at_ = std::max(stop_at_, odometer_ + 0.5 * config_.trust);
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
      return shy_away({Ask::beware, 12, {}, sound.side}, time);
    case Earcon::shelf_close:
    case Earcon::worker_close:
    case Earcon::forklift_close:
    case Earcon::pallet_robot_close:
    case Earcon::thing_close:
      return shy_away({Ask::beware, 12, {}, sound.side, true}, time);
    case Earcon::arrived:
    case Earcon::beacon:
    case Earcon::sonar:
      return;
  }
}

void SimulatedOperator::follow_tick(const Heard& tick, double time) {
  last_news_ = time;
  const bool same = ticks_ && ticks_->side == tick.side;
  const bool slow = !same || time - ticks_->last > kSlowTicks;
  ticks_ = Ticks{tick.side, time, tick.much.value_or(slow)};
  if (mode_ == Mode::waiting && !told_to_halt_) mode_ = Mode::driving;
}

void SimulatedOperator::stop_turn(double time) {
  last_news_ = time;
  ticks_.reset();
  if (mode_ != Mode::turning && mode_ != Mode::driving) return;
  mode_ = Mode::driving;
  target_ = heading_;
  straight_before_ = true;
  stop_at_ = std::max(stop_at_, odometer_ + config_.trust);
  speed_ = config_.cruise;
}

/// A large turn is made on the spot, a small one on the way.
StickAndButtons SimulatedOperator::turn_by_ear(double time) const {
  StickAndButtons hand;
  const double side = ticks_->side == Instruction::Side::left ? 1.0 : -1.0;
  const bool large = ticks_->much;
  hand.left = side * (large ? 1.0 : 0.55);
  if (large || odometer_ >= stop_at_) return hand;
  hand.forward = time < careful_until_ ? 0.5 * config_.slow : 0.7 * config_.slow;
  return hand;
}

void SimulatedOperator::feel(double left, double right, double time) {
  using Side = Instruction::Side;
  if (config_.touch == "attractive") {
    // Two motors are a pattern; one is the side to turn to.
    const bool pulled = (left > 0.0) != (right > 0.0);
    const double reaction = time + sound_reaction_;
    if (pulled)
      heard_.push_back({Earcon::turn, left > 0.0 ? Side::left : Side::right, reaction,
                        std::max(left, right) > kMuchForce});
    else if (left == 0.0 && ticks_)
      heard_.push_back({Earcon::turn_stop, Side::none, reaction});
    return;
  }
  left_motor_ = left;
  right_motor_ = right;
}

void SimulatedOperator::understood(std::uint32_t id, double time) {
  const auto found = hearing_.find(id);
  if (found == hearing_.end()) return;
  Sentence sentence = found->second;
  hearing_.erase(found);
  const double unit = std::uniform_real_distribution<double>(0.0, 1.0)(random_);
  sentence.time = time + config_.min_reaction +
                  unit * std::max(0.0, config_.max_reaction - config_.min_reaction);
  understood_.push_back(sentence);
  // A thing nearby, or a later turn, is no news while waiting for a direction.
  const std::vector<Instruction> told = listener_.understand(label(sentence.kind), sentence.text);
  const auto idle = [](const Instruction& part) {
    return part.asks == Ask::beware || part.asks == Ask::turn_ahead;
  };
  if (mode_ != Mode::waiting || !std::all_of(told.begin(), told.end(), idle)) last_news_ = time;
}

void SimulatedOperator::turn_to(const Sentence& sentence, const Instruction& instruction) {
  const double error = std::normal_distribution<double>(0.0, config_.turn_error)(random_);
  const double angle = angle_of(instruction.hour, instruction.slight, straight_before_);
  target_ = sentence.heading - angle * turn_gain_ + std::clamp(error, -0.5, 0.5);
  const bool far = instruction.distance.value_or(0.0) > kListenFirst;
  turn_speed_ = std::abs(angle) < 0.4 && far && mode_ == Mode::driving ? config_.slow * 0.7 : 0.0;
  mode_ = Mode::turning;
  go_for(sentence, instruction);
  speed_ = std::min(speed_, 0.5 * (config_.slow + config_.cruise));
}

void SimulatedOperator::go_for(const Sentence& sentence, const Instruction& instruction) {
  const double distance = instruction.distance.value_or(kBlindTurn);
  const double begun = mode_ == Mode::turning ? odometer_ : sentence.odometer;
  stop_at_ = std::max(begun + distance, odometer_ + 0.6);
  speed_ = stop_at_ - odometer_ > 3.0 ? config_.cruise : config_.slow;
}

void SimulatedOperator::veer(Instruction::Side side, double angle, double until) {
  if (side != Instruction::Side::left && side != Instruction::Side::right) return;
  veer_ = side == Instruction::Side::left ? -angle : angle;
  veer_until_ = until;
}

void SimulatedOperator::back_off(Instruction::Side side, double time) {
  mode_ = side == Instruction::Side::behind ? Mode::waiting : Mode::backing;
  // After a second bump into the same thing: further back, and on at an angle.
  const bool again = time - bumped_ < kSameBump;
  bumped_ = time;
  careful_until_ = time + 2.0 * kCareful;
  back_until_ = time + (again ? 2.0 : 1.0) * kBackOff;
  target_ = heading_;
  if (side == Instruction::Side::left || side == Instruction::Side::right) {
    veer(side, 0.25, time + 8.0);
  } else if (again) {
    other_side_ = !other_side_;
    veer(other_side_ ? Instruction::Side::left : Instruction::Side::right, 0.3, time + 6.0);
  }
}

void SimulatedOperator::ask_soon(double time) { last_news_ = time - config_.idle_patience + 0.4; }

void SimulatedOperator::shy_away(const Instruction& instruction, double time) {
  careful_until_ = std::max(careful_until_, time + kCareful);
  if (!instruction.very_close) return veer(instruction.side, 0.1, time + 1.5);
  veer(instruction.side, 0.3, time + 2.0);
  // The heading led very near to the thing, so it is not taken up again.
  if (instruction.side == Instruction::Side::left) target_ -= 0.12;
  if (instruction.side == Instruction::Side::right) target_ += 0.12;
}

/// Some first words are enough.
void SimulatedOperator::be_startled(double time) {
  for (const auto& [id, sentence] : hearing_) {
    const double heard = (time - sentence.time - config_.min_reaction) * kCharactersPerSecond;
    if (mode_ == Mode::arrived || heard <= 0.0 ||
        !listener_.startles(sentence.kind, sentence.text, heard))
      continue;
    mode_ = Mode::waiting;
    wait_for_go_on(sentence);
  }
}

void SimulatedOperator::wait_for_go_on(const Sentence& sentence) {
  const bool stops = family_of(sentence.kind) == navvi_types::CueFamily::halt;
  if (!config_.obeys || !stops) return;
  waits_ = std::max(waits_.value_or(sentence.begun), sentence.begun);
  told_to_halt_ = true;
}

void SimulatedOperator::follow(const Sentence& sentence, double time) {
  wait_for_go_on(sentence);
  const auto parts = listener_.understand(label(sentence.kind), sentence.text);
  if (!parts.empty() && parts.front().goes_on && waits_ && sentence.begun > *waits_) waits_.reset();
  for (const Instruction& part : parts) {
    const bool leads = part.asks == Ask::turn || part.asks == Ask::go;
    if (!(leads && waits_)) follow(sentence, part, time);
  }
}

void SimulatedOperator::follow(const Sentence& sentence, const Instruction& instruction,
                               double time) {
  if (instruction.asks == Ask::halt || instruction.asks == Ask::back) told_to_halt_ = true;
  if (instruction.asks == Ask::ready || instruction.asks == Ask::turn ||
      instruction.asks == Ask::go)
    told_to_halt_ = false;
  switch (instruction.asks) {
    case Ask::nothing:
    case Ask::ready:
      break;
    case Ask::turn:
      turn_to(sentence, instruction);
      straight_before_ = false;
      break;
    case Ask::go:
      // A turn that a sound has led since is not turned back.
      if (turned_by_ear_ < sentence.begun) target_ = sentence.heading;
      turn_speed_ = 0.0;
      mode_ = std::abs(target_ - heading_) > 0.1 ? Mode::turning : Mode::driving;
      go_for(sentence, instruction);
      straight_before_ = true;
      break;
    case Ask::turn_ahead:
      if (mode_ == Mode::driving) {
        stop_at_ = sentence.odometer + instruction.distance.value_or(kBlindTurn);
        if (stop_at_ - odometer_ < 3.0) speed_ = std::min(speed_, config_.slow);
      }
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
      pressed_ = time;
      break;
    case Ask::rest:
      mode_ = Mode::arrived;
      break;
  }
}

double SimulatedOperator::shaped(double stick) const {
  const double beyond = (std::abs(stick) - config_.dead_zone) / (1.0 - config_.dead_zone);
  if (beyond <= 0.0) return 0.0;
  const double curved = (1.0 - config_.expo) * beyond + config_.expo * beyond * beyond * beyond;
  return std::copysign(curved, stick);
}

StickAndButtons SimulatedOperator::drive(double time) const {
  StickAndButtons hand;
  // Near a corner the hand waits for the end of a sentence.
  const bool listening = !hearing_.empty() || !understood_.empty();
  if (listening && stop_at_ - odometer_ < kListenFirst) return hand;
  double speed = time < careful_until_ ? std::min(speed_, config_.slow) : speed_;
  if (stop_at_ - odometer_ < kNearTheEnd) speed = std::min(speed, config_.slow);
  if (left_motor_ > config_.strong_rumble && right_motor_ > config_.strong_rumble) {
    const double excess = (std::min(left_motor_, right_motor_) - config_.strong_rumble) /
                          std::max(0.05, 1.0 - config_.strong_rumble);
    speed = std::min(speed, config_.slow * (1.0 - 0.15 * excess));
  }
  double aim = target_ + (time < veer_until_ ? veer_ : 0.0);
  const double lean = left_motor_ - right_motor_;
  if (std::abs(lean) > kOneSided) aim += lean > 0.0 ? -0.07 : 0.07;
  hand.forward = speed;
  const double error = aim - heading_;
  if (std::abs(error) > 0.04) {
    hand.left = std::copysign(std::clamp(std::abs(error) * 1.5, 0.35, 0.6), error);
  }
  return hand;
}

StickAndButtons SimulatedOperator::act(double time, double dt) {
  StickAndButtons hand;
  if (ticks_ && time - ticks_->last > kTicksOver) ticks_.reset();
  if (waits_ && mode_ != Mode::backing && mode_ != Mode::arrived) {
    mode_ = Mode::waiting;
    return hand;
  }
  if (ticks_ && (mode_ == Mode::turning || mode_ == Mode::driving)) {
    mode_ = Mode::driving;
    target_ = heading_;
    turned_by_ear_ = time;
    return turn_by_ear(time);
  }
  if (mode_ == Mode::turning) {
    const double error = target_ - heading_;
    if (std::abs(error) < std::max(0.02, 0.6 * config_.turn_rate * dt)) {
      mode_ = Mode::driving;
    } else {
      hand.left = std::copysign(1.0, error);
      hand.forward = turn_speed_;
    }
  }
  if (mode_ == Mode::driving) {
    if (odometer_ >= stop_at_) {
      mode_ = Mode::waiting;
      ask_soon(time);
    } else {
      hand = drive(time);
    }
  }
  if (mode_ == Mode::backing) {
    hand.forward = -1.0;
    if (time >= back_until_) {
      mode_ = Mode::waiting;
      ask_soon(time);
    }
  }
  return hand;
}

void SimulatedOperator::ask_when_lost(double time) {
  if (mode_ == Mode::arrived || !hearing_.empty() || !understood_.empty()) return;
  const double patience = mode_ == Mode::waiting ? config_.idle_patience : config_.patience;
  if (time - last_news_ >= patience && time - asked_ >= patience + kPress) asked_ = time;
}

std::string SimulatedOperator::doing() const {
  std::array<char, 64> text{};
  const double turn = std::remainder(heading_ - target_, 2.0 * kPi) * 180.0 / kPi;
  switch (mode_) {
    case Mode::waiting:
      return "waiting";
    case Mode::turning:
      std::snprintf(text.data(), text.size(), "turning %+.0f", turn);
      return text.data();
    case Mode::driving:
      std::snprintf(text.data(), text.size(), "driving %.1f m more, %+.0f", stop_at_ - odometer_,
                    turn);
      return text.data();
    case Mode::backing:
      return "backing";
    case Mode::arrived:
      return "arrived";
  }
  return "";
}

StickAndButtons SimulatedOperator::update(double time, double dt) {
  if (!started_) {
    started_ = true;
    start_ = last_news_ = time;
  }
  std::vector<std::uint32_t> over;
  for (const auto& [id, sentence] : hearing_) {
    const double length = 1.0 + static_cast<double>(sentence.text.size()) / kCharactersPerSecond;
    if (time - sentence.time > length) over.push_back(id);
  }
  for (const auto id : over) understood(id, time);
  // What the ear took in first the hand does first, however long either took.
  while (!understood_.empty() && understood_.front().time <= time) {
    const Sentence sentence = understood_.front();
    understood_.erase(understood_.begin());
    follow(sentence, time);
  }
  while (!heard_.empty() && heard_.front().time <= time) {
    const Heard sound = heard_.front();
    heard_.pop_front();
    follow(sound, time);
  }
  if (time - start_ < kNeutralAtStart) return {};
  be_startled(time);
  StickAndButtons hand = act(time, dt);
  ask_when_lost(time);
  hand.repeat = time - asked_ < kPress;
  hand.start = time - pressed_ < kPress;
  heading_ += shaped(hand.left) * config_.turn_rate * dt;
  odometer_ += shaped(hand.forward) * config_.full_speed * speed_gain_ * dt;
  return hand;
}

}  // namespace navvi_people::people
