#include "navvi_nav/corner_graph.hpp"

#include <limits>

namespace navvi_nav {

bool CornerGraph::find(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal,
                       Path& path) {
  path.clear();
  nodes_expanded_ = 0;
  if (mesh.polygon(start.polygon).part != mesh.polygon(goal.polygon).part) return false;
  mesh_ = &mesh;
  goal_ = goal.point;
  open_.clear();
  if (stops_.size() < mesh.vertices.size()) stops_.resize(mesh.vertices.size());
  tangents_.watch(mesh);
  if (++query_ == 0) {
    for (Stop& each : stops_) each.query = 0;
    query_ = 1;
  }
  survey(start);
  look_about(start, goal);
  while (!open_.empty()) {
    const auto [estimate, vertex] = open_.pop();
    if (estimate >= best_) break;
    Stop& here = stop(vertex);
    if (!here.open) continue;
    here.open = false;
    ++nodes_expanded_;
    expand(vertex, start.point);
  }
  expanded_here_ += nodes_expanded_;
  if (best_ == std::numeric_limits<double>::infinity()) return false;
  path.push_back(goal.point);
  for (int vertex = last_; vertex >= 0; vertex = stop(vertex).parent) {
    if (!(mesh.at(vertex) == path.back())) path.push_back(mesh.at(vertex));
  }
  if (!(start.point == path.back())) path.push_back(start.point);
  std::reverse(path.begin(), path.end());
  return true;
}

/// Sets where the landmarks lead. \returns what is seen from there
const std::vector<Sight::Corner>& CornerGraph::look_from_goal(const Mesh::Place& goal,
                                                              const Mesh::Place* start) {
  const bool known = windows_.known();
  const auto& seen = known ? windows_.look(*mesh_, goal) : sight_.look(*mesh_, goal, start);
  if (landmarks_.known()) landmarks_.aim(known ? windows_.around() : sight_.around(), seen);
  return seen;
}

/// Finds what is seen from the goal and, if that is not the start, from the start.
void CornerGraph::look_about(const Mesh::Place& start, const Mesh::Place& goal) {
  best_ = std::numeric_limits<double>::infinity();
  last_ = -1;
  const bool known = windows_.known();
  const bool near = known && sight_.sees(*mesh_, start, goal);
  if (!near) {
    for (const Sight::Corner& corner : look_from_goal(goal, &start)) {
      Stop& from = stop(corner.vertex);
      from.sees_goal = true;
      from.last = corner.away;
    }
  }
  if (near || (!known && sight_.target_seen())) {
    best_ = distance(start.point, goal.point);
    return;
  }
  for (const Sight::Corner& corner :
       known ? windows_.look(*mesh_, start) : sight_.look(*mesh_, start)) {
    tangents_.meet(corner);
    reach(corner.vertex, corner.turn, -1, corner.away);
  }
}

const Landmarks* CornerGraph::aim(const Mesh& mesh, const Mesh::Place& goal, std::size_t cost) {
  mesh_ = &mesh;
  tangents_.watch(mesh);
  survey(goal);
  expanded_here_ += cost;
  if (!landmarks_.known()) return nullptr;
  look_from_goal(goal, nullptr);
  return &landmarks_;
}

void CornerGraph::survey(const Mesh::Place& start) {
  if (mesh_->version != version_) {
    version_ = mesh_->version;
    expanded_here_ = 0;
    landmarks_.forget();
    windows_.forget();
  }
  if (landmarks_.known() || expanded_here_ < worth_ * mesh_->vertices.size()) return;
  landmarks_.measure(*mesh_, start, tangents_);
  windows_.measure(*mesh_);
}

/// A shortest path bends round a corner: it leaves on the side to which it turned.
void CornerGraph::expand(int vertex, Point start) {
  const Stop here = stop(vertex);
  const Point before = here.at - (here.parent < 0 ? start : mesh_->at(here.parent));
  const double before_extent = std::abs(before.x) + std::abs(before.y);
  for (const Tangents::Edge& edge : tangents_.from(vertex, here.turn)) {
    const Stop& to = stop(edge.vertex());
    const Point ahead = to.at - here.at;
    const double cost = here.cost + norm(ahead);
    if (cost >= to.cost) continue;
    const double ahead_extent = std::abs(ahead.x) + std::abs(ahead.y);
    if (here.turn * side_of(before, before_extent, ahead, ahead_extent) < 0) continue;
    reach(edge.vertex(), edge.turn(), vertex, cost);
  }
}

CornerGraph::Stop& CornerGraph::stop(int vertex) {
  Stop& out = stops_[static_cast<std::size_t>(vertex)];
  if (out.query != query_) {
    out = {};
    out.at = mesh_->at(vertex);
    out.query = query_;
    out.cost = std::numeric_limits<double>::infinity();
  }
  return out;
}

void CornerGraph::reach(int vertex, int turn, int parent, double cost) {
  Stop& to = stop(vertex);
  if (cost >= to.cost) return;
  to.cost = cost;
  to.parent = parent;
  to.turn = static_cast<std::int8_t>(turn);
  to.open = true;
  if (to.sees_goal && cost + to.last < best_) {
    best_ = cost + to.last;
    last_ = vertex;
  }
  if (to.rest < 0.0) {
    to.rest = distance(to.at, goal_);
    if (landmarks_.known()) to.rest = std::max(to.rest, landmarks_.at_least(vertex));
  }
  if (cost + to.rest < best_) open_.push(cost + to.rest, vertex);
}

}  // namespace navvi_nav
