#include "navvi_nav/search.hpp"

#include <limits>

#include "navvi_nav/centroid_astar.hpp"
#include "navvi_nav/funnel.hpp"

namespace navvi_nav {
namespace {

// Nodes that Polyanya may expand before the graph of corners takes over, as measured: the larger
// the mesh, the fewer queries are done with so few.
constexpr std::size_t kEasy = 20;
constexpr std::size_t kEasyInLarge = 8;
constexpr std::size_t kLarge = 400;  // polygons
constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

}  // namespace

/// Most queries are easy. Hard ones on a mesh that has stayed go over the graph of its corners,
/// which costs much when it is built and little afterwards.
void Search::find_exactly(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal) {
  const bool stays = mesh.version != 0 && mesh.version == version_;
  version_ = mesh.version;
  const std::size_t easy = mesh.polygons.size() < kLarge ? kEasy : kEasyInLarge;
  found_.found = any_angle_.find(mesh, start, goal, stays ? easy : kAny, found_.path);
  found_.nodes_expanded = any_angle_.nodes_expanded();
  if (!any_angle_.gave_up()) return;
  found_.found = corner_graph_.find(mesh, start, goal, found_.path);
  found_.nodes_expanded += corner_graph_.nodes_expanded();
}

const Found& Search::find(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal) {
  found_.path.clear();
  if (method_ == SearchMethod::exact) {
    find_exactly(mesh, start, goal);
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
