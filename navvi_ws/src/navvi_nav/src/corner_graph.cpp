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
  keep_landmarks(start);
  const std::vector<Sight::Corner>& near_goal = sight_.look(mesh, goal, &start);
  if (landmarks_.known()) landmarks_.aim(sight_, near_goal);
  for (const Sight::Corner& corner : near_goal) {
    Stop& from = stop(corner.vertex);
    from.sees_goal = true;
    from.last = corner.away;
  }
  best_ = std::numeric_limits<double>::infinity();
  last_ = -1;
  if (sight_.target_seen()) {
    best_ = distance(start.point, goal.point);
  } else {
    for (const Sight::Corner& corner : sight_.look(mesh, start)) {
      tangents_.meet(corner);
      reach(corner.vertex, corner.turn, -1, corner.away);
    }
  }
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

Landmarks* CornerGraph::landmarks(const Mesh& mesh, const Mesh::Place& place, std::size_t cost) {
  mesh_ = &mesh;
  tangents_.watch(mesh);
  keep_landmarks(place);
  expanded_here_ += cost;
  return landmarks_.known() ? &landmarks_ : nullptr;
}

void CornerGraph::keep_landmarks(const Mesh::Place& start) {
  if (mesh_->version != version_) {
    version_ = mesh_->version;
    expanded_here_ = 0;
    landmarks_.forget();
  }
  if (!landmarks_.known() && expanded_here_ >= worth_ * mesh_->vertices.size())
    landmarks_.measure(*mesh_, start, tangents_);
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
