#include "navvi_people/people/simulated_operator.hpp"

#include <algorithm>
#include <utility>

#include "people/traits.hpp"

namespace navvi_people::people {
namespace {

constexpr double kNeutralAtStart = 1.0;  // s
constexpr double kPress = 0.15;          // s, a button is held
// Of a continuous sound, as the lesson teaches it.
constexpr double kOneEar = 0.7;   // rad, of what sounds in one ear alone
constexpr double kSlowest = 0.1;  // of both ears: turn on the spot

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

/// The one parameter of a part whose other numbers are traits.
struct Faults {
  bool& faults;
  const char* without;

  void describe(navvi_config::Visitor& visit) {
    visit(faults, "faults", navvi_config::Any{}, "", std::string("false: ") + without);
  }
};

}  // namespace

void SimulatedOperatorConfig::describe(navvi_config::Visitor& visit) {
  const auto faults = [&](const char* part, bool& value, const char* without) {
    Faults described{value, without};
    visit.group(part, described);
  };
  visit(seed, "seed", navvi_config::Range{0, 2147483647}, "",
        "of a drawn person's traits, and, with the world's seed, of what the person does");
  visit(type, "type", navvi_config::OneOf{person_types()}, "",
        "sets the traits of doc/people.md; drawn: from the seed; deafblind and noise: typical, but "
        "for what is heard");
  visit(worse, "worse", navvi_config::Range{0.5, 3.0}, "",
        "times delays, errors and misses of the type");
  visit(lead, "lead", navvi_config::OneOf{{"words", "ticks", "flow", "hand"}}, "",
        "the way of leading that the person was taught; a batch takes feedback/lead");
  visit.group("hearing", hearing);
  faults("turning", turning.faults, "turns are as long as they should be");
  faults("driving", driving.faults,
         "the hand is steady, holds its heading and knows the robot exactly");
  visit.group("feeling", feeling);
  faults("tracking", tracking.faults, "a continuous display is followed late, but exactly");
  faults("memory", memory.faults, "every turn is kept in mind");
  faults("attention", attention.faults, "never distracted, never gives up");
  visit.group("learning", learning);
}

SimulatedOperator::SimulatedOperator(const SimulatedOperatorConfig& config, Listener listener,
                                     int occasion)
    : config_(practised(config)),
      learning_(config.learning),
      ears_(config_.hearing, stream(config, 1, occasion), std::move(listener)),
      turning_(config_.turning, stream(config, 2, occasion)),
      driving_(config.driving, stream(config, 3), stream(config, 3, occasion)),
      feeling_(config_.feeling, stream(config, 4, occasion)),
      memory_(config.memory, stream(config, 5, occasion)),
      attention_(config.attention, stream(config, 6, occasion)),
      tracking_(lag_of(config_), config.tracking.faults, stream(config, 7, occasion)),
      now_{config_.driving.cruise, config_.attention.idle_patience} {}

void SimulatedOperator::hear(const Heard& heard, double time) {
  const auto* const sound = std::get_if<Sound>(&heard);
  if (sound != nullptr && sound->earcon == Earcon::flow)
    flow_ = aim_of(*sound);
  else if (sound != nullptr)
    ears_.sounds(*sound, attention_.elsewhere(time), time);
  else
    hear_words(std::get<Speech>(heard), time);
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

void SimulatedOperator::ask_when_lost(double time) {
  if (now_.mode == Mode::arrived || ears_.listen()) return;
  const double patience =
      now_.mode == Mode::waiting ? now_.idle_patience : config_.attention.patience;
  if (time - now_.news >= patience && time - now_.asked >= patience + kPress) now_.asked = time;
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
  now_.at.heading += driving_.shaped(hand.left) * driving.kTurnRate * dt;
  if (now_.mode == Mode::driving && hand.forward > 0.0) now_.at.heading += driving_.veered(driven);
  now_.at.odometer += driven * driving_.speed_gain();
  if (hand.forward != 0.0 || hand.left != 0.0) now_.pulled = hand.forward < 0.0;
}

StickAndButtons SimulatedOperator::update(double time, double dt) {
  if (!now_.start) now_.start = now_.news = time;
  for (const auto id : ears_.without_end(time)) understood(id, time);
  react_to_what_is_due(time);
  touch(time);
  if (time - *now_.start < kNeutralAtStart) return {};
  be_startled(time);
  StickAndButtons hand = act(time, dt);
  attention_.update(hand.forward != 0.0 || hand.left != 0.0, time, dt);
  if (gave_up()) return {};
  ask_when_lost(time);
  hand.repeat = time - now_.asked < kPress;
  hand.start = time - now_.pressed < kPress;
  believe(hand, dt);
  hand.left = driving_.trembling(hand.left, dt);
  hand.forward = driving_.trembling(hand.forward, dt);
  return hand;
}

}  // namespace navvi_people::people
