#include "navvi_people/people/simulated_operator.hpp"

#include <algorithm>
#include <cmath>

#include "people/traits.hpp"

namespace navvi_people::people {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNeutralAtStart = 1.0;  // s
constexpr double kPress = 0.15;          // s, a button is held
constexpr double kAwaited = 3.0;         // s, that a person waits for what a press does
constexpr double kSameBump = 15.0;       // s
constexpr double kBackOff = 0.7;         // s
constexpr double kCareful = 5.0;         // s, one goes slowly after hearing of something near
constexpr double kNearTheEnd = 1.5;      // m to where one expects to stop
constexpr double kListenFirst = 2.5;     // m, likewise
constexpr double kOneSided = 0.8;        // of one motor over the other: very near at a side
constexpr double kTicksOver = 1.2;       // s; ticks that paused for so long are over
constexpr double kSlowTicks = 0.28;      // s, between two: much is left to turn
constexpr double kShortly = 5.0;         // s; what is told after a turn is the rest of it
constexpr double kBackAgain = 0.6;
constexpr double kLeansAway = 0.07;  // rad, from what is felt at a side
constexpr double kTriesAfter = 1.0;  // s, without an answer
constexpr double kStartled = 0.4;    // s, from a word to the hand
constexpr double kBlindTurn = 3.0;   // m to drive after "turn now", which has no distance
// Of a continuous sound, as the lesson teaches it.
constexpr double kOneEar = 0.7;      // rad, of what sounds in one ear alone
constexpr double kSlowest = 0.1;     // of both ears: turn on the spot
constexpr double kOnTheSpot = 0.8;   // rad
constexpr double kStillShown = 2.0;  // s; what is shown for so long after "stop" is followed again
constexpr double kShownLately = 8.0;  // s
// s, that speech adds to reactions: Mohebbi, Gray and Tan 2009, 16 people
constexpr double kTalkToEar = 0.148;
constexpr double kTalkToHand = 0.053;

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

std::uint64_t stream(const SimulatedOperatorConfig& config, std::uint64_t part, int occasion) {
  Random mix(stream(config, part) + static_cast<std::uint64_t>(occasion));
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
  config.onset *= factor;
  config.reading *= factor;
  return config;
}

Lag lag_of(const SimulatedOperatorConfig& config, double factor) {
  const TrackingConfig& ear = config.tracking;
  const FeelingConfig& skin = config.feeling;
  Lag lag{ear.delay, ear.speed_delay, config.hearing.sound_reaction, ear.noise, 0.0};
  if (config.lead == "hand")
    lag = {skin.onset, skin.reading, skin.onset, 0.0, 0.5 * (1.0 - skin.recognised)};
  lag.steer *= factor;
  lag.speed *= factor;
  lag.stop *= factor;
  return lag;
}

std::optional<Aim> aim_of(const Sound& sound) {
  const double both = sound.left + sound.right;
  if (both <= 0.0) return std::nullopt;
  return Aim{kOneEar * (sound.right - sound.left) / both,
             std::clamp((both - kSlowest) / (1.0 - kSlowest), 0.0, 1.0)};
}

}  // namespace

void SimulatedOperatorConfig::describe(navvi_config::Visitor& visit) {
  const std::string type_before = type;
  const int seed_before = seed;
  const double worse_before = worse;
  visit(seed, "seed", navvi_config::Range{0, 2147483647}, "",
        "of a drawn person's traits, and, with the world's seed, of what the person does");
  visit(type, "type", navvi_config::OneOf{person_types()}, "",
        "sets the traits of doc/people.md; drawn: from the seed; deafblind and noise: typical, but "
        "for what is heard");
  visit(worse, "worse", navvi_config::Range{0.5, 3.0}, "",
        "times delays, errors and misses of the type");
  visit(lead, "lead", navvi_config::OneOf{{"words", "ticks", "flow", "hand"}}, "",
        "the way of leading that the person was taught; a batch takes feedback/lead");
  // What is set besides is laid over the type.
  if (type != type_before || worse != worse_before || (type == "drawn" && seed != seed_before))
    become(*this, type, seed);
  visit.group("hearing", hearing);
  visit.group("turning", turning);
  visit.group("driving", driving);
  visit.group("feeling", feeling);
  visit.group("tracking", tracking);
  visit.group("memory", memory);
  visit.group("attention", attention);
  visit.group("learning", learning);
}

