#pragma once

#include <optional>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_feedback/drive/input_state.hpp"
#include "types.hpp"

namespace navvi_feedback::drive {

struct DriveConfig {
  std::string stick = "left";  ///< left or right
  int enable = -1;             ///< index of a button
  double dead_zone = 0.12;
  double expo = 0.3;
  double max_forward = 0.9;        // m/s
  double max_reverse = 0.5;        // m/s
  double max_turn = 1.2;           // rad/s
  double acceleration = 1.2;       ///< m/s^2, limit on speeding up
  double deceleration = 2.5;       ///< m/s^2, limit on slowing down
  double turn_acceleration = 4.0;  ///< rad/s^2, limit on changes of turning speed
  /// s, how long the stick must be neutral before it moves anything
  static constexpr double kArmHold = 0.3;

  void describe(navvi_config::Visitor& visit);
};

/// Turns the stick into a velocity. It begins disarmed, and disarms whenever the stick is lost;
/// while disarmed it asks for zero. It arms once the stick was neutral for `kArmHold`, so a stick
/// that is held, or stuck, when it appears moves nothing.
class Drive {
 public:
  explicit Drive(const DriveConfig& config) : config_(config) {}

  /// \param stick  nullopt while there is no live input; so counts a stick that is not finite
  /// \param dt  s since the last call, >= 0
  /// \return nullopt while there is no live input: nothing should be asked of the wheels then
  [[nodiscard]] std::optional<Velocity> update(const std::optional<Stick>& stick, double dt);

  /// The stick must be neutral once more before it moves anything; until then zero is asked for.
  void disarm();
  [[nodiscard]] bool armed() const { return armed_; }

  /// The stick after dead zone and curve, each axis by itself in [-1, 1]. Axes are clamped to
  /// [-1, 1] first.
  [[nodiscard]] Stick shaped(const Stick& stick) const;

 private:
  DriveConfig config_;
  Velocity velocity_;
  double neutral_for_ = 0.0;  // s
  bool armed_ = false;
};

/// m, ahead or back: of a robot that brakes now. \param speed  m/s
[[nodiscard]] double stopping_distance(double speed);

/// m/s, at which the robot stops before what it drives towards: the round trip and a
/// person's reaction pass before the wheels brake. No limit without a delay.
/// \param round_trip  s \param wanted  forward or back \param nearby  in base_link
[[nodiscard]] double fastest(double round_trip, const Velocity& wanted,
                             const std::vector<NearThing>& nearby);

}  // namespace navvi_feedback::drive
