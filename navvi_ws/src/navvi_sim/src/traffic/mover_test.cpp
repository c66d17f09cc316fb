#include "traffic/mover.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "traffic/traffic.hpp"
#include "warehouse.hpp"

namespace navvi_sim::traffic {
namespace {

const Disc kFar{{1000.0, 1000.0}, 0.35};

/// A forklift, alone.
class Alone {
 public:
  Alone(const Eigen::Vector2d& at, double yaw, const Route& route, MoversConfig config = {})
      : traffic_(world(at, yaw, route), config, 1) {}

  void run(double seconds, const Disc& robot = kFar,
           const std::vector<std::size_t>& pressing = {}) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i)
      traffic_.step(robot, pressing, 0.01);
  }
  [[nodiscard]] const Mover& mover() const { return traffic_.mover(0); }
  [[nodiscard]] const Eigen::Vector2d& at() const { return mover().place().position; }

  static WorldDescription world(const Eigen::Vector2d& at, double yaw, const Route& route) {
    Thing thing;
    thing.name = "forklift";
    thing.thing_class = ThingClass::forklift;
    thing.pose.translate(Eigen::Vector3d(at.x(), at.y(), 0.0));
    thing.pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    thing.shapes.push_back(
        {Box{{2.0, 1.0, 2.0}}, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 1.0))});
    thing.route = route;
    WorldDescription world;
    world.things = {thing};
    return world;
  }

 private:
  Traffic traffic_;
};

TEST(Footprint, is_measured_about_the_origin) {
  const Thing thing = Alone::world({3, 4}, 1.0, through({{0, 0}, {1, 0}})).things[0];
  const Footprint print = footprint_of(thing, Eigen::Quaterniond::Identity());
  EXPECT_NEAR(print.front, 1.5, 1e-12);
  EXPECT_NEAR(print.back, 0.5, 1e-12);
  EXPECT_NEAR(print.side, 0.5, 1e-12);
  EXPECT_NEAR(print.radius, std::hypot(1.5, 0.5), 1e-12);
  EXPECT_NEAR(print.bottom, 0.0, 1e-12);
  EXPECT_NEAR(print.top, 2.0, 1e-12);
  EXPECT_EQ(print.hull.size(), 4u);
}

