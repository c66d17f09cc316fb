#include "navvi_sim/live/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace navvi_sim::live {
namespace {

Thing box_thing(const std::string& name, ThingClass thing_class, const Eigen::Vector3d& centre,
                const Eigen::Vector3d& size) {
  Thing thing;
  thing.name = name;
  thing.thing_class = thing_class;
  thing.pose.translation() = centre;
  thing.shapes.push_back({Box{size}, Eigen::Isometry3d::Identity()});
  return thing;
}

WorldDescription floor_only() {
  WorldDescription world;
  world.name = "floor";
  world.things.push_back(box_thing("floor", ThingClass::floor, {0, 0, -0.05}, {40, 40, 0.1}));
  return world;
}

Thing mover_thing(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double speed) {
  Thing thing =
      box_thing("mover", ThingClass::pallet_robot, {from.x(), from.y(), 0.25}, {0.8, 0.6, 0.5});
  thing.route = Route{{{from, 0.5}, {to, 0.5}}, speed};
  return thing;
}

/// Steps for `seconds`; returns every contact that began.
std::vector<navvi_types::Contact> drive(World& world, double seconds,
                                        const navvi_types::Velocity& command,
                                        physics::Braking braking = physics::Braking::normal) {
  std::vector<navvi_types::Contact> contacts;
  const int steps = static_cast<int>(std::lround(seconds / 0.01));
  for (int i = 0; i < steps; ++i) {
    EXPECT_EQ(world.step(command, braking), World::Status::running);
    contacts.insert(contacts.end(), world.now().contacts.begin(), world.now().contacts.end());
  }
  return contacts;
}

World make(const WorldDescription& description, const Pose2& start = {},
           const WorldConfig& config = {}) {
  return World(description, config, start, 1);
}

TEST(World, stands_still_without_a_command) {
  World world = make(floor_only(), {{1.0, 2.0}, 0.5});
  drive(world, 1.0, {});
  EXPECT_NEAR(world.now().robot.position.x(), 1.0, 1e-9);
  EXPECT_NEAR(world.now().robot.position.y(), 2.0, 1e-9);
  EXPECT_NEAR(world.now().robot.yaw, 0.5, 1e-9);
  EXPECT_NEAR(world.now().time, 1.0, 1e-9);
}

TEST(World, drives_straight_and_keeps_to_its_limits) {
  World world = make(floor_only());
  double before = 0.0;
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(world.step({1.5, 0.0}), World::Status::running);
    const double speed = world.now().robot.forward_speed();
    EXPECT_LE(speed - before, 0.01 * 1.0 + 1e-9) << "acceleration beyond 1 m/s^2";
    before = speed;
  }
  EXPECT_NEAR(before, 0.9, 1e-6);
  EXPECT_NEAR(world.now().robot.position.y(), 0.0, 1e-6);
  // 0.9 s to reach the speed, 4.1 s at it.
  EXPECT_NEAR(world.now().robot.position.x(), 0.5 * 0.81 + 4.1 * 0.9, 0.02);
}

TEST(World, an_emergency_stops_the_wheels_within_50_ms) {
  World world = make(floor_only());
  drive(world, 2.0, {0.9, 0.0});
  drive(world, 0.05, {}, physics::Braking::emergency);
  EXPECT_EQ(world.now().robot.velocity.norm(), 0.0);
}

TEST(World, turns_on_the_spot_and_does_not_slip_sideways) {
  World world = make(floor_only());
  drive(world, 3.0, {0.9, 1.0});
  EXPECT_LT(std::abs(world.now().robot.sideways_speed()), 0.01);
  World spot = make(floor_only());
  drive(spot, 2.0, {0.0, 1.0});
  EXPECT_LT(spot.now().robot.position.norm(), 1e-6);
  EXPECT_NEAR(spot.now().robot.yaw, 2.0 - 0.5 * 0.25, 0.02);
}

TEST(World, a_wall_stops_it_at_the_surface) {
  auto sheet = std::make_shared<Mesh>();
  sheet->vertices = {{0, -5, -1}, {0, 5, -1}, {0, 5, 1}, {0, -5, 1}};
  sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Geometry& geometry : {Geometry(Box{{0.1, 10, 2}}), Geometry(sheet)}) {
    WorldDescription description = floor_only();
    const double depth = std::holds_alternative<Box>(geometry) ? 0.1 : 0.0;
    description.things.push_back(box_thing("wall", ThingClass::wall, {2 + depth / 2, 0, 1}, {}));
    description.things.back().shapes[0].geometry = geometry;
    World world = make(description);
    double farthest = 0.0;
    std::size_t contacts = 0;
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(world.step({0.9, 0.0}), World::Status::running);
      farthest = std::max(farthest, world.now().robot.position.x());
      contacts += world.now().contacts.size();
    }
    EXPECT_LT(farthest, 2.0 - 0.35 + 0.005);
    EXPECT_GT(world.now().robot.position.x(), 2.0 - 0.35 - 0.005);
    EXPECT_LT(world.now().robot.velocity.norm(), 0.03);
    EXPECT_EQ(contacts, 1u);
  }
}

