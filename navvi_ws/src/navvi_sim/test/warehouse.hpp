#pragma once

#include "navvi_sim/layout.hpp"

namespace navvi_sim {

/// The layout that ships as "warehouse".
inline WorldDescription warehouse(std::uint64_t seed) {
  return layout("warehouse", preset("warehouse").value(), seed);
}

}  // namespace navvi_sim
