#include "navvi_floor/pieces.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace navvi_floor {
namespace {

/// By spreading each number as long as it gets anywhere.
std::vector<std::uint32_t> spread(const std::vector<bool>& in, int width, int corner) {
  std::vector<std::uint32_t> out(in.size(), 0);
  std::uint32_t count = 0;
  const int cells = static_cast<int>(in.size());
  const auto touch = [&](int a, int b) {
    const int x = std::abs(a % width - b % width), y = std::abs(a / width - b / width);
    return corner == 1 ? x <= 1 && y <= 1 : x + y <= 1;
  };
  for (int first = 0; first < cells; ++first) {
    if (!in[static_cast<std::size_t>(first)] || out[static_cast<std::size_t>(first)] != 0) continue;
    out[static_cast<std::size_t>(first)] = ++count;
    for (bool more = true; more;) {
      more = false;
      for (int a = 0; a < cells; ++a)
        for (int b = 0; b < cells; ++b) {
          std::uint32_t& to = out[static_cast<std::size_t>(b)];
          if (out[static_cast<std::size_t>(a)] != count || to != 0 || !touch(a, b)) continue;
          if (in[static_cast<std::size_t>(b)]) more = (to = count) != 0;
        }
    }
  }
  return out;
}

TEST(Pieces, are_numbered_as_by_spreading_over_every_pair_of_cells) {
  std::mt19937 random(1);
  for (int grid = 0; grid < 600; ++grid) {
    const int width = 1 + static_cast<int>(random() % 9), height = static_cast<int>(random() % 9);
    std::vector<bool> in(static_cast<std::size_t>(width * height));
    const auto share = static_cast<unsigned>(grid % 5);
    for (std::size_t i = 0; i < in.size(); ++i) in[i] = random() % 5 > share;
    for (const int corner : {0, 1})
      EXPECT_EQ(pieces_of(static_cast<std::size_t>(width), static_cast<std::size_t>(height),
                          static_cast<std::size_t>(corner), [&](std::size_t at) { return in[at]; }),
                spread(in, width, corner))
          << grid;
  }
}

}  // namespace
}  // namespace navvi_floor
