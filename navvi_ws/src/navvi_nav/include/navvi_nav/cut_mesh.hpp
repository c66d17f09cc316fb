#pragma once

#include <vector>

#include "navvi_nav/boundary.hpp"
#include "navvi_nav/box_grid.hpp"
#include "navvi_nav/exact_polygon.hpp"
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
  /// A polygon of the floor.
  struct Ground {
    struct Neighbour {
      int ground = 0;
      int edge = 0;  ///< number of our edge that it touches
    };
    ExactPolygon shape;
    std::vector<Neighbour> neighbours;
    std::vector<int> holes;   ///< that reach into it
    std::vector<int> pieces;  ///< its polygons in the mesh
  };
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
  void end();
  void find_borders(const ExactPolygon& shape);
  void remove_ground(int ground);
  int add_ground(const ExactPolygon& shape);
  void find_neighbours(int ground);
  void mark_corner(int vertex);
  [[nodiscard]] bool cut_before(int a, int b) const;
  void touch(int ground);
  void find_borders();
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
  std::vector<Ground> grounds_;
  /// As mesh_.polygons; the first ones belong to the ground of their number.
  std::vector<Piece> pieces_;
  std::vector<int> free_pieces_;
  std::vector<int> free_grounds_;
  std::vector<Opening> openings_;
  std::vector<int> free_openings_;
  VertexPool pool_;
  Pinches pinches_;
  Parts parts_;
  std::vector<char> corners_;     // of vertices: 1 if the floor makes them corners
  std::size_t own_vertices_ = 0;  // that the floor uses
  std::size_t vertices_end_ = 0;  // one beyond the last of these
  BoxGrid ground_grid_;

  // Kept for their memory, and valid during one update only.
  enum Mark : char { kNone, kTouched, kBorder };
  std::vector<char> marks_;   // of grounds
  std::vector<int> touched_;  // grounds to be cut anew
  std::vector<int> borders_;  // their neighbours that are not
  std::vector<int> changed_;  // polygons of the mesh
  std::vector<int> near_edges_;
  std::vector<const Hole*> holes_;
  std::vector<Crossing> crossings_;
  std::vector<int> first_crossing_;  // of each polygon of the mesh; -1: none
  std::vector<int> next_crossing_;   // of the same polygon
  std::vector<Crossing> around_;     // one polygon
  Forest regions_;                   // of touched grounds and their neighbours
  std::vector<Parts::Changed> changed_parts_;
  Matcher matcher_;
  Cutter cutter_;
};

}  // namespace navvi_nav
