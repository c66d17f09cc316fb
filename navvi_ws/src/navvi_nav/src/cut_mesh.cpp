#include "navvi_nav/cut_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace navvi_nav {
namespace {

constexpr double kFinest = 1e-4;     // m, a step at most
constexpr double kSquare = 2.0;      // m, of the grids in which polygons are looked up
constexpr double kStraight = 1e-12;  // rad, above the rounding of a sum of angles

std::size_t slot(int index) { return static_cast<std::size_t>(index); }

void widen(Point& low, Point& high, Point at) {
  low = {std::min(low.x, at.x), std::min(low.y, at.y)};
  high = {std::max(high.x, at.x), std::max(high.y, at.y)};
}

}  // namespace

CutMesh::CutMesh(const std::vector<GridPolygon>& floor, double unit) : unit_(unit) {
  while (unit / steps_ > kFinest) steps_ *= 2.0;
  Point low, high;
  bool first = true;
  for (const GridPolygon& polygon : floor) {
    for (const auto& corner : polygon.corners) {
      const Point at{corner[0] * unit, corner[1] * unit};
      if (std::exchange(first, false)) low = high = at;
      widen(low, high, at);
    }
  }
  grounds_ = Grounds(low, high, kSquare, unit_ / steps_);
  mesh_.grid = BoxGrid(low, high, kSquare);
  change_floor({}, floor);
}

std::vector<int> CutMesh::change_floor(const std::vector<int>& gone,
                                       const std::vector<GridPolygon>& come) {
  std::vector<ExactPolygon> shapes;
  for (const GridPolygon& polygon : come) shapes.push_back(shape_of(polygon));
  begin();
  pinches_.keep_none();
  for (const int ground : gone) grounds_.touch(ground);
  grounds_.find_borders();
  for (const ExactPolygon& shape : shapes) grounds_.find_borders(shape);
  for (const int ground : grounds_.borders()) keep_links(ground, true);
  std::vector<int> doubtful;
  for (const int ground : gone) add_places(ground, doubtful);
  for (const int vertex : doubtful) set_corner(vertex, false);
  for (const int ground : gone) remove_ground(ground);
  std::vector<int> numbers;
  for (const ExactPolygon& shape : shapes) numbers.push_back(add_ground(shape));
  link();
  for (const int ground : grounds_.touched()) find_neighbours(ground);
  for (const int ground : grounds_.borders()) find_neighbours(ground);
  for (const int index : changed_) add_places(index, doubtful);
  std::sort(doubtful.begin(), doubtful.end());
  doubtful.erase(std::unique(doubtful.begin(), doubtful.end()), doubtful.end());
  for (const int vertex : doubtful) set_corner(vertex, is_floor_corner(vertex));
  pinches_.split(mesh_, pool_, changed_);
  pinches_.keep_all();
  grounds_.settle();
  own_vertices_ = pool_.in_use();
  vertices_end_ = mesh_.vertices.size();
  parts_.number(mesh_);
  return numbers;
}

ExactPolygon CutMesh::shape_of(const GridPolygon& polygon) const {
  const auto steps = static_cast<std::int64_t>(steps_);
  std::vector<Step> corners;
  for (const auto& corner : polygon.corners)
    corners.push_back({corner[0] * steps, corner[1] * steps});
  return exact_polygon(corners);
}

void CutMesh::remove_ground(int number) {
  clear_pieces(number);
  for (const ExactPolygon::Edge& edge : grounds_[number].shape.edges) {
    const int vertex = pool_.take(mesh_.vertices, position(edge.begin));
    pool_.drop(mesh_.vertices, vertex);
    pool_.drop(mesh_.vertices, vertex);
  }
  grounds_.remove(number);
}

int CutMesh::add_ground(const ExactPolygon& shape) {
  const int number = grounds_.add(shape);
  pieces_.resize(grounds_.size());
  mesh_.polygons.resize(grounds_.size());
  for (const ExactPolygon::Edge& edge : shape.edges)
    pool_.take(mesh_.vertices, position(edge.begin));
  cut(number);
  return number;
}

void CutMesh::find_neighbours(int number) {
  std::vector<Ground::Neighbour>& neighbours = grounds_[number].neighbours;
  const Piece& piece = pieces_[slot(number)];
  const Polygon& polygon = mesh_.polygon(number);
  neighbours.clear();
  for (std::size_t k = 0; k < polygon.links.size(); ++k)
    neighbours.push_back({polygon.links[k].to, piece.sides[slot(piece.link_sides[k])].number});
}

/// Where the corners of a polygon of the mesh are.
void CutMesh::add_places(int polygon, std::vector<int>& out) const {
  for (const int corner : mesh_.polygon(polygon).corners) out.push_back(pool_.place_of(corner));
}

/// While there are no holes, only the floor makes corners. \param vertex  of its place, no twin
void CutMesh::set_corner(int vertex, bool corner) {
  if (corner && !pool_.marked(vertex)) pool_.mark(mesh_.vertices, vertex);
  if (!corner && pool_.marked(vertex)) pool_.unmark(mesh_.vertices, vertex);
}

