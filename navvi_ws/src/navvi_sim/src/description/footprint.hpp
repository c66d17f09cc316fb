#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {

/// Corners of a convex polygon, counter-clockwise; m. One or two corners are a point or a segment.
using Polygon = std::vector<Eigen::Vector2d>;

/// The convex hull, without collinear corners (Andrew, 1979).
[[nodiscard]] Polygon convex_hull(std::vector<Eigen::Vector2d> points);

/// False only if a line along an edge of either keeps the two at least `gap` m apart. Exact for a
/// gap of 0; with a gap, corners that face each other count as near a little early.
[[nodiscard]] bool overlap(const Polygon& a, const Polygon& b, double gap);

/// A convex polygon that is asked about many points.
class Ground {
 public:
  explicit Ground(const Polygon& polygon);
  /// As overlap() of the polygon and the point.
  [[nodiscard]] bool holds(const Eigen::Vector2d& point, double gap) const;
  /// The least and the greatest x, to rounding, between which it holds the points at `y`.
  [[nodiscard]] std::pair<double, double> along_x(double y, double gap) const;

 private:
  struct Edge {
    Eigen::Vector2d corner;
    Eigen::Vector2d outwards;
  };
  std::vector<Edge> edges_;
};

/// The points of which a geometry is the hull, tight within 2 % of a radius, in its own frame.
[[nodiscard]] std::vector<Eigen::Vector3d> hull_points(const Geometry& geometry);

/// A vertical cylinder that may stand in a mover's way.
struct Disc {
  Eigen::Vector2d centre;                              ///< m, in map
  double radius;                                       ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
};

/// The horizontal extent of a thing about its origin, in its own frame, and its top.
struct Footprint {
  double front = 0.0;   ///< m, from the origin along x to the foremost point
  double back = 0.0;    ///< m, from the origin against x
  double side = 0.0;    ///< m, largest distance from the x axis
  double radius = 0.0;  ///< m, largest distance from the origin
  double bottom = 0.0;  ///< m, lowest z in the frame of the thing's origin, map's axes
  double top = 0.0;     ///< m, likewise
  Polygon hull;         ///< seen from above, in the thing's own frame
};

/// \param tilt  of the thing's shapes: its orientation without its yaw
[[nodiscard]] Footprint footprint_of(const Thing& thing, const Eigen::Quaterniond& tilt);

/// Radius, length and width of a moving thing. The disc and the rectangle both hold the whole
/// footprint, and the disc holds the rectangle. Of what is so round that the disc is the smaller of
/// the two, the rectangle is left out: 0 and 0.
[[nodiscard]] navvi_types::MovingThing extent_of(const Footprint& print);

/// The thing's heading: rad, the direction of its x axis seen from above.
[[nodiscard]] double yaw_of(const Eigen::Isometry3d& pose);
/// The thing's orientation without its heading.
[[nodiscard]] Eigen::Quaterniond tilt_of(const Eigen::Isometry3d& pose);

}  // namespace navvi_sim
