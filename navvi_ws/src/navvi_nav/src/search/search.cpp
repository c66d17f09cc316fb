#include "search/search.hpp"

#include "search/centroid_astar.hpp"

namespace navvi_nav::search {

const Found& Search::find(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                          const mesh::Mesh::Place& goal) {
  found_.path.clear();
  if (method_ == SearchMethod::exact) {
    found_.found = polyanya_.find(mesh, start, goal, found_.path);
    found_.nodes_expanded = polyanya_.nodes_expanded();
  } else {
    const Corridor corridor = centroid_astar(mesh, start, goal, alpha_);
    found_.found = corridor.found;
    found_.nodes_expanded = corridor.nodes_expanded;
    if (corridor.found) found_.path = funnel(start.point, goal.point, corridor.portals);
  }
  found_.length = length_of(found_.path);
  return found_;
}

}  // namespace navvi_nav::search