/// True if a wall ends at the vertex and the free angle around it is over 180 degrees. The groups
/// at a pinch are told apart later.
bool CutMesh::is_floor_corner(int vertex) const {
  double free = 0.0;
  bool walled = false;
  const Point here = mesh_.at(vertex);
  mesh_.grid.visit(here, here, [&](int index) {
    const Polygon& polygon = mesh_.polygon(index);
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const int corner = polygon.corners[k];
      if (pool_.place_of(corner) != vertex) continue;
      free += mesh_.angle_at(polygon, k);
      const auto links = std::count_if(
          polygon.links.begin(), polygon.links.end(),
          [corner](const Link& link) { return link.right == corner || link.left == corner; });
      walled = walled || links < 2;
    }
  });
  return walled && free > M_PI + kStraight;
}

Point CutMesh::position(const Meeting& at) const {
  const Point steps = place_of(at);
  return {steps.x / steps_ * unit_, steps.y / steps_ * unit_};
}

int CutMesh::add(Point center, double radius, int sides) {
  int number = static_cast<int>(openings_.size());
  if (free_openings_.empty()) {
    openings_.emplace_back();
  } else {
    number = free_openings_.back();
    free_openings_.pop_back();
  }
  Opening& opening = openings_[slot(number)];
  opening.center = (steps_ / unit_) * center;
  opening.radius = steps_ / unit_ * radius;
  opening.hole.place(opening.center, opening.radius, sides);
  const ExactPolygon& shape = opening.hole.shape;
  if (shape.edges.empty()) return number;
  grounds_.visit(shape, [&](int ground) {
    std::vector<int>& holes = grounds_[ground].holes;
    if (!holes.empty() && holes.back() == number) return;
    if (!overlap(grounds_[ground].shape, shape)) return;
    holes.push_back(number);
    opening.grounds.push_back(ground);
    grounds_.touch(ground);
  });
  if (opening.grounds.empty()) return number;
  for (const ExactPolygon::Edge& edge : shape.edges) {
    opening.corners.push_back(pool_.take(mesh_.vertices, position(edge.begin)));
    pool_.mark(mesh_.vertices, opening.corners.back());
  }
  return number;
}

void CutMesh::remove(int number) {
  Opening& opening = openings_[slot(number)];
  for (const int ground : opening.grounds) {
    std::vector<int>& holes = grounds_[ground].holes;
    holes.erase(std::find(holes.begin(), holes.end(), number));
    grounds_.touch(ground);
  }
  for (const int corner : opening.corners) {
    pool_.unmark(mesh_.vertices, corner);
    pool_.drop(mesh_.vertices, corner);
  }
  opening.grounds.clear();
  opening.corners.clear();
  free_openings_.push_back(number);
}

int CutMesh::update() {
  const auto count = static_cast<int>(grounds_.touched().size());
  if (count == 0) return 0;
  recut();
  pinches_.split(mesh_, pool_, changed_);
  grounds_.settle();
  shrink();
  return count;
}

void CutMesh::recut() {
  begin();
  grounds_.find_borders();
  for (const int ground : grounds_.borders()) keep_links(ground, false);
  for (const int ground : grounds_.touched()) cut(ground);
  link();
  keep_parts();
}

void CutMesh::begin() {
  matcher_.clear();
  crossings_.clear();
  changed_.clear();
}

/// Of a neighbour's pieces along a touched ground: the links that stay, and the sides to be linked.
void CutMesh::keep_links(int number, bool all_sides) {
  const Ground& ground = grounds_[number];
  near_edges_.clear();
  for (const Ground::Neighbour& next : ground.neighbours) {
    if (grounds_.is_touched(next.ground)) near_edges_.push_back(next.edge);
  }
  for (const int index : ground.pieces) {
    const Piece& piece = pieces_[slot(index)];
    bool changes = false;
    for (std::size_t k = 0; k < piece.sides.size(); ++k) {
      const int edge = piece.sides[k].number;
      if (!all_sides &&
          std::find(near_edges_.begin(), near_edges_.end(), edge) == near_edges_.end())
        continue;
      matcher_.add(piece.sides, static_cast<int>(k), index, false, mesh_.vertices);
      changes = true;
    }
    if (!changes) continue;
    changed_.push_back(index);
    const Polygon& polygon = mesh_.polygons[slot(index)];
    pinches_.forget(pool_, polygon);
    for (std::size_t i = 0; i < polygon.links.size(); ++i) {
      const Link& link = polygon.links[i];
      if (grounds_.is_touched(pieces_[slot(link.to)].ground)) continue;
      const int side = piece.link_sides[i];
      crossings_.push_back({index,
                            side,
                            along(piece.sides[slot(side)], mesh_.at(link.right)),
                            {link.to, pool_.place_of(link.right), pool_.place_of(link.left)}});
    }
  }
}

/// One order for equal holes, whatever the order in which they came.
bool CutMesh::cut_before(int a, int b) const {
  const Opening& p = openings_[slot(a)];
  const Opening& q = openings_[slot(b)];
  return std::tie(p.center.x, p.center.y, p.radius) < std::tie(q.center.x, q.center.y, q.radius);
}

