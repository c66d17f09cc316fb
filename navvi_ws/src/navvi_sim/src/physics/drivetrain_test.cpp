#include "physics/drivetrain.hpp"

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

TEST(Drivetrain, with_nothing_set_odometry_is_the_truth_and_the_wheel_base_and_seed_do_not_matter) {
  live::Session plain = begin([](auto&) {});
  live::Session other =
      begin([](auto& flaws) { flaws.wheel_base = 1.1, flaws.slip_time = 3.0; }, 99);
  wander(plain);
  wander(other);
  EXPECT_EQ(plain.hashes(), other.hashes());
  const live::Snapshot& now = plain.world().now();
  EXPECT_EQ(now.odometry.position, now.robot.position);
  EXPECT_EQ(now.odometry.yaw, now.robot.yaw);
  EXPECT_EQ(now.odometry.velocity, now.robot.velocity);
}

TEST(Drivetrain, each_imperfection_changes_the_state_and_repeats_from_its_seed) {
  live::Session plain = begin([](auto&) {});
  wander(plain);
  const std::vector<Set> sets{
      [](auto& flaws) { flaws.slip_left = 0.1; },
      [](auto& flaws) { flaws.slip_right = 0.1; },
      [](auto& flaws) { flaws.slip_noise = 0.05; },
      [](auto& flaws) { flaws.command_delay = 0.2; },
      [](auto& flaws) { flaws.odometry_left = 0.01; },
      [](auto& flaws) { flaws.odometry_right = -0.01; },
      [](auto& flaws) { flaws.odometry_noise = 0.005; },
  };
  for (std::size_t i = 0; i < sets.size(); ++i) {
    live::Session one = begin(sets[i]), again = begin(sets[i]), other_seed = begin(sets[i], 2);
    wander(one);
    wander(again);
    wander(other_seed);
    EXPECT_EQ(one.hashes(), again.hashes()) << i;
    EXPECT_NE(one.hashes(), plain.hashes()) << i;
    const bool random = i == 2 || i == 6;
    EXPECT_EQ(one.hashes() != other_seed.hashes(), random) << i;
  }
}

TEST(Drivetrain, a_slip_of_both_wheels_loses_that_share_of_speed_and_odometry_counts_the_wheels) {
  live::Session session = begin([](auto& flaws) { flaws.slip_left = flaws.slip_right = 0.2; });
  drive(session, 10.0, {0.5, 0.0});
  const live::Snapshot& now = session.world().now();
  EXPECT_NEAR(now.robot.forward_speed(), 0.4, 1e-9);
  EXPECT_NEAR(now.odometry.forward_speed(), 0.5, 1e-9);
  EXPECT_NEAR(now.robot.position.x() / now.odometry.position.x(), 0.8, 1e-9);
}

TEST(Drivetrain, a_slip_of_the_left_wheel_pulls_to_the_left_as_the_wheel_base_says) {
  for (const double base : {0.4, 0.8}) {
    live::Session session =
        begin([&](auto& flaws) { flaws.slip_left = 0.1, flaws.wheel_base = base; });
    drive(session, 5.0, {0.5, 0.0});
    EXPECT_NEAR(session.world().now().robot.turn_rate, 0.1 * 0.5 / base, 1e-9);
    EXPECT_NEAR(session.world().now().odometry.yaw, 0.0, 1e-6) << "the wheels turned alike";
  }
}

TEST(Drivetrain, slip_noise_has_the_asked_for_size_and_fades_in_its_time) {
  live::Session session = begin([](auto& flaws) { flaws.slip_noise = 0.1, flaws.slip_time = 0.2; });
  drive(session, 2.0, {0.5, 0.0});
  const int samples = 20000, lag = 20;
  std::vector<double> slip;
  for (int i = 0; i < samples; ++i) {
    drive(session, 0.01, {0.5, 0.0});
    slip.push_back(1.0 - session.world().now().robot.forward_speed() / 0.5);
  }
  double mean = 0.0, square = 0.0, lagged = 0.0;
  for (const double value : slip) mean += value / samples;
  for (const double value : slip) square += (value - mean) * (value - mean) / samples;
  for (int i = lag; i < samples; ++i) lagged += (slip[i] - mean) * (slip[i - lag] - mean) / samples;
  EXPECT_NEAR(mean, 0.0, 0.01);
  EXPECT_NEAR(std::sqrt(square), 0.1 / std::sqrt(2.0), 0.007) << "the mean of two wheels";
  EXPECT_NEAR(lagged / square, std::exp(-1.0), 0.12) << "after slip_time";
}

