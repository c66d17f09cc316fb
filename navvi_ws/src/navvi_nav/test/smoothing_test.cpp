#include "navvi_nav/smoothing.hpp"

#include <gtest/gtest.h>

#include "navvi_nav/nav_mesh.hpp"
#include "navvi_nav/waypoints.hpp"
#include "small_world.hpp"

namespace navvi_nav {
namespace {

class Smoothing : public testing::Test {
 protected:
  Smoothing() {
    world_.room(14, 10).box(4, 3, 0, 9, 6, 1.0);
    EXPECT_EQ(mesh_.set_map(world_.tree()).error, "");
  }
  [[nodiscard]] Path smoothed(const Path& path) const {
    return smooth(path, mesh_.space(), room_, config_);
  }

  SmallWorld world_;
  NavMesh mesh_{NavMeshConfig{}};
  Room room_;
  SmoothingConfig config_;
  const Path zigzag_{{1, 1}, {2, 2.3}, {3, 1.2}, {6, 2.4}, {9, 1.1}, {12, 2.0}, {12, 8}};
};

TEST_F(Smoothing, leaves_paths_of_less_than_two_points_alone) {
  EXPECT_TRUE(smoothed({}).empty());
  EXPECT_EQ(smoothed({{1, 1}}).size(), 1U);
}

TEST_F(Smoothing, survives_two_equal_points) { EXPECT_EQ(smoothed({{1, 1}, {1, 1}}).size(), 2U); }

TEST_F(Smoothing, does_nothing_when_switched_off) {
  config_.enabled = false;
  EXPECT_EQ(smoothed(zigzag_), zigzag_);
}

TEST_F(Smoothing, leaves_a_path_through_an_obstacle_as_it_is) {
  const Path through{{1, 4.5}, {13, 4.5}};
  EXPECT_EQ(smoothed(through), through);
}

TEST_F(Smoothing, shortens_a_zigzag_and_keeps_its_ends) {
  room_.preferred = 0.0;
  const Path path = smoothed(zigzag_);
  EXPECT_LT(length_of(path), length_of(zigzag_));
  EXPECT_EQ(path.front(), zigzag_.front());
  EXPECT_EQ(path.back(), zigzag_.back());
  EXPECT_TRUE(clear(path, mesh_.space(), room_.radius));
}

TEST_F(Smoothing, is_never_dearer_than_the_corner_hugging_path) {
  const Path hugging{{1, 4.5}, {3.6, 2.6}, {9.4, 2.6}, {12, 8}};
  const Path path = smoothed(hugging);
  EXPECT_LT(guide_cost(path, mesh_.space(), room_, config_),
            guide_cost(hugging, mesh_.space(), room_, config_));
  EXPECT_TRUE(clear(path, mesh_.space(), room_.radius));
  EXPECT_LE(length_of(path), std::max(config_.max_stretch * length_of(hugging),
                                      length_of(hugging) + config_.max_detour));
}

TEST_F(Smoothing, gives_equal_paths_for_equal_input) {
  EXPECT_EQ(smoothed(zigzag_), smoothed(zigzag_));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
