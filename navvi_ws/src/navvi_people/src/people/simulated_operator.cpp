#include "navvi_people/people/simulated_operator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "people/traits.hpp"

namespace navvi_people::people {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNeutralAtStart = 1.0;   // s
constexpr double kPress = 0.15;           // s, a button is held
constexpr double kSameBump = 15.0;        // s
constexpr double kBackOff = 0.7;          // s
constexpr double kCareful = 5.0;          // s, one goes slowly after hearing of something near
constexpr double kLettersPerSecond = 14;  // at which a sentence without an end is over
constexpr double kNearTheEnd = 1.5;       // m to where one expects to stop
constexpr double kListenFirst = 2.5;      // m, likewise
constexpr double kOneSided = 0.8;         // of one motor over the other: very near at a side
constexpr double kTicksOver = 1.2;        // s; ticks that paused for so long are over
constexpr double kMuchForce = 0.6;        // of the motor that attracts: much is left to turn
constexpr double kSlowTicks = 0.28;       // s, between two: much is left to turn
constexpr double kShortly = 5.0;          // s; what is told after a turn is the rest of it
constexpr double kBackAgain = 0.6;
constexpr double kLeansAway = 0.07;  // rad, from what is felt at a side
constexpr double kTriesAfter = 1.0;  // s, without an answer
constexpr double kStartled = 0.4;    // s, from a word to the hand
constexpr double kBlindTurn = 3.0;   // m to drive after "turn now", which has no distance

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

/// Each part draws numbers of its own, so that none shifts those of another.
std::uint64_t stream(const SimulatedOperatorConfig& config, std::uint64_t part) {
  Random mix((static_cast<std::uint64_t>(config.seed) << 8U) + part);
  return mix.next();
}

HearingConfig practised(HearingConfig config, double factor) {
  config.word_reaction *= factor;
  config.sound_reaction *= factor;
  return config;
}

TurningConfig practised(TurningConfig config, double factor) {
  config.over_slight *= factor;
  config.over_ample *= factor;
  config.stop_delay *= factor;
  return config;
}

FeelingConfig practised(FeelingConfig config, double factor) {
  config.delay *= factor;
  return config;
}

}  // namespace

void SimulatedOperatorConfig::describe(navvi_config::Visitor& visit) {
  const std::string type_before = type;
  const int seed_before = seed;
  visit(seed, "seed", navvi_config::Range{0, 2147483647}, "", "of what the person does");
  visit(type, "type", navvi_config::OneOf{person_types()}, "",
        "sets the traits of doc/people.md; drawn: from the seed");
  const std::string moved_before = moved;
  visit(moved, "moved", navvi_config::Any{}, "",
        "a trait, and by how many standard deviations between people it differs from the type's, "
        "such as hearing/sound_spread+1; empty: none");
  // What is set besides is laid over the type.
  if (type != type_before || (type == "drawn" && seed != seed_before)) become(*this, type, seed);
  if (moved != moved_before) move(*this, moved);
  visit.group("hearing", hearing);
  visit.group("turning", turning);
  visit.group("driving", driving);
  visit.group("feeling", feeling);
  visit.group("memory", memory);
  visit.group("attention", attention);
  visit.group("learning", learning);
  visit(trust, "trust", navvi_config::Range{1.0, 100.0}, "m",
        "driven on without a word after a turn that a sound has ended; assumed");
  visit(obeys, "obeys", navvi_config::Any{}, "",
        "true: after \"stop\" and \"wait\" nothing but \"go on\" moves the hand, as is taught");
}

SimulatedOperator::SimulatedOperator(const SimulatedOperatorConfig& config,
                                     const std::filesystem::path& phrases)
    : config_(config),
      listener_(phrases),
      learning_(config.learning),
      hearing_(practised(config.hearing, learning_.factor()), stream(config, 1)),
      turning_(practised(config.turning, learning_.factor()), stream(config, 2)),
      driving_(config.driving, stream(config, 3)),
      feeling_(practised(config.feeling, learning_.factor()), stream(config, 4)),
      memory_(config.memory, stream(config, 5)),
      attention_(config.attention, stream(config, 6)) {}