void CutMesh::cut(int number) {
  clear_pieces(number);
  Ground& ground = grounds_[number];
  if (ground.shape.edges.size() < 3) return;
  std::sort(ground.holes.begin(), ground.holes.end(),
            [this](int a, int b) { return cut_before(a, b); });
  holes_.clear();
  for (const int hole : ground.holes) holes_.push_back(&openings_[slot(hole)].hole);
  cutter_.cut(ground.shape, holes_);
  for (std::size_t i = 0; i < cutter_.count(); ++i) add_piece(number, cutter_.piece(i));
}

void CutMesh::clear_pieces(int number) {
  Ground& ground = grounds_[number];
  for (const int index : ground.pieces) {
    Piece& piece = pieces_[slot(index)];
    mesh_.grid.remove(index, piece.low, piece.high);
    for (const Side& side : piece.sides) pool_.drop(mesh_.vertices, side.begin);
    piece.sides.clear();
    pinches_.forget(pool_, mesh_.polygons[slot(index)]);
    mesh_.polygons[slot(index)].corners.clear();
    mesh_.polygons[slot(index)].links.clear();
    if (index != number) free_pieces_.push_back(index);
  }
  ground.pieces.clear();
}

int CutMesh::free_slot(int number) {
  if (grounds_[number].pieces.empty()) return number;
  if (free_pieces_.empty()) {
    mesh_.polygons.emplace_back();
    pieces_.emplace_back();
    return static_cast<int>(pieces_.size()) - 1;
  }
  const int index = free_pieces_.back();
  free_pieces_.pop_back();
  return index;
}

void CutMesh::add_piece(int ground, const ExactPolygon& shape) {
  const int index = free_slot(ground);
  Piece& piece = pieces_[slot(index)];
  piece.ground = ground;
  for (const ExactPolygon::Edge& edge : shape.edges) {
    const int vertex = pool_.take(mesh_.vertices, position(edge.begin));
    // A side too short for doubles has no length.
    if (!piece.sides.empty() && piece.sides.back().begin == vertex) {
      piece.sides.back() = {edge.line, vertex, edge.number};
      pool_.drop(mesh_.vertices, vertex);
    } else {
      piece.sides.push_back({edge.line, vertex, edge.number});
    }
  }
  if (piece.sides.size() > 1 && piece.sides.back().begin == piece.sides.front().begin) {
    pool_.drop(mesh_.vertices, piece.sides.back().begin);
    piece.sides.pop_back();
  }
  piece.low = piece.high = mesh_.at(piece.sides[0].begin);
  for (const Side& side : piece.sides) widen(piece.low, piece.high, mesh_.at(side.begin));
  mesh_.grid.add(index, piece.low, piece.high);
  grounds_[ground].pieces.push_back(index);
  changed_.push_back(index);
  for (std::size_t k = 0; k < piece.sides.size(); ++k)
    matcher_.add(piece.sides, static_cast<int>(k), index, true, mesh_.vertices);
}

void CutMesh::link() {
  matcher_.match(crossings_);
  std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.polygon, a.side, a.along) < std::tie(b.polygon, b.side, b.along);
  });
  std::sort(changed_.begin(), changed_.end());
  const Crossing* next = crossings_.data();
  const Crossing* const end = next + crossings_.size();
  for (const int index : changed_) {
    Piece& piece = pieces_[slot(index)];
    const Crossing* const first = next;
    piece.link_sides.clear();
    for (; next != end && next->polygon == index; ++next) piece.link_sides.push_back(next->side);
    bound(mesh_.polygons[slot(index)], piece.sides, first, next);
    pinches_.learn(pool_, mesh_.polygons[slot(index)]);
  }
}

void CutMesh::keep_parts() {
  regions_.grow(grounds_.size());
  for (const int ground : grounds_.touched()) regions_.add(ground);
  for (const int ground : grounds_.borders()) regions_.add(ground);
  for (const int ground : grounds_.touched()) {
    for (const Ground::Neighbour& next : grounds_[ground].neighbours)
      regions_.unite(ground, next.ground);
  }
  changed_parts_.clear();
  for (const int index : changed_) {
    const int ground = pieces_[slot(index)].ground;
    changed_parts_.push_back({index, grounds_.is_touched(ground), regions_.root(ground)});
  }
  parts_.update(mesh_, changed_parts_);
}

/// Without holes the mesh is as it was at first.
void CutMesh::shrink() {
  if (free_pieces_.size() + grounds_.size() == pieces_.size()) {
    pieces_.resize(grounds_.size());
    mesh_.polygons.resize(grounds_.size());
    free_pieces_.clear();
  }
  if (pool_.in_use() != own_vertices_) return;
  pool_.shrink(mesh_.vertices, vertices_end_);
  parts_.number(mesh_);
}

Mesh join(const std::vector<GridPolygon>& polygons, double cell_size) {
  return CutMesh(polygons, cell_size).mesh();
}

}  // namespace navvi_nav
