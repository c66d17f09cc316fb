#include "physics/wheel_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "navvi_sim/live/session.hpp"

namespace navvi_sim::physics {
namespace {

using Set = std::function<void(ImperfectionsConfig&)>;

WorldDescription hall() {
  WorldDescription world;
  world.name = "hall";
  Thing wall;
  wall.name = "wall";
  wall.thing_class = ThingClass::wall;
  wall.pose.translation() = Eigen::Vector3d(0.0, 60.0, 1.0);
  wall.shapes.push_back({Box{{200.0, 1.0, 2.0}}, Eigen::Isometry3d::Identity()});
  world.things.push_back(wall);
  return world;
}

live::Session begin(const Set& set, std::uint64_t seed = 1, const Pose2& start = {}) {
  live::WorldConfig config;
  set(config.robot.imperfections);
  return live::Session(hall(), config, start, seed);
}

void drive(live::Session& session, double seconds, const navvi_types::Velocity& command) {
  for (int i = 0; i < std::lround(seconds / 0.01); ++i)
    ASSERT_EQ(session.step(command), live::World::Status::running);
}

/// A drive with turns, stops and a change of mind.
void wander(live::Session& session) {
  drive(session, 3.0, {0.8, 0.3});
  drive(session, 2.0, {-0.4, -0.9});
  drive(session, 1.0, {0.0, 0.0});
  drive(session, 4.0, {0.9, 0.1});
}

TEST(WheelOdometry, with_nothing_set_is_the_truth_and_the_seed_does_not_matter) {
  live::Session plain = begin([](auto&) {});
  live::Session other = begin([](auto&) {}, 99);
  wander(plain);
  wander(other);
  EXPECT_EQ(plain.hashes(), other.hashes());
  const live::Snapshot& now = plain.world().now();
  EXPECT_EQ(now.odometry.position, now.robot.position);
  EXPECT_EQ(now.odometry.yaw, now.robot.yaw);
  EXPECT_EQ(now.odometry.velocity, now.robot.velocity);
}

TEST(WheelOdometry, with_an_imperfection_changes_the_state_and_repeats_from_its_seed) {
  live::Session plain = begin([](auto&) {});
  wander(plain);
  const std::vector<Set> sets{
      [](auto& flaws) { flaws.odometry_left = 0.01; },
      [](auto& flaws) { flaws.odometry_noise = 0.005; },
  };
  for (std::size_t i = 0; i < sets.size(); ++i) {
    live::Session one = begin(sets[i]), again = begin(sets[i]), other_seed = begin(sets[i], 2);
    wander(one);
    wander(again);
    wander(other_seed);
    EXPECT_EQ(one.hashes(), again.hashes()) << i;
    EXPECT_NE(one.hashes(), plain.hashes()) << i;
    const bool random = i == 1;
    EXPECT_EQ(one.hashes() != other_seed.hashes(), random) << i;
  }
}

TEST(WheelOdometry, does_not_go_on_where_wheels_stall_at_a_wall) {
  const double pi = std::acos(-1.0);
  live::Session session = begin([](auto& flaws) { flaws.odometry_left = 0.01; }, 1,
                                {{0.0, 58.5}, 0.5 * pi});
  drive(session, 5.0, {0.5, 0.0});
  const double at_the_wall = session.world().now().odometry.position.y();
  drive(session, 5.0, {0.5, 0.0});
  EXPECT_LT(session.world().now().robot.position.y(), 59.2);
  EXPECT_NEAR(session.world().now().odometry.position.y(), at_the_wall, 0.05);
}

TEST(WheelOdometry, of_unequal_wheels_bends_a_straight_way) {
  live::Session session = begin([](auto& flaws) { flaws.odometry_left = 0.01; });
  drive(session, 20.0, {0.5, 0.0});
  const live::Snapshot& now = session.world().now();
  EXPECT_NEAR(now.robot.yaw, 0.0, 1e-9) << "the body does not care";
  EXPECT_NEAR(now.odometry.yaw, -0.01 * now.robot.position.x() / 0.5, 1e-6);
}

TEST(WheelOdometry, has_noise_that_grows_with_the_root_of_the_way) {
  const int seeds = 200;
  const double noise = 0.01, way = 4.0;
  double near = 0.0, far = 0.0, turned = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    ImperfectionsConfig flaws;
    flaws.odometry_noise = noise;
    WheelOdometry wheels(flaws, 0.01, {}, static_cast<std::uint64_t>(seed));
    RobotState before, after;
    for (int i = 0; i < 400; ++i) {
      after.position.x() = before.position.x() + way / 400;
      wheels.count(before, after);
      before = after;
      if (i == 99) near += std::pow(wheels.now().yaw, 2) / seeds;
    }
    far += std::pow(wheels.now().yaw, 2) / seeds;
    turned += wheels.now().yaw / seeds;
  }
  const double expected = std::sqrt(2.0 * way) * noise / 0.5;  // rad, of two wheels 0.5 m apart
  EXPECT_NEAR(turned, 0.0, 0.2 * expected);
  EXPECT_NEAR(std::sqrt(far), expected, 0.12 * expected);
  EXPECT_NEAR(std::sqrt(near), 0.5 * expected, 0.12 * expected) << "after a quarter of the way";
}

}  // namespace
}  // namespace navvi_sim::physics
