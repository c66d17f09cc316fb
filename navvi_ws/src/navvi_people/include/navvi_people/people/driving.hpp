#pragma once

#include <cstdint>
#include <navvi_types/random.hpp>

#include "navvi_config/field.hpp"

namespace navvi_people::people {

using navvi_types::Random;

/// The hand on the stick, and what it believes to have done.
struct DrivingConfig {
  bool faults = true;
  double cruise = 0.85;
  double slow = 0.6;
  double turn_rate = 1.2;
  double full_speed = 0.9;
  double dead_zone = 0.12;
  double expo = 0.3;
  double gain_error = 0.05;
  double noise = 0.03;
  double veer = 0.3;
  double veer_spread = 0.5;

  void describe(navvi_config::Visitor& visit);
};

class Driving {
 public:
  /// \param person  seed of what this hand believes and to which side it veers
  /// \param occasion  seed of what it does by chance
  Driving(const DrivingConfig& config, std::uint64_t person, std::uint64_t occasion);

  /// What the robot makes of a stick, as believed, [-1, 1].
  [[nodiscard]] double shaped(double stick) const;
  [[nodiscard]] double turn_gain() const { return turn_gain_; }
  [[nodiscard]] double speed_gain() const { return speed_gain_; }
  /// The stick that the hand truly holds. \param dt  s since the last
  [[nodiscard]] double trembling(double stick, double dt);
  /// rad, by which the believed heading drifts away over `driven` m
  [[nodiscard]] double veered(double driven);

 private:
  DrivingConfig config_;
  Random random_;
  double turn_gain_ = 1.0;   ///< turns asked for are made this much too far
  double speed_gain_ = 1.0;  ///< distances are believed this much too long
  double bias_ = 0.0;        ///< rad/m
  double tremor_ = 0.0;
};

}  // namespace navvi_people::people
