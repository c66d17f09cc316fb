#pragma once

#include <optional>
#include <vector>

#include "cues/cue.hpp"
#include "lessons/lesson.hpp"
#include "senses/observation.hpp"
#include "sounds/soundscape.hpp"

namespace navvi_feedback::core {

/// What is heard besides words.
class AuditoryDisplay {
 public:
  explicit AuditoryDisplay(const sounds::SoundsConfig& config)
      : config_(config), soundscape_(config) {}

  /// From now on.
  void use(const sounds::SoundsConfig& config);

  /// Takes what sounds out of what is to be said, and adds what sounds besides.
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::vector<sounds::Play> update(std::vector<cues::Cue>& cues,
                                                 const Observation& now,
                                                 const sounds::Soundscape::Steering& lead,
                                                 const lessons::Taught& taught, double time);
  /// As Soundscape::learnt().
  [[nodiscard]] std::optional<sounds::Learnt> learnt() const { return soundscape_.learnt(); }
  /// As TurnSound::find_sides_wrong().
  void find_sides_wrong() { soundscape_.find_sides_wrong(); }
  /// As TurnSound::leads().
  [[nodiscard]] bool leads() const { return soundscape_.leads(); }
  /// As TurnSound::most_rate().
  [[nodiscard]] std::optional<double> most_rate() const { return soundscape_.most_rate(); }
  /// One of the chosen loudness, from ahead.
  [[nodiscard]] sounds::Play sample(sounds::Earcon earcon) const;

 private:
  sounds::SoundsConfig config_;
  sounds::Soundscape soundscape_;
};

}  // namespace navvi_feedback::core