SimulatedOperator::SimulatedOperator(const SimulatedOperatorConfig& config,
                                     const std::filesystem::path& phrases, int occasion)
    : config_(config),
      learning_(config.learning),
      ears_(practised(config.hearing, learning_.factor()), stream(config, 1, occasion), phrases),
      turning_(practised(config.turning, learning_.factor()), stream(config, 2, occasion)),
      driving_(config.driving, stream(config, 3), stream(config, 3, occasion)),
      feeling_(practised(config.feeling, learning_.factor()), stream(config, 4, occasion)),
      memory_(config.memory, stream(config, 5, occasion)),
      attention_(config.attention, stream(config, 6, occasion)),
      tracking_(lag_of(config, learning_.factor()), config.tracking.faults,
                stream(config, 7, occasion)) {}

void SimulatedOperator::hear(const Heard& heard, double time) {
  const auto* const sound = std::get_if<Sound>(&heard);
  if (sound != nullptr && sound->earcon == Earcon::flow)
    flow_ = aim_of(*sound);
  else if (sound != nullptr)
    ears_.sounds(*sound, attention_.elsewhere(time), time);
  else
    hear_words(std::get<Speech>(heard), time);
}

void SimulatedOperator::hear_words(const Speech& speech, double time) {
  if (!config_.hearing.words) return;
  switch (speech.moment) {
    case Speech::Moment::begins:
      words_.spoken_to = true;
      return ears_.begins(speech, at_, time);
    case Speech::Moment::breaks_off:
      return ears_.breaks_off(speech.id);
    case Speech::Moment::ends:
      return understood(speech.id, time);
  }
}

