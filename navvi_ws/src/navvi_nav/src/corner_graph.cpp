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
  heap_.clear();
  if (stops_.size() < mesh.vertices.size()) stops_.resize(mesh.vertices.size());
  if (edges_.size() < mesh.vertices.size()) edges_.resize(mesh.vertices.size());
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
    for (const Sight::Corner& corner : sight_.look(mesh, start)) reach(corner, -1, corner.away);
  }
  while (!heap_.empty()) {
    const Entry entry = pop();
    if (entry.estimate >= best_) break;
    Stop& here = stop(entry.vertex);
    if (!here.open) continue;
    here.open = false;
    ++nodes_expanded_;
    expand(entry.vertex, here, start.point);
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

void CornerGraph::keep_landmarks(const Mesh::Place& start) {
  if (mesh_->version != version_) {
    version_ = mesh_->version;
    expanded_here_ = 0;
    landmarks_.forget();
  }
  if (!landmarks_.known() && expanded_here_ >= worth_ * mesh_->vertices.size())
    landmarks_.measure(*mesh_, start, [this](int vertex, int polygon) -> decltype(auto) {
      return seen_from(vertex, polygon);
    });
}

/// A shortest path bends round a corner: it leaves on the side to which it turned.
void CornerGraph::expand(int vertex, const Stop& here, Point start) {
  const double cost = here.cost;
  const int turn = here.turn;
  const Point before = mesh_->at(vertex) - (here.parent < 0 ? start : mesh_->at(here.parent));
  const double before_extent = std::abs(before.x) + std::abs(before.y);
  for (const Sight::Corner& corner : seen_from(vertex, here.polygon)) {
    if (turn * corner.turned < 0) continue;
    const double ahead_extent = std::abs(corner.ahead.x) + std::abs(corner.ahead.y);
    if (turn * side_of(before, before_extent, corner.ahead, ahead_extent) < 0) continue;
    reach(corner, vertex, cost + corner.away);
  }
}

CornerGraph::Stop& CornerGraph::stop(int vertex) {
  Stop& out = stops_[static_cast<std::size_t>(vertex)];
  if (out.query != query_) {
    out = {};
    out.query = query_;
    out.cost = std::numeric_limits<double>::infinity();
    out.rest = distance(mesh_->at(vertex), goal_);
    if (landmarks_.known()) out.rest = std::max(out.rest, landmarks_.at_least(vertex));
  }
  return out;
}

void CornerGraph::reach(const Sight::Corner& corner, int parent, double cost) {
  Stop& to = stop(corner.vertex);
  if (cost >= to.cost) return;
  to.cost = cost;
  to.parent = parent;
  to.polygon = corner.polygon;
  to.turn = corner.turn;
  to.open = true;
  if (to.sees_goal && cost + to.last < best_) {
    best_ = cost + to.last;
    last_ = corner.vertex;
  }
  if (cost + to.rest < best_) push(cost + to.rest, corner.vertex);
}

const std::vector<Sight::Corner>& CornerGraph::seen_from(int vertex, int polygon) {
  Edges& edges = edges_[static_cast<std::size_t>(vertex)];
  if (edges.version != mesh_->version) {
    edges.version = mesh_->version;
    edges.to = sight_.look(*mesh_, vertex, polygon);
  }
  return edges.to;
}

void CornerGraph::push(double estimate, int vertex) {
  std::size_t i = heap_.size();
  heap_.push_back({estimate, vertex});
  while (i > 0) {
    const std::size_t up = (i - 1) / 4;
    if (heap_[up].estimate <= estimate) break;
    heap_[i] = heap_[up];
    i = up;
  }
  heap_[i] = {estimate, vertex};
}

CornerGraph::Entry CornerGraph::pop() {
  const Entry least = heap_.front();
  const Entry entry = heap_.back();
  heap_.pop_back();
  const std::size_t count = heap_.size();
  std::size_t i = 0;
  while (4 * i + 1 < count) {
    std::size_t next = 4 * i + 1;
    for (std::size_t k = next + 1; k < std::min(4 * i + 5, count); ++k) {
      if (heap_[k].estimate < heap_[next].estimate) next = k;
    }
    if (heap_[next].estimate >= entry.estimate) break;
    heap_[i] = heap_[next];
    i = next;
  }
  if (count > 0) heap_[i] = entry;
  return least;
}

}  // namespace navvi_nav
