#pragma once

#include <functional>
#include <string>
#include <vector>

#include "course.hpp"

namespace navvi_nav {

/// One of the searches that are compared: `find` works on what `locate` left in it, so that only
/// the search itself need be timed.
struct Contestant {
  std::string name;
  std::function<bool(const Query&)> locate;  ///< false: an end of the query is off the mesh
  std::function<Path()> find;                ///< empty: no path
};

/// Our searches on our mesh, then on the very polygons that Detour searches, then Detour.
[[nodiscard]] std::vector<Contestant> contestants(Course& course);

inline constexpr std::size_t kOursOnDetours = 2;  ///< index of the exact one on Detour's polygons

}  // namespace navvi_nav