TEST(Extent, holds_the_whole_footprint_in_a_rectangle_within_a_disc) {
  const Eigen::Isometry3d ahead(Eigen::Translation3d(0.4, 0.3, 1.0));
  const Eigen::Isometry3d askew(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  std::vector<Thing> things(3);
  things[0].shapes = {{Box{{2.0, 0.5, 1.0}}, ahead}};
  things[1].shapes = {{Box{{2.0, 0.5, 1.0}}, askew}};
  things[2].shapes = {{Box{{3.0, 0.4, 1.0}}, askew}, {Cylinder{0.4, 1.0}, ahead}};
  for (const Thing& thing : warehouse(1).things)
    if (thing.route && thing.thing_class != ThingClass::worker) things.push_back(thing);
  ASSERT_GT(things.size(), 3u);
  for (const Thing& thing : things) {
    const Footprint print = footprint_of(thing, tilt_of(thing.pose));
    const navvi_types::MovingThing extent = extent_of(print);
    EXPECT_GT(extent.length, 0.0);
    EXPECT_LE(std::hypot(extent.length, extent.width), 2.0 * extent.radius + 1e-9);
    for (const Eigen::Vector2d& corner : print.hull) {
      // The hull of what is round is drawn up to 2 % too wide.
      EXPECT_LE(std::abs(corner.x()), 0.51 * extent.length);
      EXPECT_LE(std::abs(corner.y()), 0.51 * extent.width);
    }
  }
}

TEST(Extent, of_a_forklift_has_the_width_of_the_forklift_and_the_length_with_its_forks) {
  for (const Thing& thing : warehouse(1).things) {
    if (!thing.route || thing.thing_class != ThingClass::forklift) continue;
    const navvi_types::MovingThing extent = extent_of(footprint_of(thing, tilt_of(thing.pose)));
    EXPECT_NEAR(extent.length, 2.5, 1e-9);
    EXPECT_NEAR(extent.width, 1.0, 1e-9);
    EXPECT_LT(extent.radius, 1.4);
    return;
  }
  FAIL() << "no forklift";
}

TEST(Extent, of_what_is_round_is_its_disc_alone) {
  Thing worker;
  worker.shapes = {{Cylinder{0.24, 1.45}, Eigen::Isometry3d::Identity()}};
  const navvi_types::MovingThing extent =
      extent_of(footprint_of(worker, Eigen::Quaterniond::Identity()));
  EXPECT_EQ(extent.radius, 0.24);
  EXPECT_EQ(extent.length, 0.0);
  EXPECT_EQ(extent.width, 0.0);
}

TEST(Mover, turns_brakes_and_speeds_up_no_faster_than_it_may) {
  Alone alone({2, 0}, 0, through({{0, 0}, {8, 0}, {8, 6}, {2, 9}}, 1.5));
  double yaw = alone.mover().place().yaw, speed = 0.0;
  Eigen::Vector2d at = alone.at();
  for (int i = 0; i < 12000; ++i) {
    alone.run(0.01);
    const double turned = navvi_types::wrap(alone.mover().place().yaw - yaw);
    ASSERT_LE(std::abs(turned), 0.01 * 1.0 + 1e-9) << i;
    ASSERT_LE(alone.mover().speed() - speed, 0.8 * 0.01 + 1e-9);
    ASSERT_GE(alone.mover().speed() - speed, -1.7 * 0.01 - 1e-9) << i;
    const double moved = (alone.at() - at).norm();
    ASSERT_LE(moved, 0.01 * 1.5 + 1e-9);
    if (std::abs(turned) > 1e-4 && moved > 1e-9) {
      ASSERT_LE(moved * std::abs(turned) / 1e-4, 0.8 * 1.1) << "sideways, m/s^2";
    }
    yaw = alone.mover().place().yaw;
    speed = alone.mover().speed();
    at = alone.at();
  }
}

TEST(Mover, keeps_the_speed_and_the_pause_of_each_way_point) {
  Route route = through({{0, 0}, {10, 0}, {20, 0}});
  route.waypoints[1].pause = 5.0;
  route.waypoints[2].speed = 0.5;
  Alone alone({0, 0}, 0, route);
  alone.run(5.0);
  EXPECT_NEAR(alone.mover().speed(), 1.0, 1e-6);
  alone.run(8.5);
  EXPECT_NEAR(alone.at().x(), 10.0, 1e-6);
  EXPECT_EQ(alone.mover().speed(), 0.0);
  alone.run(10.0);
  EXPECT_NEAR(alone.mover().speed(), 0.5, 1e-6);
}

TEST(Mover, ends_at_the_last_way_point_of_a_route_without_loop) {
  Route route = through({{0, 0}, {3, 0}});
  route.loop = false;
  Alone alone({0, 0}, 0, route);
  alone.run(60.0);
  EXPECT_NEAR((alone.at() - Eigen::Vector2d(3, 0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(alone.mover().speed(), 0.0);
  EXPECT_NEAR(alone.mover().s(), 3.0, 1e-9);
}

TEST(Mover, stands_still_before_each_round_for_as_long_as_the_delay) {
  Route route = through({{0, 0}, {1, 0}});
  route.delay = 20.0;
  MoversConfig config;
  config.pause_spread = 0.0;
  Alone alone({0, 0}, 0, route, config);
  int left = 0;
  bool at_home = true;
  for (int i = 0; i < 7000; ++i) {
    alone.run(0.01);
    if (i < 1990) {
      ASSERT_LT(alone.at().norm(), 1e-6);
    }
    const bool now = alone.at().norm() < 1e-3;
    left += at_home && !now;
    at_home = now;
  }
  EXPECT_EQ(left, 2);
}

TEST(Mover, backs_out_along_its_track_slowly_and_smoothly_and_tells_how_it_moves) {
  Route route = through({{0, 0}, {6, 0}, {6, 5}, {0, 5}}, 1.5);
  route.waypoints[2].pause = 1.0;  // it turns there on the spot
  const MoversConfig config;
  const Lanes lanes = lay_lanes(Alone::world({0, 0}, 0, route), config);
  const Lane& lane = lanes.lanes.at(0);
  const double length = lane.track.length();
  for (double from = 0.3; from < length; from += 1.7) {
    Mover mover(lane, from, config, 1);
    const double to = from - 0.4 * length;  // often round the beginning of the track
    mover.back_out(to);
    double speed = 0.0;
    for (int i = 0; i < 10000 && mover.backs_out(); ++i) {
      const Pose2 before = mover.place();
      mover.step(Mover::kFree, 0.01);
      const Eigen::Vector2d moved = mover.place().position - before.position;
      ASSERT_LE(mover.speed(), 0.0);
      ASSERT_GE(mover.speed(), -config.back_speed - 1e-9);
      ASSERT_LE(std::abs(mover.speed() - speed), 2.0 * config.acceleration * 0.01 + 0.02);
      speed = mover.speed();
      // What it says is how it moves, and never forwards.
      ASSERT_LE((moved - 0.01 * mover.velocity()).norm(), 0.006);
      ASSERT_LE(moved.dot(Eigen::Vector2d(std::cos(before.yaw), std::sin(before.yaw))), 1e-9);
      ASSERT_EQ(mover.allowed(), mover.s());
    }
    EXPECT_FALSE(mover.backs_out());
    EXPECT_EQ(mover.speed(), 0.0);
    const Pose2 end = lane.track.place(to < 0.0 ? to + length : to);
    EXPECT_NEAR((mover.place().position - end.position).norm(), 0.0, 1e-6) << from;
    mover.allow(mover.s() + 0.3 * length);
    for (int i = 0; i < 6000; ++i) mover.step(Mover::kFree, 0.01);
    EXPECT_NEAR(mover.s(), mover.allowed(), 1e-6) << "it goes on again";
  }
}

MoversConfig patient() {
  MoversConfig config;
  config.patience = 3600.0;
  return config;
}

TEST(Mover, waits_for_the_robot_ahead_as_long_as_it_stands_there_and_no_longer) {
  Alone alone({0, 0}, 0, through({{0, 0}, {10, 0}}), patient());
  alone.run(60.0, {{6.0, 0.0}, 0.35});
  EXPECT_EQ(alone.mover().speed(), 0.0);
  EXPECT_LT(alone.at().x() + 1.5, 6.0 - 0.35 - 0.2);
  EXPECT_GT(alone.at().x() + 1.5, 6.0 - 0.35 - 0.7);
  alone.run(3.0);
  EXPECT_GT(alone.at().x(), 5.0);
}

TEST(Mover, foresees_the_robot_that_crosses_and_does_not_run_into_it) {
  int stopped = 0;
  for (double start = 0.0; start < 16.0; start += 0.25) {
    Alone alone({start, 0}, 0, through({{0, 0}, {30, 0}}, 1.5));
    Disc robot{{22.0, 4.5}, 0.35, {0.0, -0.6}};
    bool beside = false;
    for (int i = 0; i < 1500; ++i) {
      alone.run(0.01, robot);
      robot.centre += 0.01 * robot.velocity;
      const Eigen::Vector2d away = robot.centre - alone.at();
      // The robot may run into it, but it not into the robot. Its nose is 1.5 m ahead.
      beside = beside || (std::abs(away.y()) < 1.1 && away.x() < 1.5);
      if (!beside && alone.mover().speed() > 0.0) {
        ASSERT_GT(std::hypot(away.x() - 1.5, std::max(0.0, std::abs(away.y()) - 0.5)), 0.35)
            << "from " << start << " after " << 0.01 * i << " s";
      }
    }
    stopped += beside ? 0 : 1;
  }
  EXPECT_GT(stopped, 20);
}

TEST(Mover, passes_the_robot_that_stands_beside_its_way_or_behind) {
  for (const Eigen::Vector2d& robot : {Eigen::Vector2d(5.0, 1.1), Eigen::Vector2d(-1.0, 0.0)}) {
    Alone alone({0, 0}, 0, through({{0, 0}, {10, 0}}, 1.0, 60.0));
    alone.run(14.0, {robot, 0.35});
    EXPECT_NEAR(alone.at().x(), 10.0, 1e-6);
  }
}

TEST(Mover, does_not_swing_its_tail_into_the_robot) {
  // At (5, 0) it turns on the spot to the left, towards the robot beside its nose.
  Route route = through({{0, 0}, {5, 0}, {5, 5}});
  route.waypoints[1].pause = 0.1;
  Alone alone({0, 0}, 0, route, patient());
  alone.run(20.0, {{5.9, 1.2}, 0.35});
  EXPECT_LT(alone.mover().place().yaw, 0.6);
  alone.run(8.0);
  EXPECT_GT(alone.at().y(), 1.0);
}

TEST(Mover, does_not_stop_for_the_robot_where_its_route_does_not_yield) {
  Route route = through({{0, 0}, {10, 0}});
  route.yields = false;
  Alone alone({0, 0}, 0, route);
  alone.run(5.0, {{6.0, 0.0}, 0.35});
  EXPECT_GT(alone.mover().speed(), 0.9);
}

TEST(Mover, backs_out_from_a_robot_that_it_presses_even_if_it_does_not_yield) {
  Route route = through({{0, 0}, {10, 0}});
  route.yields = false;
  Alone alone({0, 0}, 0, route);
  alone.run(5.0);
  const double pressed = alone.at().x();
  const Disc robot{{pressed + 1.5 + 0.34, 0.0}, 0.35};
  for (int i = 0; i < 3000 && alone.at().x() > pressed - 0.5; ++i)
    alone.run(
        0.01, robot,
        alone.at().x() > pressed - 0.01 ? std::vector<std::size_t>{0} : std::vector<std::size_t>{});
  EXPECT_LT(alone.at().x(), pressed - 0.49);
  alone.run(60.0);
  EXPECT_GT(alone.mover().s(), 0.0);
}

TEST(Mover, that_backs_out_stops_for_the_robot_behind_even_where_it_does_not_yield) {
  Route route = through({{0, 0}, {10, 0}});
  route.yields = false;
  Alone alone({0, 0}, 0, route);
  alone.run(8.0);
  const double pressed = alone.at().x();
  for (int i = 0; i < 3000 && !alone.mover().backs_out(); ++i)
    alone.run(0.01, {{pressed + 1.5 + 0.34, 0.0}, 0.35}, {0});
  ASSERT_TRUE(alone.mover().backs_out());
  const Disc robot{{pressed - 0.5 - 1.5, 0.0}, 0.35};  // 1.15 m behind its tail
  for (int i = 0; i < 1000; ++i) {
    alone.run(0.01, robot);
    ASSERT_GT(alone.at().x() - 0.5 - robot.centre.x(), 0.35 + 0.3) << "after " << 0.01 * i << " s";
  }
}

TEST(Driver, has_another_hash_when_anything_differs_that_it_will_act_on) {
  Route route = through({{0, 0}, {10, 0}}, 1.0, 2.0);
  route.loop = true;
  const WorldDescription world = Alone::world({0, 0}, 0, route);
  const Lanes lanes = lay_lanes(world, {});
  const LaneUser& entry = lanes.users[0];
  const Driver driver(lanes.lanes[entry.lane], entry, route, {}, 1);
  const auto differs = [&](const auto& change) {
    Driver other = driver;
    change(other);
    return other.hash(0) != driver.hash(0);
  };
  EXPECT_FALSE(differs([](Driver&) {}));
  EXPECT_TRUE(differs([](Driver& other) { other.next += 1; }));
  EXPECT_TRUE(differs([](Driver& other) { other.on_shared_ground = !other.on_shared_ground; }));
  EXPECT_TRUE(differs([](Driver& other) { other.goes_back = !other.goes_back; }));
  EXPECT_TRUE(differs([](Driver& other) { other.robot_ahead = !other.robot_ahead; }));
  EXPECT_TRUE(differs([](Driver& other) { other.robot_behind = !other.robot_behind; }));
  EXPECT_TRUE(differs([](Driver& other) { other.kept += 0.01; }));
  EXPECT_NE(Driver(lanes.lanes[entry.lane], entry, route, {}, 2).hash(0), driver.hash(0))
      << "the pauses to come";
}

TEST(Mover, stops_dead_where_it_would_crush_the_robot) {
  MoversConfig config;
  config.yield = false;
  Alone alone({0, 0}, 0, through({{0, 0}, {10, 0}}), config);
  alone.run(3.0);
  const Eigen::Vector2d before = alone.at();
  alone.run(1.0, {{3.0, 0.0}, 0.35}, {0});
  EXPECT_EQ(alone.at(), before);
  EXPECT_EQ(alone.mover().speed(), 0.0);
}

}  // namespace
}  // namespace navvi_sim::traffic