void SimulatedOperator::hear(const Heard& heard, double time) {
  if (const auto* const sound = std::get_if<Sound>(&heard))
    hear_sound(*sound, time);
  else
    hear_words(std::get<Speech>(heard), time);
}

void SimulatedOperator::hear_words(const Speech& speech, double time) {
  if (!config_.hearing.words) return;
  switch (speech.moment) {
    case Speech::Moment::begins:
      spoken_to_ = true;
      sentences_[speech.id] = {speech.text, heading_, odometer_, time, time};
      return;
    case Speech::Moment::breaks_off:
      sentences_.erase(speech.id);
      return;
    case Speech::Moment::ends:
      return understood(speech.id, time);
  }
}

void SimulatedOperator::hear_sound(const Sound& sound, double time) {
  const auto tone = hearing_.sound(sound, !sentences_.empty(), time);
  if (!tone || attention_.elsewhere(time)) return;
  tones_.push_back({sound.earcon, tone->side, time + tone->reaction});
}

void SimulatedOperator::follow(const Tone& tone, double time) {
  switch (tone.earcon) {
    case Earcon::turn:
    case Earcon::turn_click:
      return follow_tick(tone, time);
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
      return shy_away({Ask::beware, 12, {}, tone.side}, time);
    case Earcon::shelf_close:
    case Earcon::worker_close:
    case Earcon::forklift_close:
    case Earcon::pallet_robot_close:
    case Earcon::thing_close:
      return shy_away({Ask::beware, 12, {}, tone.side, true}, time);
    case Earcon::arrived:
    case Earcon::beacon:
    case Earcon::sonar:
      return;
  }
}

void SimulatedOperator::follow_tick(const Tone& tick, double time) {
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
  speed_ = config_.driving.cruise;
}

/// A large turn is made on the spot, a small one on the way.
StickAndButtons SimulatedOperator::turn_by_ear(double time) const {
  StickAndButtons hand;
  const double side = ticks_->side == Instruction::Side::left ? 1.0 : -1.0;
  const bool large = ticks_->much;
  hand.left = side * (large ? 1.0 : 0.55);
  if (large || odometer_ >= stop_at_) return hand;
  hand.forward = time < careful_until_ ? 0.5 * config_.driving.slow : 0.7 * config_.driving.slow;
  return hand;
}

void SimulatedOperator::feel(const Felt& felt, double time) { feeling_.feel(felt, time); }

void SimulatedOperator::touch(double time) {
  const Feeling::Now now = feeling_.update(time);
  felt_ = now.force;
  if (attention_.elsewhere(time)) return;
  if (config_.feeling.touch == "attractive") follow_pull(now.force, time);
  follow(now.meaning, time);
}

/// Two motors are a pattern; one is the side to turn to.
void SimulatedOperator::follow_pull(const Felt& force, double time) {
  using Side = Instruction::Side;
  const bool pulls = (force.left > 0.0) != (force.right > 0.0);
  if (pulls)
    follow_tick({Earcon::turn, force.left > 0.0 ? Side::left : Side::right, time,
                 std::max(force.left, force.right) > kMuchForce},
                time);
  else if (pulled_ && force.left == 0.0)
    stop_turn(time);
  pulled_ = pulls;
}

void SimulatedOperator::follow(Meaning meaning, double time) {
  if (mode_ == Mode::arrived) return;
  switch (meaning) {
    case Meaning::none:
    case Meaning::stuck:
      return;
    case Meaning::ready:
      // Once under way, what feels like it is something else.
      if (odometer_ == 0.0) pressed_ = time;
      return;
    case Meaning::begun:
      told_to_halt_ = false;
      last_news_ = time;
      return;
    case Meaning::new_way:
      // The old direction no longer holds; there is a word or a pull to wait for.
      if (mode_ == Mode::driving) stop_at_ = std::min(stop_at_, odometer_ + kNearTheEnd);
      return;
    case Meaning::halt:
    case Meaning::stop:
    case Meaning::hit:
      if (mode_ != Mode::backing) mode_ = Mode::waiting;
      careful_until_ = time + kCareful;
      return;
    case Meaning::arrived:
      mode_ = Mode::arrived;
      return;
  }
}

