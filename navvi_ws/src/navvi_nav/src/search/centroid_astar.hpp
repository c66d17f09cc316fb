#pragma once

#include <cstddef>
#include <vector>

#include "geometry.hpp"
#include "mesh/mesh.hpp"

namespace navvi_nav::search {

struct Found {
  bool found = false;
  Path path;  ///< from start to goal; one point if they are the same
  std::size_t nodes_expanded = 0;
};

/// A* on graph G (R-NAV-6): nodes are polygon centroids, edges join neighbours, and
/// f = g + alpha * Euclidean distance to the goal. With alpha <= 1 the heuristic is admissible and
/// consistent on G. Ties go to the smaller index, so repeats are equal. The path is the funnel's.
[[nodiscard]] Found centroid_astar(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                                   const mesh::Mesh::Place& goal, double alpha);

/// The shortest polyline from `start` to `goal` that crosses each portal in order (R-NAV-7).
/// Simple Stupid Funnel, after Mononen, "Simple Stupid Funnel Algorithm", 2010; linear in the
/// number of portals except where it restarts from a corner. Repeated points are left out.
[[nodiscard]] Path funnel(Point start, Point goal, const std::vector<mesh::Interval>& portals);

}  // namespace navvi_nav::search
