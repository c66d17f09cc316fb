#include "search/polyanya.hpp"

namespace navvi_nav::search {
namespace {

constexpr double kTie = 2e-12;                  // of a length: paths that differ less are equal
constexpr double kQuantum = 1.0 / (1LL << 36);  // m, of the keys in the open list
constexpr int kGBits = 11;  // of these keys, by which among equal estimates the deepest is first
constexpr int kMostAround = 64;    // polygons at a vertex
constexpr double kOnLine = 1e-12;  // m, how far a point may lie from a line that runs through it
constexpr double kTouch = 1e-10;   // m, from a point to an edge that it lies on

double extent(Point a) { return std::abs(a.x) + std::abs(a.y); }

/// 1 where `b` lies left of the ray `a`, -1 right of it, 0 on its line.
/// \param a_extent, b_extent  sums of the absolute coordinates
int side(Point a, double a_extent, Point b, double b_extent) {
  const double value = cross(a, b);
  const double slack = kOnLine * (a_extent + b_extent);
  return (value > slack ? 1 : 0) - (value < -slack ? 1 : 0);
}

int side(Point a, Point b) { return side(a, extent(a), b, extent(b)); }

/// Finds the polygons that contain a place: more than one if it lies on a portal or a vertex.
void find_polygons_at(const mesh::Mesh& mesh, const mesh::Mesh::Place& place,
                      std::vector<int>& polygons) {
  polygons.assign(1, place.polygon);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (const mesh::Portal& portal : mesh.polygon(polygons[i]).portals) {
      const Point near =
          nearest_on_segment(place.point, mesh.at(portal.right), mesh.at(portal.left));
      if (distance(near, place.point) <= kTouch &&
          std::find(polygons.begin(), polygons.end(), portal.to) == polygons.end())
        polygons.push_back(portal.to);
    }
  }
}

}  // namespace

bool Polyanya::find(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                    const mesh::Mesh::Place& goal, const Price& price, Path& path) {
  path.clear();
  price_ = price;
  begin(mesh, start, goal);
  if (mesh.polygon(start.polygon).component != mesh.polygon(goal.polygon).component) return false;
  for (const int polygon : start_polygons_) {
    if (std::find(goal_polygons_.begin(), goal_polygons_.end(), polygon) != goal_polygons_.end()) {
      reach(start_, -1, 0.0);
      trace(start_, path);
      return true;
    }
  }
  expand_start();
  SearchNode node;
  while (nodes_expanded_ < price_.nodes && pop(node)) {
    if (node.cost > reached_[static_cast<std::size_t>(node.root)].cost * (1.0 + kTie)) continue;
    if (node.polygon < 0) {
      trace(node.root, path);
      return true;
    }
    ++nodes_expanded_;
    expand(node);
  }
  return false;
}

void Polyanya::begin(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                     const mesh::Mesh::Place& goal) {
  mesh_ = &mesh;
  from_ = start.point;
  to_ = goal.point;
  start_ = static_cast<int>(mesh.vertices.size());
  if (reached_.size() < mesh.vertices.size() + 1) reached_.resize(mesh.vertices.size() + 1);
  dominance_.begin(mesh.polygons.size());
  if (++query_ == 0) {
    for (Reached& reached : reached_) reached.query = 0;
    query_ = 1;
  }
  nodes_.clear();
  unused_.clear();
  open_.clear();
  nodes_expanded_ = 0;
  find_polygons_at(mesh, start, start_polygons_);
  find_polygons_at(mesh, goal, goal_polygons_);
}

void Polyanya::expand_start() {
  reach(start_, -1, 0.0);
  for (const int polygon : start_polygons_) {
    for (const mesh::Portal& portal : mesh_->polygon(polygon).portals) {
      if (std::find(start_polygons_.begin(), start_polygons_.end(), portal.to) !=
          start_polygons_.end())
        continue;
      const Point c = mesh_->at(portal.right);
      const Point d = mesh_->at(portal.left);
      if (side(c - from_, d - from_) <= 0) {
        enter_collinear(portal, start_, 0.0);
        continue;
      }
      SearchNode node{0.0,          c - from_,   d - from_, start_, portal.to,
                      portal.right, portal.left, true,      true};
      add(node, c, d);
    }
  }
}

