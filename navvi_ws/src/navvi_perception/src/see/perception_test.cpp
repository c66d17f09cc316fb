#include "navvi_perception/see/perception.hpp"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <sstream>
#include <utility>

namespace navvi_perception::see {
namespace {

using navvi_types::Pose2;
using navvi_types::ThingClass;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRange = 12.0;  // m

/// A hall of 12 m x 8 m about the origin, with boxes and discs, seen by a lidar with a ray a
/// degree.
class Hall {
 public:
  struct Disc {
    Eigen::Vector2d at;
    double radius;
  };
  Eigen::AlignedBox2d box{Eigen::Vector2d(2.0, 1.0), Eigen::Vector2d(2.8, 1.6)};
  std::vector<Disc> discs;
  Pose2 robot;
  bool own_body = false;  ///< half of the rays end at the robot's own mast

  [[nodiscard]] sight::Sight look(double time) {
    sight::Sight sight;
    sight.stamp = std::llround(time * 1e9);
    sight.robot = robot;
    sight.origin = {robot.position.x(), robot.position.y(), 0.12};
    for (int i = 0; i < 360; ++i) {
      const double angle = robot.yaw + i * kPi / 180.0;
      const Eigen::Vector2d way(std::cos(angle), std::sin(angle));
      double range = std::min(kRange, wall(way));
      range = std::min(range, to_box(way));
      for (const Disc& disc : discs) range = std::min(range, to_disc(disc, way));
      if (own_body && i > 90 && i < 270) range = 0.2;
      const double measured = range + noise_(random_);
      const Eigen::Vector2d end = robot.position + measured * way;
      (range < kRange ? sight.hits : sight.clear).emplace_back(end.x(), end.y(), 0.12);
    }
    return sight;
  }
  [[nodiscard]] static sight::Prior prior() {
    sight::Prior prior{0.05, {-6.5, -4.5}, 260, 180, {}};
    for (int y = 0; y < prior.height; ++y)
      for (int x = 0; x < prior.width; ++x)
        prior.cells.push_back(x < 10 || y < 10 || x >= 250 || y >= 170 ? 100 : 0);
    return prior;
  }

