#pragma once

#include <cstddef>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::bench {

/// A square hall of cells of 9 x 9 m. Each may hold a loaded shelf and, driving around it, a pallet
/// robot; neighbours share the lane between their shelves. Those nearest to the middle come first.
/// \param cells    along each side
/// \param shelves  at most cells squared
/// \param movers   at most cells squared
[[nodiscard]] WorldDescription hall(int cells, std::size_t shelves, std::size_t movers);

}  // namespace navvi_sim::bench
