#pragma once

#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "types.hpp"

namespace navvi_feedback::drive {

struct AssistanceConfig {
  std::string mode = "off";   ///< off, slow or stop
  double least = 0.25;        ///< share of the command that slow leaves
  /// m/s^2, the speed is kept to what this brings to rest before the thing
  static constexpr double kDeceleration = 0.8;
  static constexpr double kMargin = 0.15;    ///< m, gap at which it has come to rest

  void describe(navvi_config::Visitor& visit);
};

/// m, ahead or back: of a robot that brakes now. \param speed  m/s
[[nodiscard]] double stopping_distance(double speed);

/// m/s, at which the robot stops before what it drives towards: the round trip and a
/// person's reaction pass before the wheels brake. No limit without a delay.
/// \param round_trip  s \param wanted  forward or back \param nearby  in base_link
[[nodiscard]] double fastest(double round_trip, const Velocity& wanted,
                             const std::vector<NearThing>& nearby);

/// Slows the person's command before what stands or moves in the lane that the robot drives along.
/// It never steers: the turning speed is the person's, and away from things nothing is changed.
class Assistance {
 public:
  explicit Assistance(const AssistanceConfig& config) : config_(config) {}

  /// \param nearby  in base_link \param fresh  false: nothing is known of what is near
  /// \return the share [0, 1] of the wanted linear speed that is let through
  [[nodiscard]] double share(const Velocity& wanted, const std::vector<NearThing>& nearby,
                             bool fresh) const;

 private:
  AssistanceConfig config_;
};

}  // namespace navvi_feedback::drive
