#include "navvi_floor/floor.hpp"

#include <gtest/gtest.h>

#include "navvi_floor/floor.hpp"

namespace navvi_floor {
namespace {

TEST(Bands, of_a_copy_are_shared_until_it_writes_and_the_original_stays) {
  const Bands<int> all(3, 2 * Bands<int>::kRows + 5, 7);
  Bands<int> copy = all;
  EXPECT_TRUE(copy == all);
  copy.own_row(Bands<int>::kRows)[2] = 8;
  EXPECT_EQ(all.at(2, Bands<int>::kRows), 7);
  EXPECT_EQ(copy.at(2, Bands<int>::kRows), 8);
  EXPECT_FALSE(copy == all);
  for (int y = 0; y < all.rows(); ++y)
    EXPECT_EQ(copy.shares(y, all), y / Bands<int>::kRows != 1) << y;
  EXPECT_FALSE(all == Bands<int>(3, 5, 7));
}

TEST(Floor, of_a_changed_map_shares_its_distances_but_for_the_rows_around_the_change) {
  constexpr int kSide = 1200;
  const FloorDistances distances{1.0, 0.35};
  FloorGround ground{{0, 0}, 0.1, 0.0, {kSide, kSide, Ground::floor}};
  const Floor before(ground, distances);
  const Floor same(ground, distances, 2, &before);
  ground.ground.own_row(600)[600] = Ground::obstacle;
  const Floor after(ground, distances, 2, &before);
  const Floor anew(ground, distances);
  int own = 0;
  for (int y = 0; y < kSide; ++y) {
    EXPECT_EQ(same.gap2_row(y), before.gap2_row(y));
    own += after.gap2_row(y) != before.gap2_row(y) || after.open_row(y) != before.open_row(y);
    ASSERT_TRUE(std::equal(after.gap2_row(y), after.gap2_row(y) + kSide, anew.gap2_row(y))) << y;
    ASSERT_TRUE(std::equal(after.open_row(y), after.open_row(y) + kSide, anew.open_row(y))) << y;
  }
  EXPECT_GT(own, 0);
  EXPECT_LE(own, 256 + Bands<int>::kRows);
  EXPECT_NE(before.gap({600, 600}), 0.0);
}

}  // namespace
}  // namespace navvi_floor
