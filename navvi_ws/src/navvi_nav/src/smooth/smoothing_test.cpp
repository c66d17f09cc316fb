#include "smooth/smoothing.hpp"

#include <gtest/gtest.h>

#include "plan/planner.hpp"
#include "small_world.hpp"
#include "smooth/waypoints.hpp"

namespace navvi_nav::smooth {
namespace {

class Smoothing : public testing::Test {
 protected:
  Smoothing() {
    world_.room(14, 10).box(4, 3, 0, 9, 6, 1.0);
    EXPECT_EQ(mesh_.set_map(world_.voxels()).error, "");
  }
  [[nodiscard]] Path smoothed(const Path& path) const {
    return smooth(path, mesh_.space(), room_, config_);
  }

  SmallWorld world_;
  plan::NavMesh mesh_{plan::NavMeshConfig{}};
  Clearances room_;
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

TEST_F(Smoothing, saves_turns_that_do_not_pay) {
  const Path zigzag{{1, 8}, {3, 7.6}, {5, 8.2}, {7, 7.7}, {9, 8.1}, {13, 8}};
  EXPECT_EQ(smoothed(zigzag), (Path{zigzag.front(), zigzag.back()}));
}

/// Which side of each pole a path passes, and in which order: the rays it crosses that go up from
/// the poles, to the right positive, with what cancels left out. Two paths with the same ends are
/// homotopic in the plane without the poles exactly if these words are equal.
std::vector<int> word_of(const Path& path, const std::vector<Point>& poles) {
  std::vector<int> word;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point a = path[i - 1];
    const Point b = path[i];
    std::vector<std::pair<double, int>> crossed;  // share of the leg, letter
    for (std::size_t k = 0; k < poles.size(); ++k) {
      if ((a.x < poles[k].x) == (b.x < poles[k].x)) continue;
      const double share = (poles[k].x - a.x) / (b.x - a.x);
      if (a.y + share * (b.y - a.y) < poles[k].y) continue;
      const int letter = static_cast<int>(k) + 1;
      crossed.push_back({share, a.x < b.x ? letter : -letter});
    }
    std::sort(crossed.begin(), crossed.end());
    for (const auto& [share, letter] : crossed) {
      if (!word.empty() && word.back() == -letter)
        word.pop_back();
      else
        word.push_back(letter);
    }
  }
  return word;
}

TEST(SmoothingOracle, tells_the_sides_of_a_pole_apart) {
  const std::vector<Point> pole{{2, 0}};
  const Path above{{0, 0}, {2, 1}, {4, 0}};
  const Path below{{0, 0}, {2, -1}, {4, 0}};
  const Path round{{0, 0}, {2, 1}, {4, 0}, {2, -1}, {1, 0}, {2, 2}, {4, 0}};
  EXPECT_EQ(word_of(above, pole), word_of({{0, 0}, {1, 3}, {4, 0}}, pole));
  EXPECT_NE(word_of(above, pole), word_of(below, pole));
  EXPECT_NE(word_of(above, pole), word_of(round, pole));
}

/// Worlds anywhere, with several ways through each.
class SmoothingSeeds : public testing::Test {
 protected:
  /// Calls `check` with each shortest path and what smoothing makes of it.
  template <typename Check>
  void each(const plan::PlannerConfig& config, const Check& check) {
    plan::PlannerConfig shortest = config;
    shortest.smoothing.enabled = false;
    for (unsigned seed = 0; seed < 60; ++seed) {
      RandomWorld world(seed);
      plan::Planner planner(shortest);
      ASSERT_EQ(planner.set_map(world.map.voxels()).error, "");
      (void)planner.carve(world.cylinders);
      std::vector<Point> poles;
      for (const auto& block : world.map.blocks())
        poles.push_back({0.5 * (block[0] + block[2]) + 1e-4, 0.5 * (block[1] + block[3])});
      for (const Cylinder& cylinder : world.cylinders) poles.push_back(cylinder.center);
      std::mt19937 random(seed);
      for (int i = 0; i < 8; ++i) {
        const auto pick = [&random](double size) {
          return 0.6 + size * static_cast<double>(random() % 1000) / 1000.0;
        };
        const plan::Plan plan = planner.plan({pick(18.8), pick(12.8)}, {pick(18.8), pick(12.8)});
        if (plan.status != plan::PlanStatus::found ||
            !clear(plan.path, planner.nav_mesh().space(), 0.35))
          continue;
        ++paths_;
        const Clearances room{config.mesh.robot_radius, config.mesh.preferred_clearance};
        const map::Space space = planner.nav_mesh().space();
        check(plan.path, smooth(plan.path, space, room, config.smoothing), space, room, poles);
      }
    }
    EXPECT_GT(paths_, 200);
  }
  int paths_ = 0;
};

TEST_F(SmoothingSeeds,
       keep_ends_clearance_corridor_and_bounds_and_shorten_where_no_room_is_preferred) {
  const plan::PlannerConfig config;
  SmoothingConfig shortening = config.smoothing;
  shortening.turn_price = 0.0;
  int moved = 0;
  each(config, [&](const Path& path, const Path& guide, const map::Space& space,
                   const Clearances& room, const std::vector<Point>& poles) {
    EXPECT_EQ(guide.front(), path.front());
    EXPECT_EQ(guide.back(), path.back());
    for (const Point point : points_along(guide, 0.02))
      ASSERT_GE(space.clearance(point), room.radius - 1e-6);
    EXPECT_EQ(word_of(guide, poles), word_of(path, poles));
    const double length = length_of(path);
    EXPECT_LE(length_of(guide), std::max(config.smoothing.max_stretch * length,
                                         length + config.smoothing.max_detour));
    const auto cost = [&](const Path& of) {
      return guide_cost(of, space, room, config.smoothing) +
             config.smoothing.turn_price * static_cast<double>(of.size());
    };
    EXPECT_LE(cost(guide), cost(path) + 1e-9);
    const Path shorter = smooth(path, space, {room.radius, 0.0}, shortening);
    EXPECT_LE(length_of(shorter), length + 1e-9);
    EXPECT_TRUE(clear(shorter, space, room.radius));
    EXPECT_EQ(word_of(shorter, poles), word_of(path, poles));
    if (guide.size() > 2 && !(guide == path)) ++moved;
  });
  EXPECT_GT(moved, paths_ / 3);
}

}  // namespace
}  // namespace navvi_nav::smooth

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
