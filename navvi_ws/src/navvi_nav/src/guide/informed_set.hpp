#pragma once

#include <vector>

#include "geometry.hpp"

namespace navvi_nav::guide {

/// Tells whether obstacles that moved since a path was searched could have opened a better one. A
/// path through the place that one of them left runs through a point of its hole; all points
/// through which a path of a given length can lead fill the ellipse about its ends: the informed
/// set (Gammell, Srinivasa and Barfoot, "Informed RRT*", 2014). Places outside of it do not
/// matter.
class InformedSet {
 public:
  /// A path was searched among these.
  void searched(std::vector<Cylinder> obstacles) { seen_ = std::move(obstacles); }

  /// \param length  m, only a path shorter than this would be taken \param moved  m, an obstacle
  /// that moved less did not leave its place \param margin  m, of a hole beyond its cylinder
  [[nodiscard]] bool better_path(Point from, Point to, double length,
                                 const std::vector<Cylinder>& obstacles, double moved,
                                 double margin) const;

 private:
  std::vector<Cylinder> seen_;
};

}  // namespace navvi_nav::guide