TEST(Drivetrain, a_command_comes_late_by_its_delay_but_an_emergency_does_not) {
  live::Session session = begin([](auto& flaws) { flaws.command_delay = 0.25; });
  drive(session, 0.25, {0.5, 0.0});
  EXPECT_EQ(session.world().now().robot.forward_speed(), 0.0);
  drive(session, 0.01, {0.5, 0.0});
  EXPECT_GT(session.world().now().robot.forward_speed(), 0.0);
  drive(session, 2.0, {0.5, 0.0});
  drive(session, 0.25, {0.0, 0.0});
  EXPECT_NEAR(session.world().now().robot.forward_speed(), 0.5, 1e-9);

  drive(session, 0.25, {0.5, 0.0});
  for (int i = 0; i < 5; ++i)
    ASSERT_EQ(session.step({}, Braking::emergency), live::World::Status::running);
  EXPECT_EQ(session.world().now().robot.forward_speed(), 0.0);
  drive(session, 0.25, {0.5, 0.0});
  EXPECT_EQ(session.world().now().robot.forward_speed(), 0.0) << "what was under way is forgotten";
}

TEST(Drivetrain, wheels_that_stall_at_a_wall_do_not_drive_odometry_on) {
  const double pi = std::acos(-1.0);
  live::Session session = begin([](auto& flaws) { flaws.slip_left = flaws.slip_right = 0.1; }, 1,
                                {{0.0, 58.5}, 0.5 * pi});
  drive(session, 5.0, {0.5, 0.0});
  const double at_the_wall = session.world().now().odometry.position.y();
  drive(session, 5.0, {0.5, 0.0});
  EXPECT_LT(session.world().now().robot.position.y(), 59.2);
  EXPECT_NEAR(session.world().now().odometry.position.y(), at_the_wall, 0.05);
}

TEST(Drivetrain, unequal_wheels_bend_the_odometry_of_a_straight_way) {
  live::Session session = begin([](auto& flaws) { flaws.odometry_right = 0.01; });
  drive(session, 20.0, {0.5, 0.0});
  const live::Snapshot& now = session.world().now();
  EXPECT_NEAR(now.robot.yaw, 0.0, 1e-9) << "the body does not care";
  EXPECT_NEAR(now.odometry.yaw, 0.01 * now.robot.position.x() / 0.5, 1e-6);
}

TEST(Drivetrain, odometry_noise_grows_with_the_root_of_the_way) {
  const int seeds = 200;
  const double noise = 0.01, way = 4.0;
  double near = 0.0, far = 0.0, turned = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    RobotConfig config;
    config.imperfections.odometry_noise = noise;
    Drivetrain wheels(config, 0.01, {}, static_cast<std::uint64_t>(seed));
    RobotState before, after;
    for (int i = 0; i < 400; ++i) {
      after.position.x() = before.position.x() + way / 400;
      wheels.count(before, after);
      before = after;
      if (i == 99) near += std::pow(wheels.odometry().yaw, 2) / seeds;
    }
    far += std::pow(wheels.odometry().yaw, 2) / seeds;
    turned += wheels.odometry().yaw / seeds;
  }
  const double expected = std::sqrt(2.0 * way) * noise / 0.5;  // rad, of two wheels 0.5 m apart
  EXPECT_NEAR(turned, 0.0, 0.2 * expected);
  EXPECT_NEAR(std::sqrt(far), expected, 0.12 * expected);
  EXPECT_NEAR(std::sqrt(near), 0.5 * expected, 0.12 * expected) << "after a quarter of the way";
}

}  // namespace
}  // namespace navvi_sim::physics