TEST(World, slides_along_a_wall_but_never_through_it) {
  WorldDescription description = floor_only();
  description.things.push_back(box_thing("wall", ThingClass::wall, {0, 1.05, 1}, {30, 0.1, 2}));
  World world = make(description, {{0, 0}, kPi / 6});
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(world.step({0.9, 0.0}), World::Status::running);
    ASSERT_LT(world.now().robot.position.y(), 1.0 - 0.35 + 0.005);
  }
}

/// Stands with its near side at x = 0 m, where the robot's hull touches it.
Thing obstacle_at_origin(const Geometry& geometry, double depth, double height) {
  Thing thing;
  thing.name = "obstacle";
  thing.thing_class = ThingClass::other;
  thing.pose.translation() = Eigen::Vector3d(0.5 * depth, 0.0, 0.5 * height);
  thing.shapes.push_back({geometry, Eigen::Isometry3d::Identity()});
  return thing;
}

TEST(World, a_robot_at_a_wall_turns_as_without_contact) {
  auto sheet = std::make_shared<Mesh>();
  sheet->vertices = {{0, -5, -1}, {0, 5, -1}, {0, 5, 1}, {0, -5, 1}};
  sheet->triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Thing> obstacles{
      obstacle_at_origin(Box{{0.1, 10.0, 2.0}}, 0.1, 2.0),
      obstacle_at_origin(std::shared_ptr<const Mesh>(sheet), 0.0, 2.0),
      obstacle_at_origin(Box{{0.5, 10.0, 0.1}}, 0.5, 0.1),
      obstacle_at_origin(Cylinder{0.06, 1.5}, 0.12, 1.5)};
  // Drives against the obstacle, stops, and turns: the angle, and how far the middle of the robot
  // then comes.
  const auto turned = [](const WorldDescription& description, double heading,
                         const navvi_types::Velocity& command) {
    const Eigen::Vector2d back = -0.15 * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    World world = make(description, {Eigen::Vector2d(-0.35, 0.0) + back, heading});
    const bool touched = !drive(world, 1.0, {0.5, 0.0}).empty();
    drive(world, 0.5, {});
    EXPECT_EQ(touched, description.things.size() > 1) << heading;
    const Eigen::Vector2d before = world.now().robot.position;
    double angle = 0.0;
    for (int i = 0; i < 200; ++i) {
      const double yaw = world.now().robot.yaw;
      EXPECT_EQ(world.step(command), World::Status::running);
      angle += navvi_types::wrap(world.now().robot.yaw - yaw);
    }
    return std::pair{angle, (world.now().robot.position - before).norm()};
  };
  for (const double side : {1.0, -1.0})
    for (const double forward : {0.0, 0.5}) {
      const navvi_types::Velocity command{forward, 1.2 * side};
      const double free = turned(floor_only(), 0.0, command).first;
      for (const Thing& obstacle : obstacles) {
        WorldDescription description = floor_only();
        description.things.push_back(obstacle);
        for (int degrees = -80; degrees <= 80; degrees += 2) {
          const auto [angle, moved] = turned(description, navvi_types::radians(degrees), command);
          EXPECT_NEAR(angle, free, 0.1 * std::abs(free)) << degrees << " degrees, " << forward;
          if (forward == 0.0) {
            EXPECT_LT(moved, 0.005) << degrees << " degrees";
          }
        }
      }
    }
}

TEST(World, N8_low_pedestals_block_and_lower_plates_do_not) {
  const auto drives_at = [](const Thing& thing) {
    WorldDescription description = floor_only();
    description.things.push_back(thing);
    World world = make(description);
    const bool touched = !drive(world, 6.0, {0.9, 0.0}).empty();
    EXPECT_EQ(touched, world.now().robot.position.x() < 4.0) << thing.name;
    return world.now().robot.position.x();
  };
  for (const double height : {0.06, 0.08, 0.10})
    EXPECT_NEAR(drives_at(box_thing("pedestal", ThingClass::pedestal, {2.5, 0, 0.5 * height},
                                    {1, 1, height})),
                1.65, 0.01)
        << "height " << height;
  EXPECT_GT(drives_at(box_thing("plate", ThingClass::other, {2.5, 0, 0.01}, {1, 1, 0.02})), 4.0);
  EXPECT_GT(drives_at(box_thing("beam", ThingClass::wall, {2, 0, 1.0}, {0.2, 10, 0.2})), 4.0);
}