void Polyanya::expand(const SearchNode& node) {
  if (std::find(goal_polygons_.begin(), goal_polygons_.end(), node.polygon) !=
      goal_polygons_.end()) {
    see_goal(node);
    return;
  }
  const Point root = at(node.root);
  const double right_extent = extent(node.right);
  const double left_extent = extent(node.left);
  const auto end = [&](int vertex) {
    const Point ahead = mesh_->at(vertex) - root;
    if (vertex == node.root) return End{vertex, ahead, 0, 0};
    const double ahead_extent = extent(ahead);
    return End{vertex, ahead, side(node.right, right_extent, ahead, ahead_extent),
               side(node.left, left_extent, ahead, ahead_extent)};
  };
  End d{-1, {}, 0, 0};
  for (const mesh::Portal& portal : mesh_->polygon(node.polygon).portals) {
    if (portal.right == node.portal_left && portal.left == node.portal_right) continue;
    __builtin_prefetch(&mesh_->polygon(portal.to));  // large meshes are slow to read
    // Most portals begin where the one before ended.
    const End c = portal.right == d.vertex ? d : end(portal.right);
    d = end(portal.left);
    enter(node, portal, c, d);
  }
}

/// Goes on through a portal between the ends `c` and `d`: straight as far as the root sees it, and
/// by turns into the rest.
void Polyanya::enter(const SearchNode& node, const mesh::Portal& portal, const End& c,
                     const End& d) {
  // If the node is 180 degrees wide, both borders lie on one line.
  if (d.right < 0 || (d.right == 0 && d.vertex != node.root && dot(node.right, d.ahead) > 0.0)) {
    if (node.right_end) turn(node, portal, true, true);
    return;
  }
  if (c.left > 0 || (c.left == 0 && c.vertex != node.root && dot(node.left, c.ahead) > 0.0)) {
    if (node.left_end) turn(node, portal, false, true);
    return;
  }
  const bool right_in = c.right >= 0;
  const bool left_in = d.left <= 0;
  const bool right_end = right_in && c.vertex != node.root;
  const bool left_end = left_in && d.vertex != node.root;
  if (right_end && left_end && side(c.ahead, d.ahead) <= 0) {
    enter_collinear(portal, node.root, node.cost);
    return;
  }
  // The first root that sees a corner becomes its parent and is followed from there. A root that
  // sees it along a border does not: its node covers one side of the corner only.
  if (c.right > 0 && is_corner(c.vertex))
    reach(c.vertex, node.root, node.cost + norm(c.ahead) + price_.turn);
  if (d.left < 0 && is_corner(d.vertex))
    reach(d.vertex, node.root, node.cost + norm(d.ahead) + price_.turn);
  add({node.cost, right_end ? c.ahead : node.right, left_end ? d.ahead : node.left, node.root,
       portal.to, portal.right, portal.left, right_end, left_end},
      mesh_->at(portal.right), mesh_->at(portal.left));
  if (!right_in && node.right_end) turn(node, portal, true, false);
  if (!left_in && node.left_end) turn(node, portal, false, false);
}

/// A portal in line with the root can only be entered by a turn at its near end.
void Polyanya::enter_collinear(const mesh::Portal& portal, int root, double cost) {
  const Point c = mesh_->at(portal.right) - at(root);
  const Point d = mesh_->at(portal.left) - at(root);
  const bool to_right = dot(c, c) < dot(d, d);
  const int vertex = to_right ? portal.right : portal.left;
  const Point ahead = to_right ? c : d;
  if (!is_corner(vertex)) return;
  const int origin = origin_of(root, ahead);
  SearchNode next{cost + norm(ahead) + (origin == root ? price_.turn : 0.0),
                  to_right ? -1.0 * ahead : ahead,
                  to_right ? ahead : -1.0 * ahead,
                  vertex,
                  portal.to,
                  portal.right,
                  portal.left,
                  !to_right,
                  to_right};
  if (reach(vertex, origin, next.cost)) add(next, mesh_->at(portal.right), mesh_->at(portal.left));
}

