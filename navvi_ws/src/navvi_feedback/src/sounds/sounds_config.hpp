#pragma once

#include <string>

#include "navvi_config/field.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::sounds {

/// Sounds that are switched together.
struct FamilyConfig {
  bool on = true;
  double volume = 0.6;

  void describe(navvi_config::Visitor& visit);
};

struct TurnConfig : FamilyConfig {
  static constexpr double kBegin = 15.0;  ///< deg, it begins once the heading is off by more
  static constexpr double kDone = 2.0;    ///< deg, it ends with a sound of its own at this angle
  double stopping_delay = 0.4;    ///< s
  double stopping_spread = 0.15;  ///< s
  bool learn = true;
  double slow_down = 2.0;  ///< s
  /// s, between two soft sounds while the robot drives on as it should; 0: none
  static constexpr double kOnCourse = 4.0;

  void describe(navvi_config::Visitor& visit);
};

struct SoundsConfig {
  bool enabled = true;
  TurnConfig turn;
  FamilyConfig hit;
  FamilyConfig shelf;
  FamilyConfig near;
  FamilyConfig arrival;
  FamilyConfig beacon{false};
  static constexpr double kCaptureRadius = 1.5;  ///< m, nearer than this a way-point has no beacon
  /// share of its volume that a sound has while words are spoken; a hit has it all
  static constexpr double kUnderWords = 0.3;
  static constexpr double kFlowUnderWords = 0.5;  ///< likewise of the sound that lasts
  std::string sides;  ///< sound device by which the person tells sides

  void describe(navvi_config::Visitor& visit);
  [[nodiscard]] const FamilyConfig& family_of(Earcon earcon) const;
};

}  // namespace navvi_feedback::sounds