TEST(World, a_contact_counts_once_while_pushing_and_again_after_parting) {
  WorldDescription description = floor_only();
  description.things.push_back(box_thing("shelf", ThingClass::shelf, {2.5, 0, 1}, {1, 3, 2}));
  World world = make(description);
  const auto first = drive(world, 6.0, {0.9, 0.0});
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].seq, 1u);
  EXPECT_EQ(first[0].id, 1u);
  EXPECT_NEAR(first[0].point.x(), 2.0, 0.01);
  EXPECT_NEAR(first[0].speed, 0.9, 0.05);
  EXPECT_EQ(first[0].counts.at(ThingClass::shelf), 1u);
  EXPECT_TRUE(drive(world, 1.0, {-0.5, 0.0}).empty());
  const auto second = drive(world, 3.0, {0.5, 0.0});
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].seq, 2u);
  EXPECT_EQ(second[0].counts.at(ThingClass::shelf), 2u);
}

TEST(World, a_yielding_mover_touches_no_robot_that_stands_anywhere_on_its_way) {
  Thing mover = box_thing("mover", ThingClass::forklift, {-4, -3, 1.0}, {2.4, 1.0, 2.0});
  mover.route = Route{{{{-4, -3}}, {{4, -3}, 1.0}, {{4, 3}}, {{-4, 3}}}, 1.5};
  for (int i = 0; i < 40; ++i) {
    const double angle = 2.0 * kPi * i / 40.0;
    WorldDescription description = floor_only();
    description.things.push_back(mover);
    const Pose2 start{{4.2 * std::cos(angle), 3.2 * std::sin(angle)}, 0.0};
    if (Eigen::Vector2d(start.position.x() + 4, start.position.y() + 3).norm() < 2.5) continue;
    World world = make(description, start);
    EXPECT_TRUE(drive(world, 60.0, {}).empty())
        << "robot at " << start.position.x() << ", " << start.position.y();
  }
}

TEST(World, S3_a_mover_that_does_not_yield_pushes_the_robot_and_is_counted) {
  WorldDescription description = floor_only();
  description.things.push_back(mover_thing({-4, 0}, {4, 0}, 1.0));
  WorldConfig config;
  config.movers.yield = false;
  World world = make(description, {{0, 0}, kPi / 2}, config);
  const auto contacts = drive(world, 7.0, {});
  ASSERT_FALSE(contacts.empty());
  EXPECT_EQ(contacts[0].counts.at(ThingClass::pallet_robot), 1u);
  EXPECT_GT(world.now().robot.position.x(), 0.5);
  EXPECT_LT(world.now().robot.velocity.norm(), 2.0);
}

TEST(World, S3_a_pushing_mover_does_not_press_the_robot_through_a_wall) {
  WorldDescription description = floor_only();
  description.things.push_back(box_thing("wall", ThingClass::wall, {2.05, 0, 1}, {0.1, 10, 2}));
  description.things.push_back(mover_thing({-4, 0}, {1.45, 0}, 1.0));
  WorldConfig config;
  config.movers.yield = false;
  World world = make(description, {{1, 0}, kPi / 2}, config);
  drive(world, 20.0, {});
  EXPECT_LT(world.now().robot.position.x(), 2.0 - 0.35 + 0.05);
}

TEST(World, can_wait_for_the_robot_and_then_lives_as_if_it_had_not_waited) {
  WorldDescription description = floor_only();
  description.things.push_back(mover_thing({-1, -4}, {-1, 4}, 1.0));
  WorldConfig config;
  config.wait_for_robot = true;
  const auto life_after = [&](int waited) {
    World world(description, config, {{3, 0}, 0.1}, 7);
    const Eigen::Vector2d start = world.now().movers.at(0).thing.pose.position;
    for (int i = 0; i < waited; ++i) EXPECT_EQ(world.step({}), World::Status::running);
    EXPECT_EQ(world.now().movers.at(0).thing.pose.position, start);
    EXPECT_NEAR(world.now().time, 0.01 * waited, 1e-9) << "the clock runs";
    std::vector<Eigen::Vector2d> places;
    for (int i = 0; i < 3000; ++i) {
      const bool rests = i % 500 > 400;
      EXPECT_EQ(world.step({rests ? 0.0 : 0.4, rests ? 0.0 : 0.3}), World::Status::running);
      places.push_back(world.now().movers[0].thing.pose.position);
      places.push_back(world.now().robot.position);
    }
    EXPECT_GT((places[2000] - start).norm(), 1.0) << "it moves at last, also while the robot rests";
    return places;
  };
  const auto at_once = life_after(0);
  EXPECT_EQ(at_once, life_after(1));
  EXPECT_EQ(at_once, life_after(1234));
}