 private:
  [[nodiscard]] double wall(const Eigen::Vector2d& way) const {
    const double x = way.x() > 0 ? 6.0 - robot.position.x() : -6.0 - robot.position.x();
    const double y = way.y() > 0 ? 4.0 - robot.position.y() : -4.0 - robot.position.y();
    return std::min(std::abs(way.x()) > 1e-9 ? x / way.x() : 1e9,
                    std::abs(way.y()) > 1e-9 ? y / way.y() : 1e9);
  }
  [[nodiscard]] double to_box(const Eigen::Vector2d& way) const {
    double enter = 0.0, leave = 1e9;
    for (int axis = 0; axis < 2; ++axis) {
      const double a = (box.min()[axis] - robot.position[axis]) / way[axis];
      const double b = (box.max()[axis] - robot.position[axis]) / way[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave ? enter : 1e9;
  }
  [[nodiscard]] double to_disc(const Disc& disc, const Eigen::Vector2d& way) const {
    const Eigen::Vector2d to = disc.at - robot.position;
    const double along = to.dot(way);
    const double across2 = to.squaredNorm() - along * along;
    const double half2 = disc.radius * disc.radius - across2;
    return along > 0.0 && half2 > 0.0 ? along - std::sqrt(half2) : 1e9;
  }

  std::mt19937 random_{7};
  std::normal_distribution<double> noise_{0.0, 0.01};
};

struct Seen {
  std::set<std::uint32_t> ids;
  int told = 0, moving = 0;
};

class PerceptionTest : public testing::Test {
 protected:
  /// Looks 10 times a second. \param each  what happens before a look, with the time
  template <typename Each>
  Seen live(double until, const Each& each) {
    Seen seen;
    for (; time_ < until - 1e-9; time_ += 0.1) {
      each(time_);
      perception_->take(hall_.look(time_));
      for (const auto& thing : obstacles().things) {
        seen.ids.insert(thing.id);
        ++seen.told;
        if (thing.velocity.norm() > 0.0) ++seen.moving;
      }
    }
    return seen;
  }
  [[nodiscard]] navvi_types::Obstacles obstacles() const {
    return perception_->obstacles(std::llround(time_ * 1e9));
  }
  [[nodiscard]] navvi_types::Proximity proximity() {
    return perception_->proximity(hall_.robot, std::llround(time_ * 1e9));
  }
  /// Whether something is reported near a place, m, in map.
  [[nodiscard]] bool is_near(const Eigen::Vector2d& place) {
    const navvi_types::Proximity near = proximity();
    return std::any_of(near.things.begin(), near.things.end(), [&](const auto& thing) {
      return (hall_.robot.to_parent(thing.nearest) - place).norm() < 0.4;
    });
  }
  void with_prior() { perception_.emplace(PerceptionConfig(), Hall::prior()); }

  Hall hall_;
  double time_ = 1.0;
  std::optional<Perception> perception_{std::in_place, PerceptionConfig()};
};

TEST_F(PerceptionTest, sees_nothing_in_nothing) {
  sight::Sight sight;
  perception_->take(sight);
  EXPECT_TRUE(obstacles().things.empty());
  EXPECT_TRUE(proximity().things.empty());
}

TEST_F(PerceptionTest, takes_no_wall_for_a_mover_while_the_robot_drives) {
  for (const bool prior : {false, true}) {
    if (prior) with_prior();
    time_ = 1.0;
    const Seen seen = live(13.0, [&](double time) {
      hall_.robot.position = {-4.0 + 0.6 * (time - 1.0), -1.0};
      hall_.robot.yaw = 0.3 * std::sin(time);
    });
    EXPECT_EQ(seen.moving, 0) << (prior ? "with" : "without") << " a prior map";
  }
}

TEST_F(PerceptionTest, follows_a_crossing_worker_under_one_number_with_its_velocity) {
  for (const bool prior : {false, true}) {
    perception_.emplace(PerceptionConfig());
    if (prior) with_prior();
    time_ = 1.0;
    hall_.discs = {};
    (void)live(2.0, [](double) {});
    hall_.discs = {{{1.5, -3.0}, 0.24}};
    std::set<std::uint32_t> ids;
    std::optional<double> told;
    const double from = time_;
    (void)live(from + 4.0, [&](double time) {
      hall_.discs[0].at.y() = -3.0 + 1.2 * (time - from);
      for (const auto& thing : obstacles().things) {
        if ((thing.pose.position - hall_.discs[0].at).norm() > 0.5) continue;
        ids.insert(thing.id);
        if (thing.velocity.norm() == 0.0) continue;
        EXPECT_EQ(thing.thing_class, ThingClass::other);
        if (thing.velocity.norm() == 0.0) continue;
        if (!told) told = time - from;
        if (time - from < 1.5) continue;
        EXPECT_NEAR(thing.velocity.x(), 0.0, 0.25) << time;
        EXPECT_NEAR(thing.velocity.y(), 1.2, 0.25) << time;
      }
    });
    EXPECT_EQ(ids.size(), 1U);
    ASSERT_TRUE(told);
    EXPECT_LE(*told, 0.7);
  }
}

TEST_F(PerceptionTest, H4_follows_a_worker_while_a_mapper_changes_the_prior_map_each_second) {
  with_prior();
  (void)live(7.0, [](double) {});  // the box is known
  hall_.discs = {{{1.5, -3.0}, 0.24}};
  (void)live(7.5, [](double) {});
  const double from = time_;
  sight::Prior prior = Hall::prior();
  const Seen seen = live(from + 4.0, [&](double time) {
    hall_.discs[0].at.y() = -3.0 + 1.2 * (time - from);
    const auto tenths = std::lround(10.0 * time);
    if (tenths % 10 != 0) return;
    prior.cells[static_cast<std::size_t>(170 * prior.width + tenths % prior.width)] = -1;
    perception_->know(prior);
  });
  EXPECT_EQ(seen.ids.size(), 1U);
  EXPECT_EQ(seen.told, 40);
}

TEST_F(PerceptionTest, H2_believes_a_scan_without_returns_only_where_the_map_has_no_wall_in_range) {
  sight::Sight sight = hall_.look(1.0);
  EXPECT_TRUE(perception_->believes(sight));
  sight.clear.insert(sight.clear.end(), sight.hits.begin(), sight.hits.end());
  for (Eigen::Vector3d& end : sight.clear) end *= 1.5;
  const std::vector<Eigen::Vector3d> hits = std::exchange(sight.hits, {});
  EXPECT_TRUE(perception_->believes(sight)) << "without a map";
  with_prior();
  EXPECT_FALSE(perception_->believes(sight));
  sight.hits = {hits.front()};
  EXPECT_TRUE(perception_->believes(sight)) << "something is seen, the rest may be glass";
}

TEST_F(PerceptionTest, the_tips_of_a_fork_are_one_thing_with_one_velocity) {
  with_prior();
  (void)live(7.0, [](double) {});  // the box is known
  const double from = time_;
  std::set<std::uint32_t> ids;
  const Seen seen = live(from + 4.0, [&](double time) {
    const double x = -5.0 + 0.8 * (time - from);
    hall_.discs = {{{x, -0.33}, 0.1}, {{x, 0.33}, 0.1}};
    for (const auto& thing : obstacles().things)
      if (time - from > 1.5) {
        ids.insert(thing.id);
        if (thing.velocity.norm() == 0.0) continue;
        EXPECT_NEAR(thing.velocity.x(), 0.8, 0.25) << time - from;
        EXPECT_NEAR(thing.velocity.y(), 0.0, 0.25) << time - from;
      }
  });
  EXPECT_EQ(ids.size(), 1U);
  EXPECT_GT(seen.moving, 25);
}

TEST_F(PerceptionTest, a_thing_put_down_is_an_obstacle_first_and_then_part_of_the_map) {
  with_prior();
  (void)live(2.0, [](double) {});
  hall_.discs = {{{-2.0, 2.0}, 0.3}};
  const Seen first = live(4.0, [](double) {});
  EXPECT_GE(first.told, 10);
  EXPECT_EQ(first.moving, 0);
  (void)live(9.0, [](double) {});
  EXPECT_TRUE(obstacles().things.empty());
  EXPECT_TRUE(is_near({-2.0, 2.0}));
}

TEST_F(PerceptionTest, a_pole_that_a_single_ray_meets_is_near_until_it_is_taken_away) {
  with_prior();
  (void)live(3.0, [](double) {});
  hall_.discs = {{{1.2, 0.0}, 0.02}};
  (void)live(6.0, [](double) {});
  EXPECT_TRUE(is_near({1.2, 0.0}));
  hall_.discs.clear();
  (void)live(12.0, [](double) {});
  EXPECT_FALSE(is_near({1.2, 0.0}));
}

TEST_F(PerceptionTest, a_ray_that_ends_short_now_and_then_meets_nothing) {
  with_prior();
  (void)live(20.0, [&](double time) {
    EXPECT_FALSE(is_near({1.2, 0.0})) << time;
    hall_.discs.clear();
    // In one of four sights that go into the map, also in the first.
    if ((std::lround(10.0 * time) - 10) % 16 < 4) hall_.discs = {{{1.2, 0.0}, 0.02}};
  });
}

TEST_F(PerceptionTest, forgets_a_mover_that_left_and_leaves_no_trace_of_it) {
  hall_.discs = {{{1.5, -3.0}, 0.24}};
  (void)live(12.0, [&](double time) {
    if (time > 4.0) hall_.discs[0].at.y() = -3.0 + 1.0 * (time - 4.0);
    if (time > 8.0) hall_.discs.clear();
    if (time > 8.0) hall_.discs.push_back({{50.0, 0.0}, 0.2});
  });
  EXPECT_TRUE(obstacles().things.empty());
  for (const auto& thing : proximity().things)
    EXPECT_GT((thing.nearest - Eigen::Vector2d(1.5, -1.0)).norm(), 0.8) << thing.nearest;
}

TEST_F(PerceptionTest, tells_the_nearest_surface_of_each_thing_to_a_voxel) {
  (void)live(5.0, [](double) {});
  const navvi_types::Proximity near = proximity();
  ASSERT_GE(near.things.size(), 2U);
  EXPECT_EQ(near.detection_radius, 5.0);
  const auto& box = near.things[0];
  EXPECT_EQ(box.thing_class, ThingClass::other);
  EXPECT_NEAR(box.gap, std::hypot(2.0, 1.0) - 0.35, 0.08);
  EXPECT_NEAR((box.nearest - Eigen::Vector2d(2.0, 1.0)).norm(), 0.0, 0.12);
  EXPECT_EQ(near.things[1].thing_class, ThingClass::wall);
  EXPECT_NEAR(near.things[1].gap, 4.0 - 0.35, 0.08);
  for (const auto& thing : near.things) EXPECT_FALSE(thing.moving);
}

TEST_F(PerceptionTest, a_standing_thing_keeps_its_number_while_the_robot_drives_by) {
  std::set<std::uint32_t> boxes;
  (void)live(12.0, [&](double time) {
    hall_.robot.position.x() = -1.0 + 0.4 * (time - 1.0);
    if (time < 3.0) return;
    for (const auto& thing : proximity().things)
      if ((hall_.robot.to_parent(thing.nearest) - Eigen::Vector2d(2.4, 1.3)).norm() < 0.7)
        boxes.insert(thing.id);
  });
  EXPECT_EQ(boxes.size(), 1U);
}

TEST_F(PerceptionTest, a_low_thing_that_only_a_camera_sees_stands_though_the_prior_map_is_clear) {
  with_prior();
  // A pedestal of 1 m, 6 cm high; the camera sees its near edge, and then more and more of it.
  for (int i = 0; i < 20; ++i) {
    sight::Sight sight;
    sight.sensor = 1;
    sight.in_plane = false;
    time_ += 0.2;
    sight.stamp = std::llround(time_ * 1e9);
    sight.origin = {0.0, 0.0, 0.45};
    for (double y = -0.5; i < 8 && y < 0.5; y += 0.01)  // far away they graze its top
      sight.clear.emplace_back(1.72, y, 0.04);
    for (double x = 1.5; x < (i < 8 ? 1.52 : 1.5 + 0.05 * (i - 7)); x += 0.02)
      for (double y = -0.5; y < 0.5; y += 0.02) sight.hits.emplace_back(x, y, 0.06);
    perception_->take(sight);
    EXPECT_TRUE(obstacles().things.empty()) << time_;
  }
  ASSERT_FALSE(proximity().things.empty());
  EXPECT_NEAR(proximity().things[0].gap, 1.5 - 0.35, 0.06);
  EXPECT_FALSE(proximity().things[0].moving);
}

TEST_F(PerceptionTest, H2_what_a_sensor_tracked_that_fell_silent_is_told_no_more) {
  with_prior();
  hall_.discs = {{{1.5, -3.0}, 0.24}};
  (void)live(4.0, [&](double time) { hall_.discs[0].at.y() = -3.0 + time; });
  ASSERT_FALSE(obstacles().things.empty());
  for (const double end = time_ + 2.0; time_ < end; time_ += 0.1) {
    sight::Sight wall;  // seen by another
    wall.sensor = 1;
    wall.stamp = std::llround(time_ * 1e9);
    for (double y = -1.0; y < 1.0; y += 0.05) wall.hits.emplace_back(6.0, y, 0.3);
    perception_->take(wall);
  }
  EXPECT_TRUE(obstacles().things.empty());
  for (const auto& thing : proximity().things) EXPECT_FALSE(thing.moving);
}

TEST_F(PerceptionTest, the_robot_does_not_see_itself) {
  hall_.own_body = true;
  (void)live(5.0, [&](double time) { hall_.robot.yaw = 0.2 * time; });
  for (const auto& thing : proximity().things) EXPECT_GT(thing.gap, 0.5);
  EXPECT_TRUE(obstacles().things.empty());
}

TEST_F(PerceptionTest, tells_a_map_that_octomap_reads_and_only_when_it_changed) {
  with_prior();
  const auto first = perception_->map(0);
  ASSERT_TRUE(first);
  std::istringstream in(std::string(first->begin(), first->end()));
  octomap::OcTree tree(0.05);
  tree.readBinaryData(in);
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(0.0, 0.0, -0.02)));  // the floor
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(6.02, 0.0, 0.12)));  // a wall
  EXPECT_EQ(tree.search(0.0, 0.0, 0.12), nullptr);                 // above the floor
  EXPECT_FALSE(perception_->map(2'000'000'000));
  (void)live(7.0, [](double) {});  // the box is news, and stays
  EXPECT_TRUE(perception_->map(7'000'000'000));
}

}  // namespace
}  // namespace navvi_perception::see
