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
  double begin = 15.0;            ///< deg
  double done = 2.0;              ///< deg
  double stopping_delay = 0.4;    ///< s
  double stopping_spread = 0.15;  ///< s
  bool learn = true;
  double slow_down = 2.0;  ///< s
  double on_course = 4.0;  ///< s

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
  double capture_radius = 1.5;  ///< m
  double under_words = 0.3;
  std::string sides;  ///< sound device by which the person tells sides

  void describe(navvi_config::Visitor& visit);
  [[nodiscard]] const FamilyConfig& family_of(Earcon earcon) const;
};

}  // namespace navvi_feedback::sounds
