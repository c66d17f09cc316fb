#pragma once

#include <Eigen/Geometry>
#include <array>
#include <variant>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::occupancy {

/// A cube in map, aligned with the axes.
struct Cell {
  Eigen::Vector3d centre;  ///< m
  double half;             ///< m, half of its edge
};

/// How much of a cell lies in a body.
enum class Overlap { none, partial, full };

/// How much of each eighth of a cell lies in a body: bit i is set for the eighth that octomap
/// numbers i, which lies to the positive side of x, y, z where bits 0, 1, 2 of i are set.
struct Octants {
  unsigned touched;  ///< partial or full
  unsigned full;
};

/// The eighth `i` of a cell.
[[nodiscard]] inline Cell octant(const Cell& cell, unsigned i) {
  const double half = cell.half / 2.0;
  return {cell.centre + Eigen::Vector3d((i & 1U) ? half : -half, (i & 2U) ? half : -half,
                                        (i & 4U) ? half : -half),
          half};
}

/// A box that lies as it likes, by its separating axes (Gottschalk et al., 1996): exact.
class TurnedBox {
 public:
  TurnedBox(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose);

  [[nodiscard]] Overlap overlap(const Cell& cell) const;

 private:
  /// The box's shadow on an axis, and what a cell of half-edge 1 throws on the same axis.
  struct Axis {
    Eigen::Vector3d direction;
    double min;
    double max;
    double cell_reach;
  };
  void add_axis(const Eigen::Vector3d& direction, const Eigen::Vector3d& half,
                const Eigen::Isometry3d& pose);

  std::vector<Axis> axes_;  ///< those of its faces first
};

/// A cylinder. Exact against a cell when it stands upright; otherwise a leaf that lies within half
/// its diagonal counts as touched.
class SolidCylinder {
 public:
  SolidCylinder(const Cylinder& cylinder, const Eigen::Isometry3d& pose);

  [[nodiscard]] bool upright() const { return upright_; }
  [[nodiscard]] Overlap overlap(const Cell& cell) const;

 private:
  [[nodiscard]] Overlap overlap_upright(const Eigen::Vector3d& centre, double half) const;

  Cylinder cylinder_;
  Eigen::Isometry3d to_local_;
  bool upright_;
};

/// A sphere: exact.
class SolidSphere {
 public:
  SolidSphere(const Sphere& sphere, const Eigen::Vector3d& centre)
      : radius_(sphere.radius), centre_(centre) {}

  [[nodiscard]] Overlap overlap(const Cell& cell) const;

 private:
  double radius_;
  Eigen::Vector3d centre_;
};

/// A triangle in space, by its separating axes (Akenine-Moller, 2001): exact but for rounding, and
/// that makes it touch more cells, never fewer. Never full.
struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;  ///< m, in map

  [[nodiscard]] Overlap overlap(const Cell& cell) const;
};

/// A body with an inside.
using Solid = std::variant<TurnedBox, SolidCylinder, SolidSphere>;

/// \param shrink  m, taken off each side of an eighth before it is looked at
[[nodiscard]] Octants octants(const Solid& solid, const Cell& cell, double shrink);
[[nodiscard]] Octants octants(const Triangle& triangle, const Cell& cell);

}  // namespace navvi_sim::occupancy
