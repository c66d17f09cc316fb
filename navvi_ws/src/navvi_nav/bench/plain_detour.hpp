#pragma once

#include <octomap/OcTree.h>

#include <memory>

#include "navvi_nav/geometry.hpp"

namespace navvi_nav {

/// Recast and Detour used as their samples do: one mesh over the whole map, convex polygons of up
/// to six corners, Detour's own A* on edge midpoints and its own funnel. The voxels go in as spans,
/// and no height detail is made, so that nothing is paid for that our mesh does not need either.
class PlainDetour {
 public:
  /// \param robot_radius  m, eroded in whole cells \param robot_height  m
  PlainDetour(const octomap::OcTree& tree, double robot_radius, double robot_height);
  ~PlainDetour();
  PlainDetour(const PlainDetour&) = delete;
  PlainDetour& operator=(const PlainDetour&) = delete;

  [[nodiscard]] int polygons() const;

  /// Sets where the next search() runs: findNearestPoly for both ends.
  /// \returns false if either is off the mesh
  bool locate(Point start, Point goal);
  /// findPath and findStraightPath. \returns empty if there is no path or only a part of one
  Path search();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace navvi_nav
