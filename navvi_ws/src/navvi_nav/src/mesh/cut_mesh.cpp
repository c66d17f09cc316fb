#include "mesh/cut_mesh.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace navvi_nav::mesh {
namespace {

constexpr double kFinest = 1e-4;     // m, of a lattice step, at most
constexpr double kSquare = 2.0;      // m, of the grids in which polygons are looked up
constexpr double kStraight = 1e-12;  // rad, above the rounding of a sum of angles

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
  bases_ = BasePolygons(low, high, kSquare, unit_ / steps_);
  mesh_.grid = BoxGrid(low, high, kSquare);
  change_floor({}, floor);
}

std::vector<int> CutMesh::change_floor(const std::vector<int>& gone,
                                       const std::vector<GridPolygon>& come) {
  std::vector<ExactPolygon> shapes;
  for (const GridPolygon& polygon : come) shapes.push_back(shape_of(polygon));
  begin();
  non_manifold_.keep_none();
  for (const int base : gone) bases_.touch(base);
  bases_.find_borders();
  for (const ExactPolygon& shape : shapes) bases_.find_borders(shape);
  for (const int base : bases_.borders()) keep_portals(base, true);
  std::vector<int> doubtful;
  for (const int base : gone) add_places(base, doubtful);
  for (const int vertex : doubtful) set_corner(vertex, false);
  for (const int base : gone) remove_base(base);
  std::vector<int> numbers;
  for (const ExactPolygon& shape : shapes) numbers.push_back(add_base(shape));
  connect();
  for (const int base : bases_.touched()) find_neighbours(base);
  for (const int base : bases_.borders()) find_neighbours(base);
  for (const int index : scratch_.changed) add_places(index, doubtful);
  std::sort(doubtful.begin(), doubtful.end());
  doubtful.erase(std::unique(doubtful.begin(), doubtful.end()), doubtful.end());
  for (const int vertex : doubtful) set_corner(vertex, is_floor_corner(vertex));
  non_manifold_.split(mesh_, pool_, scratch_.changed);
  non_manifold_.keep_all();
  bases_.settle();
  own_vertices_ = pool_.in_use();
  vertices_end_ = mesh_.vertices.size();
  components_.number(mesh_);
  for (std::size_t k = 0; k < bases_.size(); ++k)
    bases_[static_cast<int>(k)].component = mesh_.polygons[k].component;
  return numbers;
}

std::set<int> CutMesh::floor_components(Point point, double reach) const {
  std::set<int> found;
  bases_.visit(point - Point{reach, reach}, point + Point{reach, reach}, [&](int number) {
    if (found.count(bases_[number].component) > 0) return;
    if (distance(nearest_on_base(point, number), point) <= reach)
      found.insert(bases_[number].component);
  });
  return found;
}

std::optional<Point> CutMesh::nearest_on_floor(Point point, const std::set<int>& components) const {
  std::optional<Point> best;
  for (int number = 0; number < static_cast<int>(bases_.size()); ++number) {
    if (bases_[number].shape.edges.empty() || components.count(bases_[number].component) == 0)
      continue;
    const Point nearest = nearest_on_base(point, number);
    if (!best || distance(nearest, point) < distance(*best, point)) best = nearest;
  }
  return best;
}

Point CutMesh::nearest_on_base(Point point, int base) const {
  return nearest_in_convex(point, bases_[base].shape.edges,
                           [this](const ExactPolygon::Edge& edge) { return position(edge.begin); });
}

ExactPolygon CutMesh::shape_of(const GridPolygon& polygon) const {
  const auto steps = static_cast<std::int64_t>(steps_);
  std::vector<LatticePoint> corners;
  for (const auto& corner : polygon.corners)
    corners.push_back({corner[0] * steps, corner[1] * steps});
  return exact_polygon(corners);
}

void CutMesh::remove_base(int number) {
  clear_pieces(number);
  for (const ExactPolygon::Edge& edge : bases_[number].shape.edges) {
    const int vertex = pool_.take(mesh_.vertices, position(edge.begin));
    pool_.drop(mesh_.vertices, vertex);
    pool_.drop(mesh_.vertices, vertex);
  }
  bases_.remove(number);
}

int CutMesh::add_base(const ExactPolygon& shape) {
  const int number = bases_.add(shape);
  pieces_.resize(bases_.size());
  mesh_.polygons.resize(bases_.size());
  for (const ExactPolygon::Edge& edge : shape.edges)
    pool_.take(mesh_.vertices, position(edge.begin));
  cut(number);
  return number;
}

void CutMesh::find_neighbours(int number) {
  std::vector<BasePolygon::Neighbour>& neighbours = bases_[number].neighbours;
  const Piece& piece = pieces_[slot(number)];
  const Polygon& polygon = mesh_.polygon(number);
  neighbours.clear();
  for (std::size_t k = 0; k < polygon.portals.size(); ++k)
    neighbours.push_back({polygon.portals[k].to, piece.sides[slot(piece.portal_sides[k])].number});
}

