#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "types.hpp"

namespace navvi_feedback::cues {

/// Forecasts when a near thing will be touched if it and the robot go on as they do: in a straight
/// line, by how its nearest point has moved of late, seen from the robot. Along the face of a shelf
/// that point slides as the robot drives, so that a robot that slowly nears it is seen, too. What
/// stands nears as fast as the robot drives now, however slowly it began.
class CollisionForecast {
 public:
  /// \param drives  m/s, of the robot, forward positive
  /// \param time  s, of a clock that does not run backwards
  void update(const std::vector<NearThing>& nearby, double drives, double time);

  /// s, >= 0; infinity if it will be missed, or has not been seen for long enough
  /// \param drives  of the robot, from now on
  [[nodiscard]] double time_to_collision(const NearThing& thing, const Velocity& drives) const;
  /// Likewise of a thing that moves, once a robot that stands now drives. \param velocity  m/s, in
  /// base_link
  [[nodiscard]] double time_once_driven(const NearThing& thing,
                                        const Eigen::Vector2d& velocity) const;

 private:
  struct Seen {
    double time = 0.0;                                ///< s
    double driven = 0.0;                              ///< m, by the robot until then
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< m, in base_link
  };
  /// How the thing's point has moved, and the robot's mean speed meanwhile.
  struct Motion {
    Eigen::Vector2d velocity;  ///< m/s, in base_link
    double drives;             ///< m/s, >= 0
  };
  [[nodiscard]] std::optional<Motion> motion_of(const NearThing& thing) const;

  double driven_ = 0.0;                              ///< m, either way
  double time_ = 0.0;                                ///< s, of the last update
  std::map<std::uint32_t, std::vector<Seen>> seen_;  ///< of late, by id
};

}  // namespace navvi_feedback::cues
