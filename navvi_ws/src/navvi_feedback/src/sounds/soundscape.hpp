#pragma once

#include <optional>
#include <vector>

#include "navvi_feedback/sounds/earcon.hpp"
#include "senses/observation.hpp"
#include "sounds/sounds_config.hpp"
#include "sounds/turn_notice.hpp"
#include "sounds/turn_sound.hpp"

namespace navvi_feedback::sounds {

/// What is heard besides words: decides each short sound that comes again and again.
class Soundscape {
 public:
  /// To where the person is led now, each as TurnSound takes it.
  struct Steering {
    std::optional<double> off;
    bool fine = false;
    Velocity motion;
  };

  explicit Soundscape(const SoundsConfig& config) : config_(config), turn_(config.turn) {}

  /// From now on. What was learnt of turns stays.
  void use(const SoundsConfig& config) {
    config_ = config;
    turn_.use(config.turn);
  }

  /// Call it at 50 Hz. \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::vector<Play> update(const Observation& now, const Steering& lead, double time);
  /// Of this person and robot; nullopt where nothing sounds.
  [[nodiscard]] std::optional<Learnt> learnt() const {
    if (!config_.enabled) return std::nullopt;
    return turn_.learnt();
  }
  /// As TurnSound::find_sides_wrong().
  void find_sides_wrong() { turn_.find_sides_wrong(); }
  /// As TurnSound::leads().
  [[nodiscard]] bool leads() const { return turn_.leads(); }
  /// As TurnSound::most_rate().
  [[nodiscard]] std::optional<double> most_rate() const { return turn_.most_rate(); }

 private:
  SoundsConfig config_;
  TurnSound turn_;
  TurnNotice notice_;
  std::optional<double> beacon_;  ///< s, when it was heard last
};

}  // namespace navvi_feedback::sounds
