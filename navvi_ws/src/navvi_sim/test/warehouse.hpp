#pragma once

#include "generate/layout.hpp"

namespace navvi_sim {

/// The layout that ships as "warehouse".
inline WorldDescription warehouse(std::uint64_t seed) {
  return generate::layout("warehouse", generate::preset("warehouse").value(), seed);
}

}  // namespace navvi_sim
