#include "navvi_people/people/simulated_operator.hpp"

#include <algorithm>
#include <cmath>

#include "people/traits.hpp"

namespace navvi_people::people {
namespace {

constexpr double kNeutralAtStart = 1.0;  // s
constexpr double kPress = 0.15;          // s, a button is held
constexpr double kOneSided = 0.8;        // of one motor over the other: very near at a side
constexpr double kTicksOver = 1.2;       // s; ticks that paused for so long are over
constexpr double kLeansAway = 0.07;  // rad, from what is felt at a side
constexpr double kTriesAfter = 1.0;  // s, without an answer
// Of a continuous sound, as the lesson teaches it.
constexpr double kOneEar = 0.7;      // rad, of what sounds in one ear alone
constexpr double kSlowest = 0.1;     // of both ears: turn on the spot
constexpr double kOnTheSpot = 0.8;   // rad
constexpr double kStillShown = 2.0;  // s; what is shown for so long after "stop" is followed again
// s, that speech adds to reactions: Mohebbi, Gray and Tan 2009, 16 people
constexpr double kTalkToEar = 0.148;
constexpr double kTalkToHand = 0.053;

/// Each part draws numbers of its own, so that none shifts those of another.
std::uint64_t stream(const SimulatedOperatorConfig& config, std::uint64_t part) {
  Random mix((static_cast<std::uint64_t>(config.seed) << 8U) + part);
  return mix.next();
}

std::uint64_t stream(const SimulatedOperatorConfig& config, std::uint64_t part, int occasion) {
  Random mix(stream(config, part) + static_cast<std::uint64_t>(occasion));
  return mix.next();
}

/// Practice makes quicker and more exact.
SimulatedOperatorConfig practised(SimulatedOperatorConfig config) {
  const double factor = Learning(config.learning).factor();
  for (double* const each :
       {&config.hearing.word_reaction, &config.hearing.sound_reaction, &config.turning.over_slight,
        &config.turning.over_ample, &config.turning.stop_delay, &config.feeling.onset,
        &config.feeling.reading, &config.tracking.delay, &config.tracking.speed_delay})
    *each *= factor;
  return config;
}

Lag lag_of(const SimulatedOperatorConfig& config) {
  const TrackingConfig& ear = config.tracking;
  const FeelingConfig& skin = config.feeling;
  if (config.lead == "hand")
    return {skin.onset, skin.reading, skin.onset, 0.0, 0.5 * (1.0 - skin.recognised)};
  return {ear.delay, ear.speed_delay, config.hearing.sound_reaction, ear.noise, 0.0};
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
    : config_(practised(config)),
      learning_(config.learning),
      ears_(config_.hearing, stream(config, 1, occasion), phrases),
      turning_(config_.turning, stream(config, 2, occasion)),
      driving_(config.driving, stream(config, 3), stream(config, 3, occasion)),
      feeling_(config_.feeling, stream(config, 4, occasion)),
      memory_(config.memory, stream(config, 5, occasion)),
      attention_(config.attention, stream(config, 6, occasion)),
      tracking_(lag_of(config_), config.tracking.faults, stream(config, 7, occasion)) {}

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
  if (!attention_.elsewhere(time)) react(now.meaning, time);
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
void SimulatedOperator::react_to_what_is_due(double time) {
  while (const auto sentence = ears_.next_sentence(time)) react(*sentence, time);
  while (auto tone = ears_.next_tone(time)) {
    if (tone->earcon == Earcon::turn_stop && !tone->much) {
      // Decided; the hand lets go a moment later.
      tone->much = false;
      tone->time = time + turning_.stop_delay();
      ears_.put_off(*tone);
      continue;
    }
    react(*tone, time);
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
  react_to_what_is_due(time);
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