/// The vertices of a polygon's corners, no duplicates.
void CutMesh::add_places(int polygon, std::vector<int>& out) const {
  for (const int corner : mesh_.polygon(polygon).corners) out.push_back(pool_.place_of(corner));
}

/// While there are no holes, only the floor marks corners. \param vertex  no duplicate
void CutMesh::set_corner(int vertex, bool corner) {
  if (corner && !pool_.marked(vertex)) pool_.mark(mesh_.vertices, vertex);
  if (!corner && pool_.marked(vertex)) pool_.unmark(mesh_.vertices, vertex);
}

/// True if a wall ends at the vertex and the free angle around it is over 180 degrees. The groups
/// at a non-manifold vertex are separated later.
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
      const auto portals = std::count_if(polygon.portals.begin(), polygon.portals.end(),
                                         [corner](const Portal& portal) {
                                           return portal.right == corner || portal.left == corner;
                                         });
      walled = walled || portals < 2;
    }
  });
  return walled && free > kPi + kStraight;
}

Point CutMesh::position(const Intersection& at) const {
  const Point steps = place_of(at);
  return {steps.x / steps_ * unit_, steps.y / steps_ * unit_};
}

int CutMesh::add(Point center, double radius, int sides) {
  int number = static_cast<int>(placed_holes_.size());
  if (free_holes_.empty()) {
    placed_holes_.emplace_back();
  } else {
    number = free_holes_.back();
    free_holes_.pop_back();
  }
  PlacedHole& placed = placed_holes_[slot(number)];
  placed.center = (steps_ / unit_) * center;
  placed.radius = steps_ / unit_ * radius;
  placed.hole.place(placed.center, placed.radius, sides);
  const ExactPolygon& shape = placed.hole.shape;
  if (shape.edges.empty()) return number;
  bases_.visit(shape, [&](int base) {
    std::vector<int>& holes = bases_[base].holes;
    if (!holes.empty() && holes.back() == number) return;
    if (!overlap(bases_[base].shape, shape)) return;
    holes.push_back(number);
    placed.bases.push_back(base);
    bases_.touch(base);
  });
  if (placed.bases.empty()) return number;
  for (const ExactPolygon::Edge& edge : shape.edges) {
    placed.corners.push_back(pool_.take(mesh_.vertices, position(edge.begin)));
    pool_.mark(mesh_.vertices, placed.corners.back());
  }
  return number;
}

void CutMesh::remove(int number) {
  PlacedHole& placed = placed_holes_[slot(number)];
  for (const int base : placed.bases) {
    std::vector<int>& holes = bases_[base].holes;
    holes.erase(std::find(holes.begin(), holes.end(), number));
    bases_.touch(base);
  }
  for (const int corner : placed.corners) {
    pool_.unmark(mesh_.vertices, corner);
    pool_.drop(mesh_.vertices, corner);
  }
  placed.bases.clear();
  placed.corners.clear();
  free_holes_.push_back(number);
}

int CutMesh::update() {
  const auto count = static_cast<int>(bases_.touched().size());
  if (count == 0) return 0;
  recut();
  non_manifold_.split(mesh_, pool_, scratch_.changed);
  bases_.settle();
  shrink();
  return count;
}

void CutMesh::recut() {
  begin();
  bases_.find_borders();
  for (const int base : bases_.borders()) keep_portals(base, false);
  for (const int base : bases_.touched()) cut(base);
  connect();
  keep_components();
}

void CutMesh::begin() {
  scratch_.matcher.clear();
  scratch_.side_portals.clear();
  scratch_.changed.clear();
}

/// Of the pieces of a border polygon: keeps the portals that stay, and adds the sides along touched
/// polygons to the matcher.
void CutMesh::keep_portals(int number, bool all_sides) {
  const BasePolygon& base = bases_[number];
  scratch_.near_edges.clear();
  for (const BasePolygon::Neighbour& next : base.neighbours) {
    if (bases_.is_touched(next.base)) scratch_.near_edges.push_back(next.edge);
  }
  for (const int index : base.pieces) {
    const Piece& piece = pieces_[slot(index)];
    bool changes = false;
    for (std::size_t k = 0; k < piece.sides.size(); ++k) {
      const int edge = piece.sides[k].number;
      if (!all_sides && std::find(scratch_.near_edges.begin(), scratch_.near_edges.end(), edge) ==
                            scratch_.near_edges.end())
        continue;
      scratch_.matcher.add(piece.sides, static_cast<int>(k), index, false, mesh_.vertices);
      changes = true;
    }
    if (!changes) continue;
    scratch_.changed.push_back(index);
    const Polygon& polygon = mesh_.polygons[slot(index)];
    non_manifold_.forget(pool_, polygon);
    for (std::size_t i = 0; i < polygon.portals.size(); ++i) {
      const Portal& portal = polygon.portals[i];
      if (bases_.is_touched(pieces_[slot(portal.to)].base)) continue;
      const int side = piece.portal_sides[i];
      scratch_.side_portals.push_back(
          {index,
           side,
           along(piece.sides[slot(side)], mesh_.at(portal.right)),
           {portal.to, pool_.place_of(portal.right), pool_.place_of(portal.left)}});
    }
  }
}

