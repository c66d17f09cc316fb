#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <navvi_types/random.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_people/people/heard.hpp"
#include "navvi_people/people/listener.hpp"

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

/// The place that a person believes in.
struct Belief {
  double heading = 0.0;   ///< rad, counter-clockwise
  double odometer = 0.0;  ///< m
};

/// A sentence, and where the person believed to be when it began.
struct Sentence {
  std::string text;
  Belief at;
  double begun = 0.0;                   ///< s
  double time = 0.0;                    ///< s, when the hands will follow
  std::vector<Instruction> parts = {};  ///< once understood
};

/// A short sound, as the ear takes it.
struct Tone {
  Earcon earcon = Earcon::turn;
  Instruction::Side side = Instruction::Side::none;
  double time = 0.0;              ///< s: when the hands will follow
  std::optional<bool> much = {};  ///< is left to turn; nullopt: as slow ticks tell
};

/// Keeps what is spoken and sounded until the hands follow it: sentences from their first word on,
/// short sounds from their onset. Times are s, not going back.
class Ears {
 public:
  Ears(const HearingConfig& config, std::uint64_t seed, Listener listener)
      : hearing_(config, seed), listener_(std::move(listener)) {}

  void begins(const Speech& speech, const Belief& at, double time);
  void breaks_off(std::uint32_t id) { begun_.erase(id); }
  /// \param elsewhere  the mind is: it takes nothing in
  /// \return what the hands will follow; nullptr: nothing
  const Sentence* ends(std::uint32_t id, bool elsewhere, double time);
  /// \param elsewhere  as above
  void sounds(const Sound& sound, bool elsewhere, double time);

  [[nodiscard]] bool noisy(double dt) { return hearing_.covered(dt); }

  /// Sentences that are being spoken, by the id of their cue.
  [[nodiscard]] const std::map<std::uint32_t, Sentence>& begun() const { return begun_; }
  /// Of these, those whose end should have come.
  [[nodiscard]] std::vector<std::uint32_t> without_end(double time) const;
  /// Something is spoken, or was and is not followed yet.
  [[nodiscard]] bool listen() const { return !begun_.empty() || !understood_.empty(); }
  [[nodiscard]] const Listener& listener() const { return listener_; }

  /// What is to be followed now, in the order in which it was taken in.
  [[nodiscard]] std::optional<Sentence> next_sentence(double time);
  [[nodiscard]] std::optional<Tone> next_tone(double time);
  /// It is the next to be followed, at a time of its own.
  void put_off(const Tone& tone) { tones_.push_front(tone); }

 private:
  Hearing hearing_;
  Listener listener_;
  std::map<std::uint32_t, Sentence> begun_;
  std::deque<Sentence> understood_;
  std::deque<Tone> tones_;
};

/// At which a sentence is spoken, and one without an end is over.
constexpr double kLettersPerSecond = 14;

}  // namespace navvi_people::people
