#include "bake/tile_cells.hpp"

#include <numeric>

namespace navvi_nav::bake {

std::int64_t TileCells::count_open() const {
  std::int64_t count = 0;
  for (int y = kBorder; y < kBorder + size; ++y) {
    const auto row = open.begin() + std::ptrdiff_t{y} * (size + 2 * kBorder) + kBorder;
    count += std::accumulate(row, row + size, std::int64_t{0});
  }
  return count;
}

}  // namespace navvi_nav::bake
