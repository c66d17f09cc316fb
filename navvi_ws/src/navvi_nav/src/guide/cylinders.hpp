#pragma once

#include <navvi_types/thing.hpp>
#include <optional>
#include <vector>

#include "geometry.hpp"

namespace navvi_nav::guide {

using navvi_types::MovingThing;
using navvi_types::Pose2;

inline constexpr double kStandingSpeed = 0.2;  ///< m/s, a slower thing counts as standing

/// The values of messages as those of meshes and back, m, in map.
[[nodiscard]] inline Point to_point(const Eigen::Vector2d& point) { return {point.x(), point.y()}; }
[[nodiscard]] std::vector<Eigen::Vector2d> to_vectors(const Path& path);
[[nodiscard]] inline std::optional<Point> position_of(const std::optional<Pose2>& pose) {
  return pose ? std::optional(to_point(pose->position)) : std::nullopt;
}
/// The thing as cylinders, which is all that navigation knows of it (R-NAV-4): a long one as a row
/// that covers its rectangle, from front to back, each with the thing's id; as many at each
/// instant.
/// \param most  cylinders; 1: always the one about it
[[nodiscard]] std::vector<Cylinder> cylinders_of(const MovingThing& thing, int most);

}  // namespace navvi_nav::guide