/// The same order for the same holes, whatever the order in which they were added.
bool CutMesh::cut_before(int a, int b) const {
  const PlacedHole& p = placed_holes_[slot(a)];
  const PlacedHole& q = placed_holes_[slot(b)];
  return std::tie(p.center.x, p.center.y, p.radius) < std::tie(q.center.x, q.center.y, q.radius);
}

void CutMesh::cut(int number) {
  clear_pieces(number);
  BasePolygon& base = bases_[number];
  if (base.shape.edges.size() < 3) return;
  std::sort(base.holes.begin(), base.holes.end(),
            [this](int a, int b) { return cut_before(a, b); });
  scratch_.holes.clear();
  for (const int hole : base.holes) scratch_.holes.push_back(&placed_holes_[slot(hole)].hole);
  scratch_.cutter.cut(base.shape, scratch_.holes);
  for (std::size_t i = 0; i < scratch_.cutter.count(); ++i)
    add_piece(number, scratch_.cutter.piece(i));
}

void CutMesh::clear_pieces(int number) {
  BasePolygon& base = bases_[number];
  for (const int index : base.pieces) {
    Piece& piece = pieces_[slot(index)];
    mesh_.grid.remove(index, piece.low, piece.high);
    for (const Side& side : piece.sides) pool_.drop(mesh_.vertices, side.begin);
    piece.sides.clear();
    non_manifold_.forget(pool_, mesh_.polygons[slot(index)]);
    mesh_.polygons[slot(index)].corners.clear();
    mesh_.polygons[slot(index)].portals.clear();
    if (index != number) free_pieces_.push_back(index);
  }
  base.pieces.clear();
}

int CutMesh::free_slot(int number) {
  if (bases_[number].pieces.empty()) return number;
  if (free_pieces_.empty()) {
    mesh_.polygons.emplace_back();
    pieces_.emplace_back();
    return static_cast<int>(pieces_.size()) - 1;
  }
  const int index = free_pieces_.back();
  free_pieces_.pop_back();
  return index;
}

void CutMesh::add_piece(int base, const ExactPolygon& shape) {
  const int index = free_slot(base);
  Piece& piece = pieces_[slot(index)];
  piece.base = base;
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
  bases_[base].pieces.push_back(index);
  scratch_.changed.push_back(index);
  for (std::size_t k = 0; k < piece.sides.size(); ++k)
    scratch_.matcher.add(piece.sides, static_cast<int>(k), index, true, mesh_.vertices);
}

void CutMesh::connect() {
  scratch_.matcher.match(scratch_.side_portals);
  std::sort(scratch_.side_portals.begin(), scratch_.side_portals.end(),
            [](const SidePortal& a, const SidePortal& b) {
              return std::tie(a.polygon, a.side, a.along) < std::tie(b.polygon, b.side, b.along);
            });
  std::sort(scratch_.changed.begin(), scratch_.changed.end());
  const SidePortal* next = scratch_.side_portals.data();
  const SidePortal* const end = next + scratch_.side_portals.size();
  for (const int index : scratch_.changed) {
    Piece& piece = pieces_[slot(index)];
    const SidePortal* const first = next;
    piece.portal_sides.clear();
    for (; next != end && next->polygon == index; ++next) piece.portal_sides.push_back(next->side);
    bound(mesh_.polygons[slot(index)], piece.sides, first, next);
    non_manifold_.learn(pool_, mesh_.polygons[slot(index)]);
  }
}

void CutMesh::keep_components() {
  scratch_.regions.grow(bases_.size());
  for (const int base : bases_.touched()) scratch_.regions.add(base);
  for (const int base : bases_.borders()) scratch_.regions.add(base);
  for (const int base : bases_.touched()) {
    for (const BasePolygon::Neighbour& next : bases_[base].neighbours)
      scratch_.regions.unite(base, next.base);
  }
  scratch_.changed_components.clear();
  for (const int index : scratch_.changed) {
    const int base = pieces_[slot(index)].base;
    scratch_.changed_components.push_back(
        {index, bases_.is_touched(base), scratch_.regions.root(base)});
  }
  components_.update(mesh_, scratch_.changed_components);
}

/// Without holes the mesh is as it was before the first one.
void CutMesh::shrink() {
  if (free_pieces_.size() + bases_.size() == pieces_.size()) {
    pieces_.resize(bases_.size());
    mesh_.polygons.resize(bases_.size());
    free_pieces_.clear();
  }
  if (pool_.in_use() != own_vertices_) return;
  pool_.shrink(mesh_.vertices, vertices_end_);
  components_.number(mesh_);
}

}  // namespace navvi_nav::mesh
