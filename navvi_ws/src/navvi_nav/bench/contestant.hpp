#pragma once

#include <functional>
#include <string>
#include <vector>

#include "course.hpp"

namespace navvi_nav::bench {

/// One of the searches that are compared: `find` works on what `locate` left in it, so that only
/// the search itself need be timed.
struct Contestant {
  std::string name;
  std::function<bool(const Query&)> locate;  ///< false: an end of the query is off the mesh
  std::function<Path()> find;                ///< empty: no path
  /// Makes its mesh one with these discs, where the contest is among discs.
  std::function<void(const std::vector<Cylinder>&)> place = nullptr;
};

/// Our searches on our mesh, then on the very polygons that Detour searches, then Detour.
[[nodiscard]] std::vector<Contestant> contestants(Course& course);

/// Our exact search on a mesh with holes, then Detour on the one that TileCache builds.
[[nodiscard]] std::vector<Contestant> among_discs(Course& course);

inline constexpr std::size_t kOursOnDetours = 2;  ///< index of the exact one on Detour's polygons

}  // namespace navvi_nav::bench
