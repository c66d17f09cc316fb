#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cues/cue.hpp"
#include "haptics/haptics.hpp"
#include "haptics/pattern.hpp"
#include "lead/hand.hpp"
#include "lessons/lesson.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::core {

/// What the hands feel: what is near, and patterns above it.
class HapticDisplay {
 public:
  explicit HapticDisplay(const haptics::HapticsConfig& config) : config_(config), near_(config) {}

  void use(const haptics::HapticsConfig& config);
  /// \param pad  whose motors are moved
  void use_pad(const std::string& pad);
  /// The motors report a missing audio device (safety rule 3), once there are any.
  /// \return true if they begin to
  bool report(Link audio, bool motors);
  void begin(haptics::Pattern pattern) { patterns_.begin(pattern); }
  /// Where the goal is. \param angle  rad, clockwise \param distance  m
  void answer(double angle, double distance);
  /// The patterns of what is said, was touched and is taught.
  void begin(const std::vector<cues::Cue>& cues, const Observation& now,
             const lessons::Taught& taught);

  /// There is to be sound and is none, and touch is to do the work of words.
  [[nodiscard]] bool deaf() const { return deaf_; }

  /// \param course  of a person whom the motors lead; nullopt: to stand
  /// \param urgent  a safety phrase is being spoken
  [[nodiscard]] haptics::Rumble update(const Observation& now,
                                       const std::optional<lead::Course>& course,
                                       const lessons::Taught& taught, bool urgent, double dt);
  [[nodiscard]] std::optional<haptics::Pattern> playing() const { return patterns_.playing(); }

 private:
  /// What is near is known, and to be felt.
  [[nodiscard]] bool feels_near(const Observation& now) const;
  [[nodiscard]] haptics::Rumble lead_by_hand(const std::optional<lead::Course>& course, double dt);

  haptics::HapticsConfig config_;
  haptics::Haptics near_;
  haptics::PatternPlayer patterns_;
  lead::HandPulses pulses_;
  double apart_ = 1.0;         ///< s, since the last pulse, or pattern
  bool felt_pattern_ = false;  ///< at the last beat
  bool pulsed_ = false;        ///< the pulses were not at rest then
  std::string pad_;
  bool alarmed_ = false;  ///< nothing can be heard, and that was reported
  bool deaf_ = false;
};

}  // namespace navvi_feedback::core
