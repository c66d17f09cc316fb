#include "people/traits.hpp"

#include <algorithm>
#include <set>

namespace navvi_people::people {
namespace {

using Config = SimulatedOperatorConfig;

constexpr std::uint64_t kTraits = 0x7065727365;  // so that traits are not drawn as acts are

/// Delays, errors and misses grow; what is liked, borne and learnt does not.
double worsened(const Trait& trait, double value, double worse) {
  static const std::set<std::string> liked = {"driving/cruise", "attention/gives_up",
                                              "learning/rate"};
  const std::string name = trait.name;
  if (liked.count(name) > 0) return value;
  if (name == "feeling/recognised") return std::max(0.0, 1.0 - worse * (1.0 - value));
  return name == "hearing/fastest_speech" ? value / worse : value * worse;
}

}  // namespace

#define TRAIT(part, name) \
  #part "/" #name, [](Config& c) -> double& { return c.part.name; }

const std::vector<Trait>& traits() {
  static const std::vector<Trait> all = {
      {TRAIT(hearing, word_reaction), 0.65, 0.95, 1.45, 0.3, "s"},
      {TRAIT(hearing, word_spread), 0.2, 0.25, 0.3, 0.2, ""},
      {TRAIT(hearing, sound_reaction), 0.3, 0.6, 0.95, 0.3, "s"},
      {TRAIT(hearing, sound_spread), 0.15, 0.3, 0.35, 0.2, ""},
      {TRAIT(hearing, missed_words), 0.01, 0.05, 0.15, 0.5, ""},
      {TRAIT(hearing, missed_sounds), 0.02, 0.05, 0.15, 0.5, ""},
      {TRAIT(hearing, misheard), 0.01, 0.05, 0.10, 0.5, ""},
      {TRAIT(hearing, mirrored), 0.005, 0.02, 0.05, 0.5, ""},
      {TRAIT(hearing, masked), 0.05, 0.1, 0.3, 0.5, ""},
      {TRAIT(hearing, fastest_speech), 30.0, 22.0, 17.0, 0.15, "1/s"},
      {TRAIT(turning, over_slight), 8.5, 17.4, 23.0, 0.2, "deg"},
      {TRAIT(turning, over_ample), 6.5, 13.4, 18.0, 0.2, "deg"},
      {TRAIT(turning, over_spread), 3.0, 3.9, 6.0, 0.1, "deg"},
      {TRAIT(turning, stop_delay), 0.05, 0.1, 0.2, 0.3, "s"},
      {TRAIT(turning, stop_spread), 0.2, 0.3, 0.4, 0.2, ""},
      {TRAIT(driving, cruise), 0.85, 0.8, 0.7, 0.12, ""},
      {TRAIT(driving, gain_error), 0.05, 0.1, 0.15, 0.2, ""},
      {TRAIT(driving, noise), 0.03, 0.1, 0.15, 0.3, ""},
      {TRAIT(driving, veer), 0.3, 0.8, 1.5, 0.5, "deg/m"},
      {TRAIT(driving, veer_spread), 0.5, 1.0, 2.0, 0.3, "deg"},
      {TRAIT(feeling, threshold), 0.05, 0.08, 0.2, 0.3, ""},
      {TRAIT(feeling, reading), 1.0, 1.5, 2.0, 0.2, "s"},
      {TRAIT(feeling, spread), 0.15, 0.2, 0.3, 0.2, ""},
      {TRAIT(feeling, recognised), 0.98, 0.9, 0.7, 0.05, ""},
      {TRAIT(memory, lost), 0.1, 0.25, 0.5, 0.4, ""},
      {TRAIT(attention, distractions), 0.2, 0.5, 1.0, 0.5, "1/min"},
      {TRAIT(attention, distracted), 1.5, 2.0, 3.0, 0.3, "s"},
      {TRAIT(attention, gives_up), 240.0, 180.0, 120.0, 0.4, "s"},
      {TRAIT(learning, rate), 0.15, 0.15, 0.15, 0.3, ""},
      {TRAIT(feeling, onset), 0.45, 0.65, 0.95, 0.2, "s"},
      {TRAIT(tracking, delay), 0.3, 0.5, 0.8, 0.2, "s"},
      {TRAIT(tracking, speed_delay), 0.45, 0.7, 1.0, 0.2, "s"},
      {TRAIT(tracking, noise), 0.15, 0.25, 0.35, 0.2, ""},
  };
  return all;
}

const std::vector<std::string>& person_types() {
  static const std::vector<std::string> all = {"able",  "typical",   "struggling",
                                               "drawn", "deafblind", "noise"};
  return all;
}

SimulatedOperatorConfig SimulatedOperatorConfig::typed() const {
  SimulatedOperatorConfig person = *this;
  Random random(static_cast<std::uint64_t>(seed) ^ kTraits);
  for (const Trait& trait : traits()) {
    double value = trait.typical;
    if (type == "able") value = trait.able;
    if (type == "struggling") value = trait.struggling;
    if (type == "drawn") value = random.lognormal(trait.typical, trait.between);
    value = worsened(trait, value, worse);
    // A share, a stick, a force.
    if (std::string(trait.unit).empty()) value = std::min(value, 1.0);
    trait.of(person) = value;
  }
  if (type == "deafblind") person.hearing.words = person.hearing.sounds = false;
  if (type == "noise" && hearing.noise == 0.0) person.hearing.noise = 0.5;
  return person;
}

}  // namespace navvi_people::people
