#pragma once

#include <cstdint>
#include <navvi_types/random.hpp>

namespace navvi_people::people {

using navvi_types::Random;

/// How far a turn truly goes.
struct TurningConfig {
  bool faults = true;
  double over_slight = 8.5;  ///< deg, turned too far by words, turns of 22.5 to 60 deg, the mean
  double over_ample = 6.5;   ///< deg, likewise, turns of 60 deg and more
  double over_spread = 3.0;  ///< deg, standard deviation, turn by turn
  double stop_delay = 0.05;  ///< s, from the decision to stop a turn to the hand, the median
  double stop_spread = 0.2;  ///< standard deviation of its logarithm
};

class Turning {
 public:
  Turning(const TurningConfig& config, std::uint64_t seed) : config_(config), random_(seed) {}

  /// \param angle  rad, of the turn that was asked for \return rad, that is made
  [[nodiscard]] double made(double angle);
  /// s, from the decision to stop a turn until the hand has let go
  [[nodiscard]] double stop_delay();

 private:
  TurningConfig config_;
  Random random_;
};

/// The hand on the stick, and what it believes to have done.
struct DrivingConfig {
  bool faults = true;
  double cruise = 0.85;                      ///< stick on a straight way: the speed that is liked
  static constexpr double kSlow = 0.6;       ///< stick when something is near
  static constexpr double kTurnRate = 1.2;   ///< rad/s, believed, at full stick
  static constexpr double kFullSpeed = 0.9;  ///< m/s, believed, at full stick
  static constexpr double kDeadZone = 0.12;  ///< believed, of the stick
  static constexpr double kExpo = 0.3;       ///< believed, of the stick: 0 linear, 1 cubic
  double gain_error = 0.05;  ///< standard deviation, over people, of how wrong these beliefs are
  double noise = 0.03;       ///< standard deviation of a stick that is held
  double veer = 0.3;         ///< deg/m, to one side, the same all the way
  double veer_spread = 0.5;  ///< deg, standard deviation, over a metre, of what comes besides
};

class Driving {
 public:
  /// \param person  seed of what this hand believes and to which side it veers
  /// \param occasion  seed of what it does by chance
  Driving(const DrivingConfig& config, std::uint64_t person, std::uint64_t occasion);

  /// What the robot makes of a stick, as believed, [-1, 1].
  [[nodiscard]] double shaped(double stick) const;
  /// The stick for what the robot is to make of it, as believed, both [-1, 1].
  [[nodiscard]] double stick_for(double shaped) const;
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
