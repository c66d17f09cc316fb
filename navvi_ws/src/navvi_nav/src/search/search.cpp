#include "search/search.hpp"

#include "search/centroid_astar.hpp"

namespace navvi_nav::search {

const Found& Search::find(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                          const mesh::Mesh::Place& goal) {
  if (method_ == SearchMethod::exact) return find_at({}, mesh, start, goal);
  found_ = centroid_astar(mesh, start, goal, alpha_);
  return found_;
}

const Found& Search::find_at(const Polyanya::Price& price, const mesh::Mesh& mesh,
                             const mesh::Mesh::Place& start, const mesh::Mesh::Place& goal) {
  found_.found = polyanya_.find(mesh, start, goal, price, found_.path);
  found_.nodes_expanded = polyanya_.nodes_expanded();
  found_.length = length_of(found_.path);
  return found_;
}

}  // namespace navvi_nav::search
