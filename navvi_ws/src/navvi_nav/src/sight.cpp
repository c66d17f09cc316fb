#include "navvi_nav/sight.hpp"

namespace navvi_nav {
namespace {

constexpr double kTouch = 1e-10;  // m, from a point to an edge that it lies on

double extent(Point a) { return std::abs(a.x) + std::abs(a.y); }
int side(Point a, Point b) { return side_of(a, extent(a), b, extent(b)); }

bool has(const std::vector<int>& items, int item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

}  // namespace

void surround(const Mesh& mesh, const Mesh::Place& place, std::vector<int>& polygons) {
  polygons.assign(1, place.polygon);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (const Link& link : mesh.polygon(polygons[i]).links) {
      const Point near = nearest_on_segment(place.point, mesh.at(link.right), mesh.at(link.left));
      if (distance(near, place.point) <= kTouch && !has(polygons, link.to))
        polygons.push_back(link.to);
    }
  }
}

const std::vector<Sight::Corner>& Sight::look(const Mesh& mesh, const Mesh::Place& place,
                                              const Mesh::Place* target) {
  mesh_ = &mesh;
  from_ = place.point;
  walls_.known = false;
  skips_ = false;  // the way may be gone in the other direction
  surround(mesh, place, around_);
  around_target_.clear();
  target_seen_ = false;
  if (target != nullptr) {
    target_ = target->point;
    surround(mesh, *target, around_target_);
    for (const int polygon : around_) target_seen_ = target_seen_ || has(around_target_, polygon);
  }
  sweep();
  return corners_;
}

const std::vector<Sight::Corner>& Sight::look(const Mesh& mesh, int vertex, int polygon) {
  mesh_ = &mesh;
  from_ = mesh.at(vertex);
  around_target_.clear();
  target_seen_ = false;
  around_.assign(1, polygon);
  skips_ = true;
  int walls = 0;
  for (std::size_t i = 0; i < around_.size(); ++i) {
    const Polygon& here = mesh.polygon(around_[i]);
    bool in = false, out = false;
    for (const Link& link : here.links) {
      if (link.right != vertex && link.left != vertex) continue;
      (link.right == vertex ? out : in) = true;
      if (!has(around_, link.to)) around_.push_back(link.to);
    }
    if (in && out) continue;
    const auto found = std::find(here.corners.begin(), here.corners.end(), vertex);
    if (found == here.corners.end()) continue;
    const auto next = found + 1 == here.corners.end() ? here.corners.begin() : found + 1;
    const auto before = found == here.corners.begin() ? here.corners.end() - 1 : found - 1;
    if (!out) walls_.out = mesh.at(*next) - from_, ++walls;
    if (!in) walls_.in = mesh.at(*before) - from_, ++walls;
  }
  walls_.known = walls == 2;
  sweep();
  return corners_;
}

Sight::Walls Sight::survey(const Mesh& mesh, int vertex, int polygon,
                           std::vector<Glimpse>& glimpses) {
  glimpses_ = &glimpses;
  look(mesh, vertex, polygon);
  glimpses_ = nullptr;
  return walls_;
}

bool Sight::sees(const Mesh& mesh, const Mesh::Place& place, const Mesh::Place& target) {
  surround(mesh, place, around_);
  surround(mesh, target, around_target_);
  start_number(mesh);
  const Point ahead = target.point - place.point;
  for (const int polygon : around_) swept_[static_cast<std::size_t>(polygon)] = number_;
  waiting_ = around_;
  while (!waiting_.empty()) {
    const int polygon = waiting_.back();
    waiting_.pop_back();
    if (has(around_target_, polygon)) return true;
    for (const Link& link : mesh.polygon(polygon).links) {
      std::uint32_t& swept = swept_[static_cast<std::size_t>(link.to)];
      if (swept == number_) continue;
      const Point c = mesh.at(link.right) - place.point;
      const Point d = mesh.at(link.left) - place.point;
      if (side(c, ahead) < 0 || side(d, ahead) > 0 || side(c, d) <= 0) continue;
      swept = number_;
      waiting_.push_back(link.to);
    }
  }
  return false;
}

std::pair<int, int> Sight::Walls::sides(Point ahead) const {
  return {side(ahead, in), side(ahead, out)};
}

std::optional<int> Sight::Walls::turn(Point ahead) const {
  if (!known) return 0;
  const auto [in_side, out_side] = sides(ahead);
  if (in_side * out_side < 0) return std::nullopt;
  return in_side != 0 ? in_side : out_side;
}

void Sight::start_number(const Mesh& mesh) {
  if (met_.size() < mesh.vertices.size()) met_.resize(mesh.vertices.size(), 0);
  if (swept_.size() < mesh.polygons.size()) swept_.resize(mesh.polygons.size(), 0);
  if (++number_ != 0) return;
  std::fill(met_.begin(), met_.end(), 0);
  std::fill(swept_.begin(), swept_.end(), 0);
  number_ = 1;
}

void Sight::sweep() {
  start_number(*mesh_);
  corners_.clear();
  cones_.clear();
  for (const int polygon : around_) {
    swept_[static_cast<std::size_t>(polygon)] = number_;
    if (glimpses_ != nullptr) glimpses_->push_back({polygon});
    for (const Link& link : mesh_->polygon(polygon).links) {
      const Point c = mesh_->at(link.right) - from_;
      const Point d = mesh_->at(link.left) - from_;
      if (has(around_, link.to)) {
        look_along(link, c, d);
        continue;
      }
      if (side(c, d) > 0) {
        cones_.push_back({c, d, link.to, link.right, link.left, true, true, false, false,
                          link.right, link.left});
      } else {
        look_along(link, c, d);
      }
    }
  }
  while (!cones_.empty()) {
    const Cone cone = cones_.back();
    cones_.pop_back();
    pass(cone);
  }
}

void Sight::pass(Cone cone) {
  const Polygon& polygon = mesh_->polygon(cone.polygon);
  swept_[static_cast<std::size_t>(cone.polygon)] = number_;
  if (glimpses_ != nullptr) glimpses_->push_back({cone.polygon, cone.right_at, cone.left_at});
  const double right_extent = extent(cone.right);
  const double left_extent = extent(cone.left);
  const auto right_side = [&](Point point) {
    return side_of(cone.right, right_extent, point, extent(point));
  };
  const auto left_side = [&](Point point) {
    return side_of(cone.left, left_extent, point, extent(point));
  };
  if (has(around_target_, cone.polygon) && right_side(target_ - from_) >= 0 &&
      left_side(target_ - from_) <= 0)
    target_seen_ = true;
  const auto& corners = polygon.corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    // Round an end of the link a path can turn if something of the polygon lies behind it; along
    // a wall behind it, it can go on to where it turns.
    const int next = corners[k + 1 < corners.size() ? k + 1 : 0];
    if (cone.right_end && !cone.right_met && corners[k] == cone.link_right &&
        right_side(mesh_->at(next) - from_) <= 0)
      cone.right_met = meet(cone.link_right, cone.polygon, cone.right, -1);
    if (cone.left_end && !cone.left_met && next == cone.link_left &&
        left_side(mesh_->at(corners[k]) - from_) >= 0)
      cone.left_met = meet(cone.link_left, cone.polygon, cone.left, 1);
  }
  // Most links begin where the one before ended.
  struct End {
    int vertex;
    Point ahead;
    int right;
    int left;
  };
  const auto end = [&](int vertex) {
    const Point ahead = mesh_->at(vertex) - from_;
    return End{vertex, ahead, right_side(ahead), left_side(ahead)};
  };
  End d{-1, {}, 0, 0};
  for (const Link& link : polygon.links) {
    if (link.right == cone.link_left && link.left == cone.link_right) continue;
    const End c = link.right == d.vertex ? d : end(link.right);
    d = end(link.left);
    if (d.right < 0 || c.left > 0) continue;
    if (c.right >= 0 && d.left <= 0 && side(c.ahead, d.ahead) <= 0) {
      look_along(link, c.ahead, d.ahead);
      continue;
    }
    if (d.right == 0 || c.left == 0) continue;
    cones_.push_back(
        {c.right >= 0 ? c.ahead : cone.right, d.left <= 0 ? d.ahead : cone.left, link.to,
         link.right, link.left, c.right >= 0, d.left <= 0, skips_ && cone.right_met && c.right <= 0,
         skips_ && cone.left_met && d.left >= 0, c.right >= 0 ? link.right : cone.right_at,
         d.left <= 0 ? link.left : cone.left_at});
  }
}

/// A link in the line of sight: into it a path turns at its near end.
void Sight::look_along(const Link& link, Point c, Point d) {
  const bool right_first = dot(c, c) < dot(d, d);
  const bool between = dot(c, d) < 0.0;
  if (extent(c) > 0.0) meet(link.right, link.to, c, right_first && !between ? -1 : 0);
  if (extent(d) > 0.0) meet(link.left, link.to, d, right_first || between ? 0 : 1);
}

bool Sight::meet(int vertex, int polygon, Point ahead, std::int8_t turn) {
  if (!mesh_->vertices[static_cast<std::size_t>(vertex)].corner) return false;
  int turned = 0;
  if (walls_.known) {
    const std::optional<int> turn_here = walls_.turn(ahead);
    if (!turn_here) return false;
    turned = *turn_here;
  }
  std::uint32_t& met = met_[static_cast<std::size_t>(vertex)];
  if (met == number_) {
    for (Corner& corner : corners_) {
      if (corner.vertex == vertex && corner.turn != turn) corner.turn = 0;
    }
    return true;
  }
  met = number_;
  corners_.push_back({ahead, norm(ahead), vertex, polygon, turn, static_cast<std::int8_t>(turned)});
  return true;
}

}  // namespace navvi_nav