void SimulatedOperator::understood(std::uint32_t id, double time) {
  const auto found = sentences_.find(id);
  if (found == sentences_.end()) return;
  Sentence sentence = found->second;
  sentences_.erase(found);
  const auto ear = hearing_.words(sentence.text, time - sentence.begun);
  if (!ear || attention_.elsewhere(time)) return;
  sentence.time = time + ear->reaction;
  sentence.parts = Hearing::as_heard(*ear, listener_.understand(sentence.text));
  understood_.push_back(sentence);
  // A thing nearby, or a later turn, is no news while waiting for a direction.
  const auto idle = [](const Instruction& part) {
    return part.asks == Ask::beware || part.asks == Ask::turn_ahead;
  };
  if (mode_ != Mode::waiting || !std::all_of(sentence.parts.begin(), sentence.parts.end(), idle))
    last_news_ = time;
}

void SimulatedOperator::turn_to(const Sentence& sentence, const Instruction& instruction,
                                double time) {
  double angle = angle_of(instruction.hour, instruction.slight, straight_before_);
  if (turned_to_ && sentence.begun > turned_at_ && sentence.begun - turned_at_ < kShortly)
    learning_.turned(*turned_to_, angle);
  // Sent back from where one has just turned, one turns back by less.
  const bool back = turned_to_ && angle * *turned_to_ < 0.0 && time - turned_at_ < kShortly;
  turned_to_ = angle;
  turned_at_ = time;
  if (back) angle *= kBackAgain;
  const double learnt = std::copysign(learning_.bias(), angle);
  target_ = sentence.heading - turning_.made((angle + learnt) * driving_.turn_gain());
  const bool far = instruction.distance.value_or(0.0) > kListenFirst;
  turn_speed_ =
      std::abs(angle) < 0.4 && far && mode_ == Mode::driving ? config_.driving.slow * 0.7 : 0.0;
  mode_ = Mode::turning;
  go_for(sentence, instruction);
  speed_ = std::min(speed_, 0.5 * (config_.driving.slow + config_.driving.cruise));
}

void SimulatedOperator::go_for(const Sentence& sentence, const Instruction& instruction) {
  const double distance = instruction.distance.value_or(kBlindTurn);
  const double begun = mode_ == Mode::turning ? odometer_ : sentence.odometer;
  stop_at_ = std::max(begun + distance, odometer_ + 0.6);
  speed_ = stop_at_ - odometer_ > 3.0 ? config_.driving.cruise : config_.driving.slow;
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

void SimulatedOperator::ask_soon(double time) {
  last_news_ = time - config_.attention.idle_patience + 0.4;
}

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
  for (const auto& [id, sentence] : sentences_) {
    const double heard = (time - sentence.begun - kStartled) * kLettersPerSecond;
    const Listener::FirstWord word = listener_.first_word(sentence.text, heard);
    if (mode_ == Mode::arrived || heard <= 0.0 || !word.startles) continue;
    mode_ = Mode::waiting;
    wait_for_go_on(sentence, word.holds);
  }
}

void SimulatedOperator::wait_for_go_on(const Sentence& sentence, bool holds) {
  if (!config_.obeys || !holds) return;
  waits_ = std::max(waits_.value_or(sentence.begun), sentence.begun);
  told_to_halt_ = true;
}

