#pragma once

#include <cstdint>
#include <vector>

#include "mesh/exact_polygon.hpp"
#include "mesh/mesh.hpp"

namespace navvi_nav::mesh {

/// A whole straight side of a polygon of the mesh.
struct Side {
  HalfPlane line;  ///< the polygon is inside
  int begin = 0;   ///< vertex; the side ends where the next begins
  int number = 0;  ///< of the edge of the floor polygon on which it lies, or ExactPolygon::kCut
};

/// A portal and the side through which it leaves.
struct SidePortal {
  int polygon = 0;
  int side = 0;
  double along = 0.0;  ///< m, grows along the side
  Portal portal;
};

/// Finds where polygons touch over some length: where two sides lie on the same line, one on the
/// left of it and one on the right, and overlap.
class EdgeMatcher {
 public:
  void clear();
  /// \param fresh  only sides of which at least one is fresh are matched
  void add(const std::vector<Side>& sides, int side, int polygon, bool fresh,
           const std::vector<Vertex>& vertices);
  /// Adds two portals a match to `out`, one in each direction, in no certain order.
  void match(std::vector<SidePortal>& out);

 private:
  struct Entry {
    double low = 0.0;  // m, along the line
    double high = 0.0;
    HalfPlane line;  // the same from both sides
    int low_vertex = 0;
    int high_vertex = 0;
    int polygon = 0;
    int side = 0;
    bool ahead = true;  // the polygon is on the left of the line
    bool fresh = false;
  };
  struct Key {
    std::uint64_t line = 0;  // hashed
    double low = 0.0;
    std::size_t entry = 0;
  };

  std::vector<Entry> entries_;
  std::vector<Key> keys_;
};

/// m, of a vertex of the side; grows along it.
[[nodiscard]] double along(const Side& side, Point at);

/// Gives the polygon its corners and portals.
/// \param first, last  its portals, in order of side and place
void bound(Polygon& polygon, const std::vector<Side>& sides, const SidePortal* first,
           const SidePortal* last);

}  // namespace navvi_nav::mesh
