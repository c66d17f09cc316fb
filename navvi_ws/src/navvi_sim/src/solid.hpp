#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "navvi_sim/world_description.hpp"

namespace navvi_sim {

/// A cube in map, aligned with the axes.
struct Cell {
  Eigen::Vector3d centre;  ///< m
  double half;             ///< m, half of its edge
};

/// How much of a cell lies in a solid.
enum class Overlap { none, partial, full };

/// A convex body by its separating axes (Gottschalk et al., 1996): exact against a cell.
class Convex {
 public:
  static Convex box(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose);
  static Convex triangle(const std::array<Eigen::Vector3d, 3>& corners);

  [[nodiscard]] Overlap overlap(const Cell& cell) const;

 private:
  /// The body's shadow on an axis, and what a cell of half-edge 1 throws on the same axis.
  struct Axis {
    Eigen::Vector3d direction;
    double min;
    double max;
    double cell_reach;
  };
  void add_axis(const Eigen::Vector3d& direction, const std::vector<Eigen::Vector3d>& corners);

  std::vector<Axis> axes_;
  std::size_t faces_ = 0;  ///< the first axes that bound the body; 0 for one without volume
};

/// A cylinder. Exact against a cell when it stands upright; otherwise a leaf that lies within half
/// its diagonal counts as touched.
class SolidCylinder {
 public:
  SolidCylinder(const Cylinder& cylinder, const Eigen::Isometry3d& pose);

  [[nodiscard]] Overlap overlap(const Cell& cell) const;

 private:
  [[nodiscard]] Overlap overlap_upright(const Eigen::Vector3d& centre, double half) const;

  Cylinder cylinder_;
  Eigen::Isometry3d to_local_;
  bool upright_;
};

class SolidSphere {
 public:
  SolidSphere(const Sphere& sphere, const Eigen::Vector3d& centre)
      : radius_(sphere.radius), centre_(centre) {}

  [[nodiscard]] Overlap overlap(const Cell& cell) const;

 private:
  double radius_;
  Eigen::Vector3d centre_;
};

}  // namespace navvi_sim
