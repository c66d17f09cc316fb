#include "smooth/channel.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace navvi_nav::smooth {
namespace {

/// A hall with a pillar on the straight way through it.
class Pillar : public testing::Test {
 protected:
  Pillar() : mesh_(plan::NavMeshConfig{}), channel_(below_, hall(), room_) {}
  map::Space hall() {
    SmallWorld world;
    world.room(12, 8).box(5.8, 3.8, 0, 6.2, 4.2, 1.0);
    EXPECT_EQ(mesh_.set_map(world.voxels()).error, "");
    return mesh_.space();
  }
  plan::NavMesh mesh_;
  Clearances room_;
  const Path below_{{2, 4}, {5.7, 3.4}, {6.3, 3.4}, {10, 4}};
  const Channel channel_;
};

TEST_F(Pillar, holds_the_path_it_was_made_of) { EXPECT_TRUE(channel_.holds(below_)); }

TEST_F(Pillar, holds_a_path_a_little_farther_off) {
  EXPECT_TRUE(channel_.holds({{2, 4}, {6, 3.1}, {10, 4}}));
}

TEST_F(Pillar, does_not_hold_a_path_on_the_other_side) {
  EXPECT_FALSE(channel_.holds({{2, 4}, {5.7, 4.6}, {6.3, 4.6}, {10, 4}}));
}

TEST_F(Pillar, does_not_hold_a_path_that_strays_or_has_other_ends) {
  EXPECT_FALSE(channel_.holds({{2, 4}, {6, 1.5}, {10, 4}}));
  EXPECT_FALSE(channel_.holds({{2, 4}, {5.7, 3.4}, {6.3, 3.4}, {10, 4.1}}));
  EXPECT_FALSE(channel_.holds({{2, 4}, {5.7, 3.4}, {6.3, 3.4}}));
  EXPECT_FALSE(channel_.holds({}));
}

TEST_F(Pillar, does_not_hold_a_path_round_the_pillar_and_on) {
  EXPECT_FALSE(
      channel_.holds({{2, 4}, {6, 3.1}, {7, 3.6}, {7, 5}, {5, 5}, {5, 3.4}, {6, 3.1}, {10, 4}}));
}

TEST_F(Pillar, has_rungs_that_are_free_and_as_long_as_there_is_room) {
  int full = 0;
  for (std::size_t i = 0; i < channel_.size(); ++i) {
    const Channel::Rung& rung = channel_.rungs()[i];
    EXPECT_LE(rung.low, 0);
    EXPECT_GE(rung.high, 0);
    for (int sample = rung.low; sample <= rung.high; ++sample)
      EXPECT_GE(mesh_.space().clearance(channel_.point(i, sample)), room_.radius - 1e-9);
    if (rung.low == -Channel::kSide) ++full;
    if (rung.corner) {
      EXPECT_LT(rung.high, Channel::kSide);  // the pillar is to the left
    }
  }
  EXPECT_GT(full, 8);
}

TEST_F(Pillar, can_be_narrowed_until_nothing_is_left_beside_the_path) {
  Channel channel = channel_;
  const std::size_t last = channel.size() - 1;
  const Point a = channel.point(1, -2);
  const Point b = channel.point(last - 1, -2);
  int times = 0;
  while (channel.narrow(1, last - 1, a, b)) ASSERT_LT(++times, 200);
  EXPECT_GT(times, 0);
  EXPECT_TRUE(channel.holds(below_));
}

}  // namespace
}  // namespace navvi_nav::smooth

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
