#include "navvi_nav/search.hpp"

#include "navvi_nav/centroid_astar.hpp"
#include "navvi_nav/funnel.hpp"

namespace navvi_nav {

const Found& Search::find(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal) {
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

}  // namespace navvi_nav
