#pragma once

#include <optional>
#include <set>
#include <vector>

#include "mesh/base_polygons.hpp"
#include "mesh/components.hpp"
#include "mesh/edge_matcher.hpp"
#include "mesh/exact_polygon.hpp"
#include "mesh/mesh.hpp"
#include "mesh/non_manifold_vertices.hpp"
#include "mesh/vertex_pool.hpp"

namespace navvi_nav::mesh {

/// A floor of convex polygons with round holes that come and go (R-NAV-4, R-NAV-5).
///
/// The polygons of the floor, the base polygons, are kept unchanged. The mesh holds the pieces that
/// holes leave of them. When a hole changes, each base polygon that it reaches is cut again from
/// the whole, so a floor without holes is exactly the floor that was given, whatever happened
/// before. Only these polygons and their neighbours are visited: the cost follows what changed, not
/// the size of the floor.
class CutMesh {
 public:
  CutMesh() = default;
  /// \param floor  polygons that do not overlap; they are numbered from 0 \param unit  m, of their
  /// coordinates
  CutMesh(const std::vector<GridPolygon>& floor, double unit);
  /// Removes polygons from the floor and adds others. There must be no holes: remove them before.
  /// \param gone  numbers of polygons \param come  new polygons \returns the numbers of the new
  /// ones
  std::vector<int> change_floor(const std::vector<int>& gone, const std::vector<GridPolygon>& come);

  /// Changes what the next update() makes of the mesh.
  /// \param center, radius  m \param sides  of the hole, as Hole::place() \returns a number for
  /// remove()
  int add(Point center, double radius, int sides);
  void remove(int hole);
  /// \returns base polygons that were cut again
  int update();

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  /// Components of the floor, holes disregarded, of which a part is within `reach` (m).
  [[nodiscard]] std::set<int> floor_components(Point point, double reach) const;
  /// The point of these components, holes disregarded, that is nearest to `point`. Looks at each
  /// polygon of the floor.
  [[nodiscard]] std::optional<Point> nearest_on_floor(Point point,
                                                      const std::set<int>& components) const;

 private:
  /// What is kept besides about a polygon of the mesh.
  struct Piece {
    int base = 0;
    std::vector<Side> sides;
    std::vector<int> portal_sides;  ///< through which each portal leaves
    Point low;                      ///< m
    Point high;
  };
  struct PlacedHole {
    Hole hole;
    Point center;  ///< steps
    double radius = 0.0;
    std::vector<int> bases;    ///< that it reaches into
    std::vector<int> corners;  ///< vertices
  };
  /// Kept for its memory, and valid during one update only.
  struct Scratch {
    std::vector<int> changed;  ///< polygons of the mesh
    std::vector<int> near_edges;
    std::vector<const Hole*> holes;
    std::vector<SidePortal> side_portals;  ///< of changed polygons
    navvi_types::DisjointSets<int> regions;  ///< of touched base polygons and their neighbours
    std::vector<Components::Changed> changed_components;
    EdgeMatcher matcher;
    Cutter cutter;
  };

  [[nodiscard]] Point position(const Intersection& at) const;
  [[nodiscard]] Point nearest_on_base(Point point, int base) const;
  [[nodiscard]] ExactPolygon shape_of(const GridPolygon& polygon) const;
  void begin();
  void remove_base(int base);
  int add_base(const ExactPolygon& shape);
  void find_neighbours(int base);
  void add_places(int polygon, std::vector<int>& out) const;
  void set_corner(int vertex, bool corner);
  [[nodiscard]] bool is_floor_corner(int vertex) const;
  [[nodiscard]] bool cut_before(int a, int b) const;
  void keep_portals(int base, bool all_sides);
  void cut(int base);
  void clear_pieces(int base);
  void add_piece(int base, const ExactPolygon& shape);
  int free_slot(int base);
  void recut();
  void connect();
  void keep_components();
  void shrink();

  double unit_ = 1.0;   // m
  double steps_ = 1.0;  // in a unit
  Mesh mesh_;
  BasePolygons bases_;
  /// As mesh_.polygons; the first ones belong to the base polygon of their number.
  std::vector<Piece> pieces_;
  std::vector<int> free_pieces_;
  std::vector<PlacedHole> placed_holes_;
  std::vector<int> free_holes_;
  VertexPool pool_;
  NonManifoldVertices non_manifold_;
  Components components_;
  std::size_t own_vertices_ = 0;  // that the floor uses
  std::size_t vertices_end_ = 0;  // one beyond the last of these
  Scratch scratch_;
};

}  // namespace navvi_nav::mesh