void SimulatedOperator::follow(const Tone& tone, double time) {
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

/// A large turn is made on the spot, a small one on the way.
StickAndButtons SimulatedOperator::turn_by_ear(double time) const {
  StickAndButtons hand;
  const double side = sounds_.ticks->side == Instruction::Side::left ? 1.0 : -1.0;
  const bool large = sounds_.ticks->much;
  hand.left = side * (large ? 1.0 : 0.55);
  if (large || at_.odometer >= course_.stop_at) return hand;
  hand.forward =
      time < when_.careful_until ? 0.5 * config_.driving.kSlow : 0.7 * config_.driving.kSlow;
  return hand;
}

void SimulatedOperator::feel(const Felt& felt, double time) {
  feeling_.feel(felt, time);
  if (config_.lead == "hand") pulses_.feel(feeling_.felt_of(felt), time);
}

void SimulatedOperator::touch(double time) {
  const Feeling::Now now = feeling_.update(time);
  if (config_.lead != "hand") felt_ = now.force;
  if (!attention_.elsewhere(time)) follow(now.meaning, time);
}

/// Words and taps ask for it at about the same time.
void SimulatedOperator::press_start(double time) {
  if (time - when_.pressed > kAwaited) when_.pressed = time;
}

void SimulatedOperator::follow(Meaning meaning, double time) {
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

void SimulatedOperator::understood(std::uint32_t id, double time) {
  const Sentence* const sentence = ears_.ends(id, attention_.elsewhere(time), time);
  if (sentence == nullptr) return;
  // A thing nearby, or a later turn, is no news while waiting for a direction.
  const auto idle = [](const Instruction& part) {
    return part.asks == Ask::beware || part.asks == Ask::turn_ahead;
  };
  if (mode_ != Mode::waiting || !std::all_of(sentence->parts.begin(), sentence->parts.end(), idle))
    when_.news = time;
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

void SimulatedOperator::follow(const Sentence& sentence, double time) {
  const std::vector<Instruction>& parts = sentence.parts;
  wait_for_go_on(sentence, !parts.empty() && parts.front().holds);
  if (!parts.empty() && parts.front().goes_on && words_.waits && sentence.begun > *words_.waits)
    words_.waits.reset();
  // Where a display leads, its end is to stand, whatever direction is told besides.
  const bool shown = time - when_.shown < kShownLately;
  for (const Instruction& part : parts) {
    const bool leads = part.asks == Ask::turn || part.asks == Ask::go;
    if (!(leads && (words_.waits || shown))) follow(sentence, part, time);
  }
}

void SimulatedOperator::expect_turn(const Sentence& sentence, const Instruction& turn) {
  course_.stop_at = sentence.at.odometer + turn.distance.value_or(kBlindTurn);
  if (course_.stop_at - at_.odometer < 3.0)
    course_.speed = std::min(course_.speed, config_.driving.kSlow);
}

void SimulatedOperator::follow(const Sentence& sentence, const Instruction& instruction,
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

StickAndButtons SimulatedOperator::drive(double time) const {
  StickAndButtons hand;
  // Near a corner the hand waits for the end of a sentence.
  if (ears_.listen() && course_.stop_at - at_.odometer < kListenFirst) return hand;
  const double slow = config_.driving.kSlow;
  double speed = time < when_.careful_until ? std::min(course_.speed, slow) : course_.speed;
  if (course_.stop_at - at_.odometer < kNearTheEnd) speed = std::min(speed, slow);
  const double both = std::min(felt_.left, felt_.right);
  const double strong = config_.feeling.kStrong;
  if (both > strong)
    speed = std::min(speed, slow * (1.0 - 0.5 * (both - strong) / std::max(0.05, 1.0 - strong)));
  double aim = course_.target + (time < course_.veer_until ? course_.veer : 0.0);
  const double lean = felt_.left - felt_.right;
  if (std::abs(lean) > kOneSided) aim += lean > 0.0 ? -kLeansAway : kLeansAway;
  hand.forward = speed;
  const double error = aim - at_.heading;
  if (std::abs(error) > 0.04) {
    hand.left = std::copysign(std::clamp(std::abs(error) * 1.5, 0.35, 0.6), error);
  }
  return hand;
}

/// By a continuous sound, or the pulses of the motors: to where they show, as fast as they show,
/// and no faster than is liked. They are "go", too: after a word to stop one waits until they end
/// and come again, or go on all the same.
/// \return nullopt: neither leads
std::optional<StickAndButtons> SimulatedOperator::follow_display(double time, double dt) {
  const bool by_hand = config_.lead == "hand";
  if (!by_hand && config_.lead != "flow") return std::nullopt;
  if (by_hand)
    tracking_.show(pulses_.update(time), time);
  else
    tracking_.show(ears_.noisy(dt) ? std::nullopt : flow_, time);
  const double talk = !ears_.listen() ? 0.0 : by_hand ? kTalkToHand : kTalkToEar;
  const std::optional<Aim> aim = tracking_.update(time, dt, talk);
  if (!aim || mode_ == Mode::backing || mode_ == Mode::arrived) return std::nullopt;
  mode_ = Mode::waiting;
  when_.news = when_.shown = time;
  if (words_.waits && *tracking_.since() < *words_.waits &&
      time - *words_.waits < kStillShown)
    return StickAndButtons{};
  words_.waits.reset();
  words_.told_to_halt = false;
  if (attention_.elsewhere(time)) return held_;
  const DrivingConfig& driving = config_.driving;
  held_ = {};
  held_.left = driving_.stick_for(-tracking_.gain() * aim->turn / driving.kTurnRate);
  if (std::abs(aim->turn) < kOnTheSpot)
    held_.forward = driving_.stick_for(std::min(driving_.shaped(driving.cruise), aim->speed));
  return held_;
}

StickAndButtons SimulatedOperator::act(double time, double dt) {
  StickAndButtons hand;
  if (const auto led = follow_display(time, dt)) return *led;
  if (sounds_.ticks && time - sounds_.ticks->last > kTicksOver) sounds_.ticks.reset();
  if (words_.waits && mode_ != Mode::backing && mode_ != Mode::arrived) {
    mode_ = Mode::waiting;
    return hand;
  }
  if (sounds_.ticks && (mode_ == Mode::turning || mode_ == Mode::driving)) {
    mode_ = Mode::driving;
    course_.target = at_.heading;
    sounds_.turned = time;
    return turn_by_ear(time);
  }
  if (mode_ == Mode::turning) {
    const double error = course_.target - at_.heading;
    if (std::abs(error) < std::max(0.02, 0.6 * config_.driving.kTurnRate * dt)) {
      mode_ = Mode::driving;
    } else {
      hand.left = std::copysign(1.0, error);
      hand.forward = course_.turn_speed;
    }
  }
  if (mode_ == Mode::driving) {
    if (at_.odometer >= course_.stop_at) {
      mode_ = Mode::waiting;
      ask_soon(time);
    } else {
      hand = drive(time);
    }
  }
  if (mode_ == Mode::waiting && !words_.spoken_to && !words_.told_to_halt &&
      when_.shown < when_.start && time - when_.asked > kTriesAfter && when_.asked > when_.start)
    go_ahead();
  if (mode_ == Mode::backing) {
    hand.forward = -1.0;
    if (time >= backing_.until) {
      mode_ = Mode::waiting;
      ask_soon(time);
    }
  }
  return hand;
}

/// Where nobody speaks, one tries.
void SimulatedOperator::go_ahead() {
  mode_ = Mode::driving;
  course_.target = at_.heading;
  course_.stop_at = at_.odometer + 0.5 * config_.kTrust;
  course_.speed = config_.driving.kSlow;
}

void SimulatedOperator::ask_when_lost(double time) {
  if (mode_ == Mode::arrived || ears_.listen()) return;
  const double patience =
      mode_ == Mode::waiting ? config_.attention.idle_patience : config_.attention.patience;
  if (time - when_.news >= patience && time - when_.asked >= patience + kPress) when_.asked = time;
}

/// What the ear took in first the hand does first, however long either took.
void SimulatedOperator::follow_what_is_due(double time) {
  while (const auto sentence = ears_.next_sentence(time)) follow(*sentence, time);
  while (auto tone = ears_.next_tone(time)) {
    if (tone->earcon == Earcon::turn_stop && !tone->much) {
      // Decided; the hand lets go a moment later.
      tone->much = false;
      tone->time = time + turning_.stop_delay();
      ears_.put_off(*tone);
      continue;
    }
    follow(*tone, time);
  }
}

void SimulatedOperator::believe(const StickAndButtons& hand, double dt) {
  const DrivingConfig& driving = config_.driving;
  const double driven = driving_.shaped(hand.forward) * driving.kFullSpeed * dt;
  at_.heading += driving_.shaped(hand.left) * driving.kTurnRate * dt;
  if (mode_ == Mode::driving && hand.forward > 0.0) at_.heading += driving_.veered(driven);
  at_.odometer += driven * driving_.speed_gain();
}

StickAndButtons SimulatedOperator::update(double time, double dt) {
  if (!when_.started) {
    when_.started = true;
    when_.start = when_.news = time;
  }
  for (const auto id : ears_.without_end(time)) understood(id, time);
  follow_what_is_due(time);
  touch(time);
  if (time - when_.start < kNeutralAtStart) return {};
  be_startled(time);
  StickAndButtons hand = act(time, dt);
  attention_.update(hand.forward != 0.0 || hand.left != 0.0, time, dt);
  if (gave_up()) return {};
  ask_when_lost(time);
  hand.repeat = time - when_.asked < kPress;
  hand.start = time - when_.pressed < kPress;
  believe(hand, dt);
  hand.left = driving_.trembling(hand.left, dt);
  hand.forward = driving_.trembling(hand.forward, dt);
  return hand;
}

}  // namespace navvi_people::people
