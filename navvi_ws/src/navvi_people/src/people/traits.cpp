#include "people/traits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

namespace navvi_people::people {
namespace {

using Config = SimulatedOperatorConfig;

constexpr const char* kAssumed = "assumed";
constexpr const char* kNobody = "-";
constexpr std::uint64_t kTraits = 0x7065727365;  // so that traits are not drawn as acts are
constexpr const char* kRotation = "ASSETS'18, doi 10.1145/3234695.3236363";
constexpr const char* kRotationPeople = "11 blind people, 26 turns each";
constexpr const char* kTurningBody =
    "of a walking body turning on the spot; taken for a robot "
    "turned by a stick, which is assumed";

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

const std::vector<Trait>& traits() {
  static const std::vector<Trait> all = {
      {"hearing/word_reaction", [](Config& c) -> double& { return c.hearing.word_reaction; }, 0.65,
       0.95, 1.45, 0.3, "s", kAssumed, kNobody,
       "Ohn-Bar et al. (IMWUT'18) found that people differ (p < .0001); mean and spread are not "
       "printed in what was read"},
      {"hearing/word_spread", [](Config& c) -> double& { return c.hearing.word_spread; }, 0.2, 0.25,
       0.3, 0.2, "", kAssumed, kNobody, "-"},
      {"hearing/sound_reaction", [](Config& c) -> double& { return c.hearing.sound_reaction; }, 0.3,
       0.6, 0.95, 0.3, "s", kAssumed, kNobody, "-"},
      {"hearing/sound_spread", [](Config& c) -> double& { return c.hearing.sound_spread; }, 0.15,
       0.3, 0.35, 0.2, "", kAssumed, kNobody, "-"},
      {"hearing/missed_words", [](Config& c) -> double& { return c.hearing.missed_words; }, 0.01,
       0.05, 0.15, 0.5, "", kAssumed, kNobody, "-"},
      {"hearing/missed_sounds", [](Config& c) -> double& { return c.hearing.missed_sounds; }, 0.02,
       0.05, 0.15, 0.5, "", kAssumed, kNobody, "-"},
      {"hearing/misheard", [](Config& c) -> double& { return c.hearing.misheard; }, 0.01, 0.05,
       0.10, 0.5, "", kAssumed, kNobody, "-"},
      {"hearing/mirrored", [](Config& c) -> double& { return c.hearing.mirrored; }, 0.005, 0.02,
       0.05, 0.5, "", kAssumed, kNobody, "-"},
      {"hearing/masked", [](Config& c) -> double& { return c.hearing.masked; }, 0.05, 0.1, 0.3, 0.5,
       "", kAssumed, kNobody, "-"},
      {"hearing/fastest_speech", [](Config& c) -> double& { return c.hearing.fastest_speech; },
       30.0, 22.0, 17.0, 0.15, "1/s", kAssumed, kNobody, "-"},
      {"turning/over_slight", [](Config& c) -> double& { return c.turning.over_slight; }, 8.5, 17.4,
       23.0, 0.2, "deg", kRotation, kRotationPeople, kTurningBody},
      {"turning/over_ample", [](Config& c) -> double& { return c.turning.over_ample; }, 6.5, 13.4,
       18.0, 0.2, "deg", kRotation, kRotationPeople, kTurningBody},
      {"turning/over_spread", [](Config& c) -> double& { return c.turning.over_spread; }, 3.0, 3.9,
       6.0, 0.1, "deg", kRotation, kRotationPeople,
       "SD 4.0 of slight and 3.7 of ample turns, taken for the spread within a person"},
      {"turning/stop_delay", [](Config& c) -> double& { return c.turning.stop_delay; }, 0.05, 0.1,
       0.2, 0.3, "s", kAssumed, kNobody,
       "Ahmetovic et al. (TACCESS'19, 67 people) found it to cause over-rotation"},
      {"turning/stop_spread", [](Config& c) -> double& { return c.turning.stop_spread; }, 0.2, 0.3,
       0.4, 0.2, "", kAssumed, kNobody, "-"},
      {"driving/cruise", [](Config& c) -> double& { return c.driving.cruise; }, 0.85, 0.8, 0.7,
       0.12, "", kAssumed, kNobody,
       "Ohn-Bar et al. (IMWUT'18): walking speed in turns differs between people, F(11,174) = "
       "4.22"},
      {"driving/gain_error", [](Config& c) -> double& { return c.driving.gain_error; }, 0.05, 0.1,
       0.15, 0.2, "", kAssumed, kNobody, "-"},
      {"driving/noise", [](Config& c) -> double& { return c.driving.noise; }, 0.03, 0.1, 0.15, 0.3,
       "", kAssumed, kNobody, "-"},
      {"driving/veer", [](Config& c) -> double& { return c.driving.veer; }, 0.3, 0.8, 1.5, 0.5,
       "deg/m", kAssumed, kNobody,
       "form (a constant bias, a larger variable error): Kallie, Schrater and Legge 2007, of "
       "walking"},
      {"driving/veer_spread", [](Config& c) -> double& { return c.driving.veer_spread; }, 0.5, 1.0,
       2.0, 0.3, "deg", kAssumed, kNobody, "likewise"},
      {"feeling/threshold", [](Config& c) -> double& { return c.feeling.threshold; }, 0.05, 0.08,
       0.2, 0.3, "", kAssumed, kNobody, "-"},
      {"feeling/reading", [](Config& c) -> double& { return c.feeling.reading; }, 1.0, 1.5, 2.0, 0.2,
       "s", "Cosgun et al., tactile belt", "15 people",
       "1 to 2 s to a pattern at the waist; taken for a pad in the hands, which is assumed"},
      {"feeling/spread", [](Config& c) -> double& { return c.feeling.spread; }, 0.15, 0.2, 0.3, 0.2,
       "", kAssumed, kNobody, "-"},
      {"feeling/recognised", [](Config& c) -> double& { return c.feeling.recognised; }, 0.98, 0.9,
       0.7, 0.05, "", kAssumed, kNobody,
       "Cosgun et al.: rotation patterns of a belt are read almost perfectly"},
      {"memory/lost", [](Config& c) -> double& { return c.memory.lost; }, 0.1, 0.25, 0.5, 0.4, "",
       kAssumed, kNobody,
       "that the quick miss a second turn: Ohn-Bar et al. (IMWUT'18), 12 people"},
      {"attention/distractions", [](Config& c) -> double& { return c.attention.distractions; }, 0.2,
       0.5, 1.0, 0.5, "1/min", kAssumed, kNobody, "-"},
      {"attention/distracted", [](Config& c) -> double& { return c.attention.distracted; }, 1.5,
       2.0, 3.0, 0.3, "s", kAssumed, kNobody, "-"},
      {"attention/gives_up", [](Config& c) -> double& { return c.attention.gives_up; }, 240.0,
       180.0, 120.0, 0.4, "s", kAssumed, kNobody, "-"},
      {"learning/rate", [](Config& c) -> double& { return c.learning.rate; }, 0.15, 0.15, 0.15, 0.3,
       "", kAssumed, kNobody,
       "that a fourth traversal is 45 and 57 s quicker: Ohn-Bar et al. (IUI'18), 8 people, "
       "walking"},
      {"feeling/onset", [](Config& c) -> double& { return c.feeling.onset; }, 0.45, 0.65, 0.95, 0.2,
       "s", "PLoS ONE 2019, 0219737", "10 young and 13 old people",
       "0.25 to 0.5 s to a vibration, a second task adds 0.13 s, its place 0.02 to 0.12 s; somewhat "
       "slower is assumed"},
      {"tracking/delay", [](Config& c) -> double& { return c.tracking.delay; }, 0.3, 0.5, 0.8, 0.2,
       "s", kAssumed, kNobody,
       "form (delay, gain by it, remnant): McRuer and Jex 1967, Levison et al. 1969, by eye; their "
       "trained people have 0.2 to 0.4 s"},
      {"tracking/speed_delay", [](Config& c) -> double& { return c.tracking.speed_delay; }, 0.45,
       0.7, 1.0, 0.2, "s", kAssumed, kNobody, "likewise"},
      {"tracking/noise", [](Config& c) -> double& { return c.tracking.noise; }, 0.15, 0.25, 0.35,
       0.2, "", kAssumed, kNobody, "likewise"},
  };
  return all;
}

const std::vector<std::string>& person_types() {
  static const std::vector<std::string> all = {"able",  "typical",   "struggling",
                                               "drawn", "deafblind", "noise"};
  return all;
}

void become(SimulatedOperatorConfig& config, const std::string& type, int seed) {
  Random random(static_cast<std::uint64_t>(seed) ^ kTraits);
  for (const Trait& trait : traits()) {
    double value = trait.typical;
    if (type == "able") value = trait.able;
    if (type == "struggling") value = trait.struggling;
    if (type == "drawn") value = random.lognormal(trait.typical, trait.between);
    value = worsened(trait, value, config.worse);
    // A share, a stick, a force.
    if (std::string(trait.unit).empty()) value = std::min(value, 1.0);
    trait.of(config) = value;
  }
  config.hearing.words = config.hearing.sounds = type != "deafblind";
  config.hearing.noise = type == "noise" ? 0.5 : 0.0;
}

std::string traits_table() {
  std::ostringstream out;
  out << "| parameter | able | typical | struggling | drawn: lognormal, SD of the logarithm | unit "
         "| "
         "source | people measured | carried over |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const Trait& trait : traits()) {
    const char* const unit = std::string(trait.unit).empty() ? "-" : trait.unit;
    out << "| " << trait.name << " | " << trait.able << " | " << trait.typical << " | "
        << trait.struggling << " | " << trait.between << " | " << unit << " | " << trait.source
        << " | " << trait.people << " | " << trait.carried << " |\n";
  }
  return out.str();
}

}  // namespace navvi_people::people
