#pragma once

#include "mesh/mesh.hpp"
#include "search/centroid_astar.hpp"
#include "search/polyanya.hpp"

namespace navvi_nav::search {

enum class SearchMethod {
  exact,           ///< the shortest path: Polyanya
  centroid_astar,  ///< the paper's: A* on centroids, then the funnel (R-NAV-6, R-NAV-7)
};

/// Finds paths between places on a mesh. Keeps its memory: the exact method allocates nothing once
/// it has answered queries as hard. Not thread-safe.
class Search {
 public:
  /// \param alpha  0 to 1, weight of the heuristic of centroid_astar
  explicit Search(SearchMethod method, double alpha = 1.0) : method_(method), alpha_(alpha) {}

  /// The mesh may have changed since the last query. \returns valid until the next query
  const Found& find(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                    const mesh::Mesh::Place& goal) {
    if (method_ == SearchMethod::exact) return find_at({}, mesh, start, goal);
    return found_ = centroid_astar(mesh, start, goal, alpha_);
  }
  /// A path by Polyanya at other prices, likewise.
  const Found& find_at(const Polyanya::Price& price, const mesh::Mesh& mesh,
                       const mesh::Mesh::Place& start, const mesh::Mesh::Place& goal) {
    found_.found = polyanya_.find(mesh, start, goal, price, found_.path);
    found_.nodes_expanded = polyanya_.nodes_expanded();
    return found_;
  }

 private:
  SearchMethod method_;
  double alpha_;
  Polyanya polyanya_;
  Found found_;
};

}  // namespace navvi_nav::search