/// Turns round an end of the portal through which the polygon was entered, into `portal`.
/// \param whole  false: only into the part of the portal that the root does not see
void Polyanya::turn(const SearchNode& node, const mesh::Portal& portal, bool to_right, bool whole) {
  const Point root = at(node.root);
  const int near = to_right ? portal.right : portal.left;
  const int far = to_right ? portal.left : portal.right;
  int vertex = to_right ? node.portal_right : node.portal_left;
  if (whole && near != vertex && side(to_right ? node.right : node.left, at(near) - root) == 0)
    vertex = near;
  if (!is_corner(vertex)) return;
  const Point ahead = at(vertex) - root;
  const int origin = origin_of(node.root, ahead);
  const double cost = node.cost + norm(ahead) + (origin == node.root ? price_.turn : 0.0);
  if (!has_wall(vertex, node.polygon, ahead, to_right) || !reach(vertex, origin, cost)) return;
  const bool beside = near != vertex;
  const Point to_near = beside ? at(near) - at(vertex) : -1.0 * ahead;
  const Point to_far = at(far) - at(vertex);
  if (beside && side(to_near, to_far) == 0) {
    enter_collinear(portal, vertex, cost);
    return;
  }
  const Point border = whole ? to_far : ahead;
  add({cost, to_right ? to_near : border, to_right ? border : to_near, vertex, portal.to,
       portal.right, portal.left, to_right ? beside : whole, to_right ? whole : beside},
      at(portal.right), at(portal.left));
}

void Polyanya::see_goal(const SearchNode& node) {
  const Point root = at(node.root);
  const Point ahead = to_ - root;
  SearchNode last = node;
  last.polygon = -1;
  const bool over_right = side(node.right, ahead) < 0;
  const bool over_left = side(node.left, ahead) > 0;
  if (!over_right && !over_left) {
    push(last, node.cost + norm(ahead));
    return;
  }
  if (over_right ? !node.right_end : !node.left_end) return;
  last.root = over_right ? node.portal_right : node.portal_left;
  const Point corner = at(last.root);
  const int origin = origin_of(node.root, corner - root);
  last.cost += distance(root, corner) + (origin == node.root ? price_.turn : 0.0);
  if (reach(last.root, origin, last.cost)) push(last, last.cost + distance(corner, to_));
}

/// The root at which a path that leaves `root` in this direction has turned last: `root`, or its
/// parent if the path is straight at `root`.
int Polyanya::origin_of(int root, Point ahead) const {
  const int parent = reached_[static_cast<std::size_t>(root)].parent;
  if (parent < 0) return root;
  const Point before = at(root) - at(parent);
  return side(before, ahead) == 0 ? parent : root;
}

/// True if a path that enters the polygon at the vertex has a wall on that side of it there.
bool Polyanya::has_wall(int vertex, int polygon, Point ahead, bool on_right) const {
  const Point here = at(vertex);
  for (int steps = 0; steps < kMostAround; ++steps) {
    const std::vector<int>& corners = mesh_->polygon(polygon).corners;
    const auto found = std::find(corners.begin(), corners.end(), vertex);
    if (found == corners.end()) return true;
    const int next = on_right ? (found + 1 == corners.end() ? corners.front() : found[1])
                              : (found == corners.begin() ? corners.back() : found[-1]);
    const Point edge = at(next) - here;
    const int where = side(ahead, edge);
    if (on_right ? where > 0 : where < 0) return false;
    const auto& portals = mesh_->polygon(polygon).portals;
    const auto portal =
        std::find_if(portals.begin(), portals.end(), [&](const mesh::Portal& candidate) {
          return (on_right ? candidate.right : candidate.left) == vertex;
        });
    if (portal == portals.end()) return true;
    polygon = portal->to;
  }
  return true;
}

