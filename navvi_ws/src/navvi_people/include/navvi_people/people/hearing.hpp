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
  double word_reaction = 0.65;
  double word_spread = 0.2;
  double sound_reaction = 0.3;
  double sound_spread = 0.15;
  double missed_words = 0.01;
  double missed_sounds = 0.02;
  double misheard = 0.01;
  double mirrored = 0.005;
  double masked = 0.05;
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

 private:
  HearingConfig config_;
  Random random_;
  double last_sound_ = -1e9;  ///< s
};

}  // namespace navvi_people::people
