#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "physics/bodies.hpp"

namespace navvi_sim::physics {

/// Where a ray ends.
struct RayEnd {
  static constexpr std::size_t kFloor = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t kNothing = kFloor - 1;

  double range;       ///< m, along the ray; its whole length if it met nothing
  std::size_t thing;  ///< index in WorldDescription::things, kFloor or kNothing
};

/// All bodies of a world and its floor, as rays meet them, in a world of Bullet's own: what is
/// looked at moves nothing. The robot is not in it. Frame: map.
class RayCaster {
 public:
  explicit RayCaster(const WorldDescription& description);
  ~RayCaster();

  /// \param from    m \param ways  unit vectors \param length  m, of each ray
  /// \param movers  everything that moves, where it is now
  [[nodiscard]] std::vector<RayEnd> cast(const Eigen::Vector3d& from,
                                         const std::vector<Eigen::Vector3d>& ways, double length,
                                         const std::vector<MoverState>& movers);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace navvi_sim::physics