TEST(World, is_the_same_to_the_robot_whatever_is_far_away) {
  WorldDescription near = floor_only();
  near.things.push_back(box_thing("wall", ThingClass::wall, {4.0, 0, 1}, {0.1, 6, 2}));
  near.things.push_back(mover_thing({-4, 1}, {3, 1}, 1.0));
  WorldDescription crowded = near;
  for (int i = 0; i < 200; ++i)
    crowded.things.push_back(box_thing("shelf " + std::to_string(i), ThingClass::shelf,
                                       {i % 20 - 10.0, 90.0 + i / 20 * 2.0, 0.5}, {0.5, 0.7, 1.0}));
  crowded.things.push_back(mover_thing({-9, -90}, {9, -90}, 1.0));
  crowded.things.back().name = "far mover";
  World one = make(near), other = make(crowded);
  std::size_t contacts = 0;
  for (int i = 0; i < 3000; ++i) {
    const navvi_types::Velocity command{0.9, 0.1 * std::sin(0.004 * i)};
    ASSERT_EQ(one.step(command), World::Status::running);
    ASSERT_EQ(other.step(command), World::Status::running);
    ASSERT_EQ(one.now().robot.position, other.now().robot.position) << i;
    contacts += one.now().contacts.size();
  }
  EXPECT_GT(contacts, 0u);
}

TEST(World, gives_near_points_in_base_link_and_movers_and_contacts_on_the_floor) {
  WorldDescription description = floor_only();
  description.floor_height = -0.09;
  description.things[0].pose.translation().z() += description.floor_height;
  description.things.push_back(box_thing("shelf", ThingClass::shelf, {1.0, 4.0, 1.0}, {1, 1, 2}));
  description.things.push_back(mover_thing({-6, -6}, {6, -6}, 1.0));
  World world = make(description, {{1.0, 2.0}, kPi / 2});
  const navvi_types::Proximity near = world.proximity(2.0);
  ASSERT_EQ(near.things.size(), 1u);
  EXPECT_EQ(near.detection_radius, 2.0);
  EXPECT_EQ(near.things[0].name, "shelf");
  EXPECT_EQ(near.things[0].thing_class, ThingClass::shelf);
  EXPECT_FALSE(near.things[0].moving);
  EXPECT_NEAR(near.things[0].gap, 1.5 - 0.35, 1e-9);
  EXPECT_NEAR((near.things[0].nearest - Eigen::Vector2d(1.5, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_GT(near.things[0].height, 0.0) << "above the floor";
  EXPECT_TRUE(world.proximity(20.0).things.back().moving);

  const navvi_types::Obstacles movers = world.obstacles();
  ASSERT_EQ(movers.things.size(), 1u);
  EXPECT_EQ(movers.things[0].id, 2u);
  EXPECT_EQ(movers.things[0].thing_class, ThingClass::pallet_robot);
  EXPECT_EQ(movers.things[0].floor, -0.09);
  EXPECT_NEAR(movers.things[0].length, 0.8, 1e-9);
  EXPECT_NEAR(movers.things[0].radius, 0.5, 1e-6);
  EXPECT_NEAR(movers.things[0].height, 0.5 + 0.09, 1e-6);
  EXPECT_TRUE(movers.things[0].sound());
  EXPECT_EQ(world.odometry().floor, -0.09);
  EXPECT_NEAR(world.odometry().pose.yaw, kPi / 2, 1e-12);

  const auto contacts = drive(world, 3.0, {0.9, 0.0});
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].name, "shelf");
  EXPECT_EQ(contacts[0].floor, -0.09);
  EXPECT_NEAR(contacts[0].robot.yaw, kPi / 2, 1e-3);
  EXPECT_GT(contacts[0].stamp, 0);
}

TEST(World, refuses_a_command_that_is_no_number_and_lives_on) {
  World world = make(floor_only());
  const std::uint64_t before = world.state_hash();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(world.step({nan, 0.0}), World::Status::command_refused);
  EXPECT_EQ(world.step({0.0, std::numeric_limits<double>::infinity()}),
            World::Status::command_refused);
  EXPECT_EQ(world.state_hash(), before);
  EXPECT_EQ(world.step({}), World::Status::running);
}

TEST(World, S2_a_state_that_is_no_number_stops_the_world_for_good) {
  World world = make(floor_only(), {{std::numeric_limits<double>::quiet_NaN(), 0.0}, 0.0});
  EXPECT_EQ(world.step({}), World::Status::numeric_failure);
  EXPECT_EQ(world.step({}), World::Status::numeric_failure);
}

}  // namespace
}  // namespace navvi_sim::live