void SimulatedOperator::follow(const Sentence& sentence, double time) {
  const std::vector<Instruction>& parts = sentence.parts;
  wait_for_go_on(sentence, !parts.empty() && parts.front().holds);
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
      // A sound that leads this turn leads it whether or not the words are kept in mind.
      if (!memory_.keeps(config_.driving.cruise, time)) break;
      turn_to(sentence, instruction, time);
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
        if (stop_at_ - odometer_ < 3.0) speed_ = std::min(speed_, config_.driving.slow);
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

StickAndButtons SimulatedOperator::drive(double time) const {
  StickAndButtons hand;
  // Near a corner the hand waits for the end of a sentence.
  const bool listening = !sentences_.empty() || !understood_.empty();
  if (listening && stop_at_ - odometer_ < kListenFirst) return hand;
  const double slow = config_.driving.slow;
  double speed = time < careful_until_ ? std::min(speed_, slow) : speed_;
  if (stop_at_ - odometer_ < kNearTheEnd) speed = std::min(speed, slow);
  const bool repulsive = config_.feeling.touch == "repulsive";
  const double both = std::min(felt_.left, felt_.right);
  const double strong = config_.feeling.strong;
  if (repulsive && both > strong)
    speed = std::min(speed, slow * (1.0 - 0.5 * (both - strong) / std::max(0.05, 1.0 - strong)));
  double aim = target_ + (time < veer_until_ ? veer_ : 0.0);
  const double lean = felt_.left - felt_.right;
  if (repulsive && std::abs(lean) > kOneSided) aim += lean > 0.0 ? -kLeansAway : kLeansAway;
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
    if (std::abs(error) < std::max(0.02, 0.6 * config_.driving.turn_rate * dt)) {
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
  if (mode_ == Mode::waiting && !spoken_to_ && !told_to_halt_ && time - asked_ > kTriesAfter &&
      asked_ > start_)
    go_ahead();
  if (mode_ == Mode::backing) {
    hand.forward = -1.0;
    if (time >= back_until_) {
      mode_ = Mode::waiting;
      ask_soon(time);
    }
  }
  return hand;
}

/// Where nobody speaks, one tries.
void SimulatedOperator::go_ahead() {
  mode_ = Mode::driving;
  target_ = heading_;
  stop_at_ = odometer_ + 0.5 * config_.trust;
  speed_ = config_.driving.slow;
}

void SimulatedOperator::ask_when_lost(double time) {
  if (mode_ == Mode::arrived || !sentences_.empty() || !understood_.empty()) return;
  const double patience =
      mode_ == Mode::waiting ? config_.attention.idle_patience : config_.attention.patience;
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

void SimulatedOperator::forget_sentences_without_end(double time) {
  std::vector<std::uint32_t> over;
  for (const auto& [id, sentence] : sentences_) {
    const double length = 1.0 + static_cast<double>(sentence.text.size()) / kLettersPerSecond;
    if (time - sentence.begun > length) over.push_back(id);
  }
  for (const auto id : over) understood(id, time);
}

/// What the ear took in first the hand does first, however long either took.
void SimulatedOperator::follow_what_is_due(double time) {
  while (!understood_.empty() && understood_.front().time <= time) {
    const Sentence sentence = understood_.front();
    understood_.erase(understood_.begin());
    follow(sentence, time);
  }
  while (!tones_.empty() && tones_.front().time <= time) {
    Tone tone = tones_.front();
    tones_.pop_front();
    if (tone.earcon == Earcon::turn_stop && !tone.much) {
      // Decided; the hand lets go a moment later.
      tone.much = false;
      tone.time = time + turning_.stop_delay();
      tones_.push_front(tone);
      continue;
    }
    follow(tone, time);
  }
}

void SimulatedOperator::believe(const StickAndButtons& hand, double dt) {
  const DrivingConfig& driving = config_.driving;
  const double driven = driving_.shaped(hand.forward) * driving.full_speed * dt;
  heading_ += driving_.shaped(hand.left) * driving.turn_rate * dt;
  if (mode_ == Mode::driving && hand.forward > 0.0) heading_ += driving_.veered(driven);
  odometer_ += driven * driving_.speed_gain();
}

StickAndButtons SimulatedOperator::update(double time, double dt,
                                          const std::optional<StickAndButtons>& held) {
  meant_ = {};
  if (!started_) {
    started_ = true;
    start_ = last_news_ = time;
  }
  forget_sentences_without_end(time);
  follow_what_is_due(time);
  touch(time);
  if (time - start_ < kNeutralAtStart) return {};
  be_startled(time);
  StickAndButtons hand = act(time, dt);
  const StickAndButtons& moves = held ? *held : hand;
  attention_.update(moves.forward != 0.0 || moves.left != 0.0, time, dt);
  if (gave_up()) return {};
  ask_when_lost(time);
  hand.repeat = time - asked_ < kPress;
  hand.start = time - pressed_ < kPress;
  meant_ = hand;
  believe(held.value_or(hand), dt);
  hand.left = driving_.trembling(hand.left, dt);
  hand.forward = driving_.trembling(hand.forward, dt);
  return hand;
}

}  // namespace navvi_people::people
