#include "navvi_nav/search.hpp"

#include <limits>

#include "navvi_nav/centroid_astar.hpp"
#include "navvi_nav/funnel.hpp"

namespace navvi_nav {
namespace {

// Nodes that Polyanya may expand before the graph of corners takes over. In a small mesh as many as
// cost what looking about from both ends does; the larger the mesh, the fewer queries are done with
// so few.
constexpr std::size_t kEasy = 32;
constexpr std::size_t kEasyInLarge = 8;
constexpr std::size_t kLarge = 400;  // polygons
constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

}  // namespace

/// On a mesh that stays, the graph of its corners answers: it costs much while it is built, little
/// afterwards. Until it is known, easy queries are spared it.
void Search::find_exactly(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal) {
  if (mesh.floor && mesh.floor->version != mesh.version) {
    find_between_holes(mesh, start, goal);
    return;
  }
  const bool stays = mesh.version != 0 && mesh.version == version_;
  version_ = mesh.version;
  found_.nodes_expanded = 0;
  if (!corner_graph_.knows(mesh)) {
    const std::size_t easy = mesh.polygons.size() < kLarge ? kEasy : kEasyInLarge;
    found_.found = any_angle_.find(mesh, start, goal, stays ? easy : kAny, nullptr, found_.path);
    found_.nodes_expanded = any_angle_.nodes_expanded();
    if (!any_angle_.gave_up()) return;
  }
  found_.found = corner_graph_.find(mesh, start, goal, found_.path);
  found_.nodes_expanded += corner_graph_.nodes_expanded();
}

/// Holes come and go, the floor stays: what is known of it bounds the ways that are left.
void Search::find_between_holes(const Mesh& mesh, const Mesh::Place& start,
                                const Mesh::Place& goal) {
  version_ = mesh.floor->version;
  const Mesh::Place on_floor{mesh.polygon(goal.polygon).ground, goal.point};
  const Landmarks* landmarks = corner_graph_.aim(*mesh.floor, on_floor, expanded_);
  if (landmarks != nullptr) floor_bound_.aim(mesh, *landmarks);
  found_.found = any_angle_.find(mesh, start, goal, kAny,
                                 landmarks != nullptr ? &floor_bound_ : nullptr, found_.path);
  found_.nodes_expanded = expanded_ = any_angle_.nodes_expanded();
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
