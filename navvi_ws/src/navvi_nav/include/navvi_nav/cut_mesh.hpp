#pragma once

#include <vector>

#include "navvi_nav/boundary.hpp"
#include "navvi_nav/exact_polygon.hpp"
#include "navvi_nav/grounds.hpp"
#include "navvi_nav/mesh.hpp"
#include "navvi_nav/parts.hpp"
#include "navvi_nav/pinches.hpp"
#include "navvi_nav/vertex_pool.hpp"

namespace navvi_nav {

/// A floor of convex polygons with round holes that come and go (R-NAV-4, R-NAV-5).
///
/// The floor's polygons are kept as they are. One that holes reach into is shown as the pieces that
/// they leave of it, and is cut anew from the whole when one of them changes, so that a floor
/// without holes is the very floor that was given, whatever happened before. Only these polygons
/// and their neighbours are looked at: the cost follows what changed, not the floor.
class CutMesh {
 public:
  CutMesh() = default;
  /// \param floor  polygons that do not overlap; they are numbered from 0 \param unit  m, of theirs
  CutMesh(const std::vector<GridPolygon>& floor, double unit);
  /// Takes polygons out of the floor and puts others in. There must be no holes: take them out
  /// before. \param gone  numbers of polygons \returns the numbers of those that came
  std::vector<int> change_floor(const std::vector<int>& gone, const std::vector<GridPolygon>& come);

  /// Changes what the next update() makes of the mesh.
  /// \param center, radius  m \param sides  of the hole, as Hole::place() \returns a number for
  /// remove()
  int add(Point center, double radius, int sides);
  void remove(int hole);
  /// \returns polygons of the floor that were cut anew
  int update();

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

 private:
  using Ground = Grounds::Ground;
  /// What must be known besides of a polygon of the mesh.
  struct Piece {
    int ground = 0;
    std::vector<Side> sides;
    std::vector<int> link_sides;  ///< through which each link leaves
    Point low;                    ///< m
    Point high;
  };
  struct Opening {
    Hole hole;
    Point center;  ///< steps
    double radius = 0.0;
    std::vector<int> grounds;  ///< that it reaches into
    std::vector<int> corners;  ///< vertices
  };

  [[nodiscard]] Point position(const Meeting& at) const;
  [[nodiscard]] ExactPolygon shape_of(const GridPolygon& polygon) const;
  void begin();
  void remove_ground(int ground);
  int add_ground(const ExactPolygon& shape);
  void find_neighbours(int ground);
  void add_places(int polygon, std::vector<int>& out) const;
  void set_corner(int vertex, bool corner);
  [[nodiscard]] bool is_floor_corner(int vertex) const;
  [[nodiscard]] bool cut_before(int a, int b) const;
  void keep_links(int ground, bool all_sides);
  void cut(int ground);
  void clear_pieces(int ground);
  void add_piece(int ground, const ExactPolygon& shape);
  int free_slot(int ground);
  void recut();
  void link();
  void keep_parts();
  void shrink();

  double unit_ = 1.0;   // m
  double steps_ = 1.0;  // in a unit
  Mesh mesh_;
  Grounds grounds_;
  /// As mesh_.polygons; the first ones belong to the ground of their number.
  std::vector<Piece> pieces_;
  std::vector<int> free_pieces_;
  std::vector<Opening> openings_;
  std::vector<int> free_openings_;
  VertexPool pool_;
  Pinches pinches_;
  Parts parts_;
  std::size_t own_vertices_ = 0;  // that the floor uses
  std::size_t vertices_end_ = 0;  // one beyond the last of these

  // Kept for their memory, and valid during one update only.
  std::vector<int> changed_;  // polygons of the mesh
  std::vector<int> near_edges_;
  std::vector<const Hole*> holes_;
  std::vector<Crossing> crossings_;  // of changed polygons
  Forest regions_;                   // of touched grounds and their neighbours
  std::vector<Parts::Changed> changed_parts_;
  Matcher matcher_;
  Cutter cutter_;
};

}  // namespace navvi_nav
