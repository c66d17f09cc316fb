#pragma once

#include <cstdint>
#include <vector>

#include "navvi_nav/exact_polygon.hpp"
#include "navvi_nav/mesh.hpp"

namespace navvi_nav {

/// A whole straight side of a polygon of the mesh.
struct Side {
  HalfPlane line;  ///< the polygon is inside
  int begin = 0;   ///< vertex; the side ends where the next begins
  int number = 0;  ///< of the edge of the floor polygon on which it lies, or ExactPolygon::kCut
};

/// A link and the side through which it leaves.
struct Crossing {
  int polygon = 0;
  int side = 0;
  double along = 0.0;  ///< m, grows along the side
  Link link;
};

/// Finds where polygons touch over some length: their sides lie on one line, from both sides.
class Matcher {
 public:
  void clear();
  /// \param fresh  only sides of which at least one is fresh are matched
  void add(const std::vector<Side>& sides, int side, int polygon, bool fresh,
           const std::vector<Vertex>& vertices);
  /// Adds both ways of each match to `out`, in no certain order.
  void match(std::vector<Crossing>& out);

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

/// Gives the polygon its corners and links.
/// \param first, last  its links, in order of side and place
void bound(Polygon& polygon, const std::vector<Side>& sides, const Crossing* first,
           const Crossing* last);

}  // namespace navvi_nav
