#pragma once

#include <vector>

#include "navvi_nav/boundary.hpp"

namespace navvi_nav {

/// Crossings in any order, to be asked for by polygon. Keeps its memory.
class Crossings {
 public:
  void clear() { crossings_.clear(); }
  void add(const Crossing& crossing) { crossings_.push_back(crossing); }
  /// After the last add(). \param polygons  of the mesh
  void sort_out(std::size_t polygons);
  /// Those of a polygon in the order of its boundary. To be asked once for each polygon that has
  /// any, before the next clear(); valid until the next call.
  const std::vector<Crossing>& take(int polygon);

 private:
  std::vector<Crossing> crossings_;
  std::vector<int> first_;  // of each polygon; -1: none
  std::vector<int> next_;   // of the same polygon
  std::vector<Crossing> around_;
};

}  // namespace navvi_nav
