#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {

/// The surface of an ellipsoid around the origin. Its corners lie on the ellipsoid, its faces
/// within 1 % of a radius inside.
/// \param radii  m, along x, y, z
[[nodiscard]] Mesh ellipsoid_mesh(const Eigen::Vector3d& radii);

/// The surface of an upright cone around the origin, its tip at z = height / 2. Its corners lie on
/// the cone, its sides within 1 % of the radius inside.
/// \param radius, height  m
[[nodiscard]] Mesh cone_mesh(double radius, double height);

/// The surface of an upright prism from z = 0 to `height`.
/// \param outline  m, its corners in order, either way round; the last may repeat the first
/// \return nullopt if the outline has no inside: fewer than 3 or more than 300 corners, no area, or
/// sides that cross
[[nodiscard]] std::optional<Mesh> prism_mesh(std::vector<Eigen::Vector2d> outline, double height);

}  // namespace navvi_sim