/// Records a path to a vertex. Of equally short ones only those are followed that come from the
/// first parent. That is enough: if a shortest path to the goal comes to the vertex from another
/// parent, then the path over the first parent with the same rest is as short, so it is a shortest
/// one too, hence taut, and the search nodes of the first parent contain it. A path that is
/// straight at the vertex does not turn there and is recorded with its origin as parent
/// (origin_of). Equal means up to rounding: kTie of the length a vertex. \returns false if the path
/// need not be followed
bool Polyanya::reach(int vertex, int parent, double cost) {
  Reached& known = reached_[static_cast<std::size_t>(vertex)];
  if (known.query != query_ || cost < known.cost * (1.0 - kTie)) {
    known = {cost, parent, query_};
    return true;
  }
  return known.parent == parent && cost <= known.cost * (1.0 + kTie);
}

void Polyanya::add(const SearchNode& node, const Point& portal_right, const Point& portal_left) {
  if (price_.narrow > 0.0 && distance(portal_right, portal_left) < price_.narrow &&
      (is_corner(node.portal_right) || is_corner(node.portal_left)))
    return;
  if (is_dominated(node)) return;
  const Point root = at(node.root);
  if (node.right_end && node.left_end) dominance_.insert(node, root);
  push(node, node.cost + node.heuristic(root, portal_right, portal_left, to_, price_.turn));
}

/// True if over another root, which sees the whole portal, the path to each point of the interval
/// is no longer. A node whose root is the parent of a corner at an end of its interval is never
/// dominated, so that no path is lost where both are equal.
bool Polyanya::is_dominated(const SearchNode& node) {
  const DominanceTable::Entry* const other = dominance_.other(node);
  if (other == nullptr || node.root == node.portal_right || node.root == node.portal_left)
    return false;
  const auto is_parent_of = [&](int vertex, Point ahead) {
    const Reached& known = reached_[static_cast<std::size_t>(vertex)];
    return is_corner(vertex) && known.query == query_ &&
           (known.parent == node.root || known.parent == origin_of(node.root, ahead));
  };
  if ((node.right_end && is_parent_of(node.portal_right, node.right)) ||
      (node.left_end && is_parent_of(node.portal_left, node.left)))
    return false;
  const Point root = at(node.root);
  return other->dominates(node.interval(root, at(node.portal_right), at(node.portal_left)), root,
                          node.cost, kTie * node.cost);
}

void Polyanya::push(const SearchNode& node, double estimate) {
  if (estimate > price_.most) return;
  if (node.polygon >= 0) __builtin_prefetch(mesh_->polygon(node.polygon).portals.data());
  std::uint32_t slot;
  if (unused_.empty()) {
    slot = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(node);
  } else {
    slot = unused_.back();
    unused_.pop_back();
    nodes_[slot] = node;
  }
  const auto f = static_cast<std::uint64_t>(estimate * (1.0 / kQuantum));
  const auto rest = static_cast<std::uint64_t>((1.0 - node.cost / std::max(estimate, 1e-12)) *
                                               ((1 << kGBits) - 1));
  open_.push((f << kGBits) | rest, slot);
}

bool Polyanya::pop(SearchNode& node) {
  if (open_.empty()) return false;
  const std::uint32_t slot = open_.pop().item;
  node = nodes_[slot];
  unused_.push_back(slot);
  return true;
}

void Polyanya::trace(int root, Path& path) const {
  path.push_back(to_);
  for (; root >= 0; root = reached_[static_cast<std::size_t>(root)].parent) {
    const Point next = at(root);
    if (next == path.back()) continue;
    if (path.size() > 1) {
      const Point a = path[path.size() - 2] - path.back();
      const Point b = next - path.back();
      if (side(a, b) == 0 && dot(a, b) < 0.0) path.pop_back();
    }
    path.push_back(next);
  }
  std::reverse(path.begin(), path.end());
}

}  // namespace navvi_nav::search
