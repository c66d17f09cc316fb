#include "navvi_sim/node/state_conversion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <navvi_config/reader.hpp>

#include "navvi_sim/setup/sim_node_config.hpp"

namespace navvi_sim::node {
namespace {

constexpr double kPi = 3.14159265358979323846;

WorldDescription world_of_two() {
  WorldDescription world;
  world.name = "two";
  world.floor_height = -0.09;
  world.things.resize(2);
  world.things[0].name = "shelf 1";
  world.things[0].thing_class = ThingClass::shelf;
  world.things[1].name = "forklift 1";
  world.things[1].thing_class = ThingClass::forklift;
  world.things[1].route = Route{{{{0, 0}}, {{1, 0}}}};
  return world;
}

physics::RobotState robot_looking_north() {
  physics::RobotState robot;
  robot.position = {1.0, 2.0};
  robot.yaw = kPi / 2;
  robot.velocity = {0.0, 0.5};
  robot.turn_rate = 0.1;
  return robot;
}

TEST(StateConversion, odometry_is_at_floor_height_with_its_twist_in_base_link) {
  const auto msg = odometry_msg(robot_looking_north(), -0.09, ros::Time(3.0));
  EXPECT_EQ(msg.header.frame_id, "odom");
  EXPECT_EQ(msg.child_frame_id, "base_link");
  EXPECT_EQ(msg.pose.pose.position.z, -0.09);
  EXPECT_NEAR(msg.twist.twist.linear.x, 0.5, 1e-12);
  EXPECT_NEAR(msg.twist.twist.linear.y, 0.0, 1e-12);
  EXPECT_NEAR(2.0 * std::atan2(msg.pose.pose.orientation.z, msg.pose.pose.orientation.w), kPi / 2,
              1e-12);
  const auto transform = base_link_msg(robot_looking_north(), -0.09, ros::Time(3.0));
  EXPECT_EQ(transform.transform.translation.y, msg.pose.pose.position.y);
  EXPECT_EQ(transform.transform.rotation.w, msg.pose.pose.orientation.w);
}

TEST(StateConversion, the_correction_brings_a_drifted_odometry_back_to_the_truth) {
  const physics::RobotState robot = robot_looking_north();
  const auto same = odom_msg(robot, robot, ros::Time(3.0)).transform;
  EXPECT_EQ(same.translation.x, 0.0);
  EXPECT_EQ(same.translation.y, 0.0);
  EXPECT_EQ(same.rotation.w, 1.0);

  physics::RobotState odometry;
  odometry.position = {4.0, -3.0};
  odometry.yaw = -2.5;
  const auto isometry = [](const geometry_msgs::Transform& msg) {
    return Eigen::Translation3d(msg.translation.x, msg.translation.y, msg.translation.z) *
           Eigen::Quaterniond(msg.rotation.w, msg.rotation.x, msg.rotation.y, msg.rotation.z);
  };
  const Eigen::Isometry3d map_to_base =
      isometry(odom_msg(robot, odometry, ros::Time(3.0)).transform) *
      isometry(base_link_msg(odometry, -0.09, ros::Time(3.0)).transform);
  EXPECT_NEAR((map_to_base.translation() - Eigen::Vector3d(1.0, 2.0, -0.09)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((map_to_base.linear().col(0) - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-12);
}

TEST(StateConversion, near_points_are_taken_over_to_base_link) {
  const auto msg = proximity_msg(world_of_two(), robot_looking_north(),
                                 {{1, 0.65, {1.0, 3.0, 0.11}}}, 5.0, ros::Time(3.0));
  ASSERT_EQ(msg.things.size(), 1u);
  EXPECT_EQ(msg.header.frame_id, "base_link");
  EXPECT_EQ(msg.things[0].thing_class, "forklift");
  EXPECT_TRUE(msg.things[0].moving);
  EXPECT_NEAR(msg.things[0].nearest.x, 1.0, 1e-12);
  EXPECT_NEAR(msg.things[0].nearest.y, 0.0, 1e-12);
  EXPECT_NEAR(msg.things[0].nearest.z, 0.20, 1e-12);
}

TEST(StateConversion, nothing_near_is_an_empty_message) {
  const auto msg = proximity_msg(world_of_two(), physics::RobotState{}, {}, 5.0, ros::Time(3.0));
  EXPECT_TRUE(msg.things.empty());
  EXPECT_EQ(msg.detection_radius, 5.0);
  EXPECT_TRUE(obstacles_msg(world_of_two(), live::Snapshot{}, ros::Time(3.0)).obstacles.empty());
}

TEST(StateConversion, obstacles_stand_on_the_floor) {
  live::Snapshot now;
  MoverState mover{1, Eigen::Isometry3d::Identity(), 0.5, {0.3, 0.4}, 0.0, {1.2, 2.0, 0.9}, 2.1};
  mover.pose.translation() = Eigen::Vector3d(4.0, 5.0, 1.0);
  now.movers.push_back(mover);
  const auto msg = obstacles_msg(world_of_two(), now, ros::Time(3.0));
  ASSERT_EQ(msg.obstacles.size(), 1u);
  EXPECT_EQ(msg.obstacles[0].id, 1u);
  EXPECT_EQ(msg.obstacles[0].pose.position.z, -0.09);
  EXPECT_EQ(msg.obstacles[0].velocity.y, 0.4);
  EXPECT_EQ(msg.obstacles[0].radius, 1.2);
  EXPECT_EQ(msg.obstacles[0].height, 2.1);
  EXPECT_EQ(msg.obstacles[0].length, 2.0);
  EXPECT_EQ(msg.obstacles[0].width, 0.9);
}

TEST(StateConversion, contacts_carry_their_counts) {
  const physics::ContactEvent event{2, 0, {1, 2, 0.3}, 0.8, {{ThingClass::shelf, 2}}};
  const auto msg = contact_msg(world_of_two(), robot_looking_north(), event, ros::Time(3.0));
  EXPECT_EQ(msg.seq, 2u);
  EXPECT_EQ(msg.name, "shelf 1");
  ASSERT_EQ(msg.counts.size(), 1u);
  EXPECT_EQ(msg.counts[0].thing_class, "shelf");
  EXPECT_EQ(msg.counts[0].count, 2u);
}

TEST(SimNodeConfig, takes_start_and_goal_as_lists_of_finite_numbers) {
  setup::SimNodeConfig config;
  EXPECT_FALSE(config.start_pose());
  EXPECT_FALSE(config.goal_point());
  config.start = "1,-9, 1.57";
  config.goal = "1,6";
  EXPECT_EQ(config.start_pose()->y, -9.0);
  EXPECT_EQ(config.start_pose()->yaw, 1.57);
  EXPECT_EQ(config.goal_point()->y(), 6.0);
  for (const char* bad : {"1,2", "1,2,3,4", "a,b,c", "1,2,nan", "1,2,3x", "1,,3", "1,2,3,", ","}) {
    config.start = bad;
    EXPECT_THROW((void)config.start_pose(), navvi_config::ConfigError) << bad;
  }
}

TEST(SimNodeConfig, describes_itself_within_its_own_ranges) {
  setup::SimNodeConfig config;
  navvi_config::read(config,
                     YAML::Load("{workers: standing, movers: {yield: false}, "
                                "robot: {radius: 0.3}, gate: {timeout: 0.1}}"),
                     "test");
  EXPECT_FALSE(config.life.movers.yield);
  EXPECT_EQ(config.gate.timeout, 0.1);
  EXPECT_THROW(navvi_config::read(config, YAML::Load("{robot: {radius: .nan}}"), "test"),
               navvi_config::ConfigError);
  EXPECT_THROW(navvi_config::read(config, YAML::Load("{no_such: 1}"), "test"),
               navvi_config::ConfigError);
}

TEST(SimNodeConfig, reads_every_profile_that_ships) {
  for (const char* profile : {"default", "paper"}) {
    setup::SimNodeConfig config;
    const std::string path = std::string(NAVVI_SIM_DIR) + "/config/" + profile + ".yaml";
    EXPECT_NO_THROW(navvi_config::read(config, navvi_config::load_yaml(path), path)) << path;
  }
}

const std::vector<live::AppliedCommand> kThree{{0, {0.0, 0.0}, physics::Braking::emergency},
                                               {5, {0.1, 1.0 / 3.0}, physics::Braking::normal},
                                               {6, {-0.0, 0.2}, physics::Braking::normal}};

bool equal(const std::vector<live::AppliedCommand>& a, const std::vector<live::AppliedCommand>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.step == y.step && x.velocity.linear == y.velocity.linear &&
           x.velocity.angular == y.velocity.angular && x.braking == y.braking;
  });
}

TEST(StateConversion, commands_come_back_whole_however_they_are_cut_and_repeated) {
  for (const std::vector<std::size_t>& begins :
       {std::vector<std::size_t>{0}, {0, 1, 2}, {0, 0}, {1, 0}}) {
    std::vector<live::AppliedCommand> commands;
    for (const std::size_t first : begins) {
      const bool ok = append(applied_commands_msg(kThree, first, ros::Time(1.0)), commands);
      EXPECT_EQ(ok, first == 0 || !commands.empty()) << first;
    }
    EXPECT_TRUE(equal(commands, kThree));
  }
}

TEST(StateConversion, commands_out_of_order_or_not_finite_are_refused_whole) {
  const auto good = applied_commands_msg(kThree, 0, ros::Time(1.0));
  for (const auto& spoil : std::vector<std::function<void(navvi_msgs::AppliedCommand&)>>{
           [](auto& last) { last.step = 5; }, [](auto& last) { last.linear = NAN; },
           [](auto& last) { last.angular = INFINITY; }}) {
    auto bad = good;
    spoil(bad.commands.back());
    std::vector<live::AppliedCommand> commands;
    EXPECT_FALSE(append(bad, commands));
    EXPECT_TRUE(commands.empty());
  }
}

TEST(StateConversion, a_state_hash_comes_back_and_what_is_no_hash_does_not) {
  const live::StateHash state{4100, 0x00f4c0bca0694f33};
  auto msg = state_hash_msg(state, ros::Time(41.0));
  EXPECT_EQ(from_msg(msg), state);
  for (const char* bad : {"", "f4c0bca0694f33", "00f4c0bca0694f3x", "-0f4c0bca0694f33"}) {
    msg.hash = bad;
    EXPECT_FALSE(from_msg(msg)) << bad;
  }
}

}  // namespace
}  // namespace navvi_sim::node

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
