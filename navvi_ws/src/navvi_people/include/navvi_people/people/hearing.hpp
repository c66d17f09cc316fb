#pragma once

#include <cstdint>
#include <navvi_types/random.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_people/people/heard.hpp"
#include "navvi_people/people/instruction.hpp"

namespace navvi_people::people {

using navvi_types::Random;

/// The ear: how soon, and how rightly.
struct HearingConfig {
  bool faults = true;
  bool words = true;
  bool sounds = true;
  double noise = 0.0;           ///< share of all that is played which noise covers
  double word_reaction = 0.65;  ///< s, from the end of a sentence to the hand, the median
  double word_spread = 0.2;     ///< standard deviation of its logarithm, from sentence to sentence
  double sound_reaction = 0.3;  ///< s, from the onset of a short sound to the hand, the median
  double sound_spread = 0.15;   ///< standard deviation of its logarithm, from sound to sound
  double missed_words = 0.01;   ///< share of sentences
  double missed_sounds = 0.02;  ///< share of short sounds
  double misheard = 0.01;       ///< share of hours taken for the next one
  double mirrored = 0.005;      ///< share of sides taken for the other
  double masked = 0.05;         ///< share of short sounds that speech or another sound covers
  /// 1/s, letters that are followed; at twice as many no sentence is
  double fastest_speech = 30.0;

  void describe(navvi_config::Visitor& visit);
};

class Hearing {
 public:
  Hearing(const HearingConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}

  /// What became of a sentence in the ear.
  struct Sentence {
    double reaction = 0.0;  ///< s, from its end to the hand
    bool mirrored = false;
    int hours_off = 0;
  };
  /// \param lasted  s \return nullopt: missed
  [[nodiscard]] std::optional<Sentence> words(const std::string& text, double lasted);
  [[nodiscard]] static std::vector<Instruction> as_heard(const Sentence& sentence,
                                                         std::vector<Instruction> told);

  struct Tone {
    Instruction::Side side = Instruction::Side::none;
    double reaction = 0.0;  ///< s, from its onset to the hand
  };
  /// \param over_words  something is spoken \return nullopt: missed
  [[nodiscard]] std::optional<Tone> sound(const Sound& sound, bool over_words, double time);
  /// A sound that lasts is covered now: by bursts of a second on the mean. \param dt  s
  [[nodiscard]] bool covered(double dt);

 private:
  HearingConfig config_;
  Random random_;
  double last_sound_ = -1e9;  ///< s
  bool covered_ = false;
};

}  // namespace navvi_people::people
