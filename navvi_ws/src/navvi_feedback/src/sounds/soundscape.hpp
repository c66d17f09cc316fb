#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "navvi_feedback/sounds/earcon.hpp"
#include "senses/observation.hpp"
#include "sounds/sounds_config.hpp"
#include "sounds/turn_sound.hpp"

namespace navvi_feedback::sounds {

/// Announces a turn before it begins, where a sound leads that lasts: ticks from its side, one for
/// each 30 degrees.
class TurnNotice {
 public:
  /// Call it at 50 Hz. \param leads  the person is led along the way \param volume  gain
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::optional<Play> update(const Observation& now, bool leads, double volume,
                                           double time);

 private:
  std::optional<Eigen::Vector2d> corner_;  ///< m, in map, that was announced last
  int left_ = 0;                           ///< ticks
  double side_ = 0.0;                      ///< 1 left, -1 right
  double last_ = 0.0;                      ///< s, of the last tick
};

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
