#pragma once

#include <array>
#include <navvi_types/names.hpp>
#include <optional>

#include "navvi_feedback/haptics/haptics.hpp"

namespace navvi_feedback::haptics {

/// What is felt besides what is near; the most urgent last.
enum class Pattern {
  sample,        ///< one long pulse: how strong the motors are set
  ready,         ///< two light taps: a trial waits for the person
  begun,         ///< one light tap: it runs
  rerouted,      ///< a light tap on the left, then on the right
  arrived,       ///< three pulses that rise
  no_sound,      ///< three soft pulses: what the voice cannot say
  stuck,         ///< four quick taps
  halt,          ///< a short and a long pulse: the word is to stop, or to wait
  stopped,       ///< two long pulses: the robot was stopped
  hit_obstacle,  ///< two hard knocks, on its side
  hit_shelf,     ///< one long hard pulse, on its side: a shelf or a wall
};
/// As recorded.
[[nodiscard]] constexpr std::array<const char*, 11> names(Pattern) {
  return {"sample", "ready", "begun",   "rerouted",     "arrived",  "no_sound",
          "stuck",  "halt",  "stopped", "hit_obstacle", "hit_shelf"};
}

/// Plays one pattern at a time, instead of what is felt continuously, so that it stands out.
class PatternPlayer {
 public:
  /// Begins at once, unless a more urgent one plays.
  /// \param side  the motors that take part
  void begin(Pattern pattern, Zone side = Zone::center);
  void stop() { playing_.reset(); }

  /// \param dt  s since the last call, >= 0
  /// \return what the motors do now; nullopt: none plays
  [[nodiscard]] std::optional<Rumble> update(double dt);
  [[nodiscard]] std::optional<Pattern> playing() const { return playing_; }

 private:
  std::optional<Pattern> playing_;
  Zone side_ = Zone::center;
  double since_ = 0.0;  ///< s
};

}  // namespace navvi_feedback::haptics
