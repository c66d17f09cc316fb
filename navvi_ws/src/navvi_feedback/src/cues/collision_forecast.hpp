#pragma once

#include <cstdint>
#include <map>
#include <navvi_types/thing.hpp>
#include <utility>
#include <vector>

namespace navvi_feedback {
using navvi_types::NearThing;
}  // namespace navvi_feedback

namespace navvi_feedback::cues {

/// Forecasts when a near thing will be touched if it and the robot go on as they do: in a straight
/// line, by how its nearest point has moved of late, seen from the robot. Along the face of a shelf
/// that point slides as the robot drives, so that a robot that slowly nears it is seen, too.
class CollisionForecast {
 public:
  /// \param time  s, of a clock that does not run backwards
  void update(const std::vector<NearThing>& nearby, double time);

  /// s, >= 0; infinity if it will be missed, or has not been seen for long enough
  [[nodiscard]] double time_to_collision(const NearThing& thing) const;

 private:
  using Seen = std::pair<double, Eigen::Vector2d>;  ///< s; m, in base_link

  std::map<std::uint32_t, std::vector<Seen>> seen_;  ///< of late, by id
};

}  // namespace navvi_feedback::cues
