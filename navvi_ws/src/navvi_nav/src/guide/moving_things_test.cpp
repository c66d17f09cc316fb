// A person with a robot meets moving things: planner and navigator in lockstep.

#include <gtest/gtest.h>

#include <functional>

#include "lockstep.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kPace = 0.7;  // m/s

/// Four blocks of shelves with an aisle of 3 m from left to right and one of 3 m across. The robot
/// drives through the first one; a way round leads along each wall.
class MovingThings : public Lockstep {
 protected:
  MovingThings() : Lockstep(24, 16) {
    for (const double x : {3.0, 13.5}) {
      world_.box(x, 3.5, 0, x + 7.5, 6.5, 1.5);
      world_.box(x, 9.5, 0, x + 7.5, 12.5, 1.5);
    }
    robot_.position = {1.5, 8};
    lead({22.5, 8});
    EXPECT_NEAR(length_of(navigator_.path()), 21.0, 0.1);
  }

  static Cylinder thing(Point at, Point velocity, double radius) {
    return {1, at, radius, velocity};
  }
  struct Drive {
    double waited = 0.0;     ///< s, told to wait
    double lost = 0.0;       ///< s, without a route
    double least = 1e9;      ///< m, between the hulls
    double rerouted = -1.0;  ///< m, from the thing's hull to the robot's when first rerouted
    unsigned reroutes = 0;
    double backwards = 0.0;  ///< m, driven to the left
  };
  /// A person follows until they arrive, and stands while told to wait or without a path. \param
  /// thing  where it is after so many s
  Drive drive_among(const std::function<Cylinder(double)>& thing, double longest) {
    Drive out;
    double elapsed = 0.0;
    while (status().state != Guidance::State::arrived && elapsed < longest) {
      elapsed += kTick;
      obstacles_ = {thing(elapsed)};
      const Guidance now = status();
      const double x = robot_.position.x;
      follow(kPace);
      out.backwards += std::max(0.0, x - robot_.position.x);
      out.waited += now.state == Guidance::State::blocked ? kTick : 0.0;
      out.lost += now.state == Guidance::State::no_route ? kTick : 0.0;
      const double gap =
          distance(robot_.position, obstacles_[0].center) - obstacles_[0].radius - 0.35;
      out.least = std::min(out.least, gap);
      if (status().reroutes > out.reroutes && out.reroutes == 0) out.rerouted = gap;
      out.reroutes = std::max(out.reroutes, status().reroutes);
    }
    EXPECT_EQ(status().state, Guidance::State::arrived);
    return out;
  }
};

TEST_F(MovingThings, a_forklift_that_crosses_is_waited_for_and_nothing_is_rerouted) {
  double waited = 0.0;
  for (const double delay : {4.0, 6.0, 6.5, 8.0, 10.0}) {
    robot_.position = {1.5, 8};
    navigator_.set_goal({22.5, 8});
    tick(2);
    const unsigned before = status().plans;
    const Drive drive = drive_among(
        [&](double time) {
          return thing({12.0, 15.0 - (time - delay)}, {0, -1}, 0.8);
        },
        60.0);
    EXPECT_EQ(drive.reroutes, 0U) << delay;
    EXPECT_EQ(drive.lost, 0.0) << delay;
    EXPECT_LT(drive.waited, 5.0) << delay;
    EXPECT_GT(drive.least, 0.0) << delay;
    EXPECT_LE(status().plans - before, 3U) << delay;
    waited = std::max(waited, drive.waited);
  }
  EXPECT_GT(waited, 0.5);
}

TEST_F(MovingThings, a_forklift_that_stands_is_led_around_once_and_in_time) {
  const Drive drive = drive_among([&](double) { return thing({17.0, 8.0}, {0, 0}, 0.9); }, 120.0);
  EXPECT_EQ(drive.reroutes, 1U);
  EXPECT_GT(drive.rerouted, 5.0);
  EXPECT_EQ(drive.lost, 0.0);
  EXPECT_EQ(drive.waited, 0.0);
  EXPECT_GT(drive.least, 0.3);
}

TEST_F(MovingThings, a_forklift_that_stops_on_its_way_across_is_led_around_once) {
  const Drive drive = drive_among(
      [&](double time) {
        const bool stopped = time >= 9.0;
        return thing({12.0, 17.0 - std::min(time, 9.0)}, {0, stopped ? 0.0 : -1.0}, 1.0);
      },
      120.0);
  EXPECT_EQ(drive.reroutes, 1U);
  EXPECT_EQ(drive.lost, 0.0);
  EXPECT_GT(drive.least, 0.0);
}

TEST_F(MovingThings, a_forklift_that_comes_along_a_wide_aisle_is_passed_without_turning_back) {
  const Drive drive = drive_among(
      [&](double time) {
        return thing({22.0 - time, 8.0}, {-1, 0}, 0.4);
      },
      120.0);
  EXPECT_LE(drive.reroutes, 2U);
  EXPECT_EQ(drive.lost, 0.0);
  EXPECT_EQ(drive.backwards, 0.0);
  EXPECT_GT(drive.least, 0.0);
}

TEST_F(MovingThings, a_forklift_that_comes_and_fills_the_aisle_is_evaded_by_another_way) {
  const Drive drive = drive_among(
      [&](double time) {
        return thing({34.0 - time, 8.0}, {-1, 0}, 1.0);
      },
      120.0);
  EXPECT_GE(drive.reroutes, 1U);
  EXPECT_LE(drive.reroutes, 2U);
  EXPECT_GT(drive.rerouted, 3.0);
  EXPECT_EQ(drive.lost, 0.0);
  EXPECT_GT(drive.least, 0.0);
}

TEST_F(MovingThings, a_thing_that_overtakes_changes_nothing) {
  const Drive drive = drive_among(
      [&](double time) {
        return thing({-4.0 + 1.4 * time, 8.0 + 1.2}, {1.4, 0}, 0.4);
      },
      60.0);
  EXPECT_EQ(drive.reroutes, 0U);
  EXPECT_EQ(drive.waited, 0.0);
  EXPECT_EQ(drive.backwards, 0.0);
}

TEST_F(MovingThings, a_way_that_is_closed_for_good_is_told_and_found_again) {
  robot_.position = {5.9, 8};
  obstacles_ = {{1, {10, 1.7}, 1.6, {}}, {2, {10, 8}, 1.4, {}}, {3, {10, 14.3}, 1.6, {}}};
  tick(200);
  EXPECT_EQ(status().state, Guidance::State::blocked);
  EXPECT_EQ(status().blocked_by, class_of(2));
  obstacles_.pop_back();
  tick(60);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_GT(navigator_.path()[1].y, 8.0);
}

TEST_F(MovingThings, the_old_way_is_taken_again_once_it_is_much_shorter_and_free) {
  obstacles_ = {thing({12.0, 8.0}, {0, 0}, 1.4)};
  tick(20);
  ASSERT_GT(length_of(navigator_.path()), 22.0);
  const unsigned plans = status().plans;
  tick(200);
  EXPECT_EQ(status().plans, plans);  // nothing moved
  obstacles_.clear();
  tick(60);
  EXPECT_NEAR(length_of(navigator_.path()), 21.0, 0.1);
}

/// A forklift with a yaw, as navvi_sim tells it.
MovingThing forklift(Point at, double yaw, double speed = 0.0) {
  return moving_thing({9, at, 1.35, speed * Point{std::cos(yaw), std::sin(yaw)}}, yaw, 2.4, 1.1);
}

/// A hall without shelves. A person drives along its middle, and stands while told to wait.
class OpenHall : public Lockstep {
 protected:
  OpenHall() : Lockstep(30, 16) {
    robot_.position = {1.5, 8};
    lead({28, 8});
    path_ = navigator_.path();
  }
  struct Drive {
    double waited = 0.0;   ///< s
    bool changed = false;  ///< the path
    double least = 1e9;    ///< m, from the forklift's rectangle to the robot
  };
  template <typename Forklift>
  Drive drive_beside(const Forklift& forklift_at, double seconds) {
    Drive out;
    for (double elapsed = 0.0; elapsed < seconds; elapsed += kTick) {
      things_ = {forklift_at(elapsed)};
      out.waited += status().state == Guidance::State::blocked ? kTick : 0.0;
      follow(kPace);
      out.changed = out.changed || !(navigator_.path() == path_);
      const MovingThing& one = things_[0];
      const Point away = robot_.position - to_point(one.pose.position);
      const Point ahead{std::cos(one.pose.yaw), std::sin(one.pose.yaw)};
      const double x = std::max(0.0, std::abs(dot(away, ahead)) - one.length / 2);
      const double y = std::max(0.0, std::abs(cross(ahead, away)) - one.width / 2);
      out.least = std::min(out.least, std::hypot(x, y) - 0.35);
    }
    return out;
  }
  Path path_;
};

TEST_F(OpenHall, a_forklift_in_a_lane_beside_the_path_changes_nothing) {
  const Drive drive = drive_beside(
      [](double time) {
        return forklift({22.0 - time, 9.2}, kPi, 1.0);
      },
      25.0);
  EXPECT_FALSE(drive.changed);
  EXPECT_EQ(drive.waited, 0.0);
  EXPECT_EQ(status().reroutes, 0U);
}

TEST_F(OpenHall, a_forklift_that_crosses_right_before_the_robot_is_waited_for) {
  // As it was seen: 1 m/s, square to the path, less than 1.5 m before who goes on.
  for (const double start : {3.0, 3.5, 4.0, 4.5}) {
    robot_.position = {1.5, 8};
    navigator_.set_goal({28, 8});
    tick(2);
    path_ = navigator_.path();
    const Drive drive = drive_beside(
        [start](double time) {
          return forklift({5.0, start + time}, kPi / 2, 1.0);
        },
        12.0);
    EXPECT_FALSE(drive.changed) << start;
    EXPECT_GT(drive.waited, 0.5) << start;
    EXPECT_LT(drive.waited, 6.0) << start;
    EXPECT_GT(drive.least, 0.1) << start;
    EXPECT_EQ(status().state, Guidance::State::following);
  }
}

TEST_F(OpenHall, a_forklift_that_pauses_far_ahead_is_left_to_go_on) {
  const Drive drive = drive_beside(
      [](double time) {
        const bool pauses = time > 2.0 && time < 6.0;
        const double y = time < 2.0 ? 6.0 + time : std::max(8.0, 2.0 + time);
        return forklift({12.0, y}, kPi / 2, pauses ? 0.0 : 1.0);
      },
      14.0);
  EXPECT_FALSE(drive.changed);
  EXPECT_EQ(drive.waited, 0.0);
}

TEST_F(OpenHall, nobody_is_told_to_wait_for_what_comes_from_behind_but_led_out_of_its_way) {
  for (const double behind : {5.0, 8.0}) {
    robot_ = {{10, 8}, 0.0};
    things_.clear();
    navigator_.set_goal({28, 8});
    tick(2);
    double least = 1e9;
    double waited = 0.0;
    for (double elapsed = 0.0; elapsed < 12.0; elapsed += kTick) {
      obstacles_ = {{3, {10 - 1.25 - behind + 1.5 * elapsed, 8}, 0.9, {1.5, 0}}};
      waited += status().state == Guidance::State::blocked ? kTick : 0.0;
      follow(kPace);
      least = std::min(least, distance(robot_.position, obstacles_[0].center) - 0.9 - 0.35);
    }
    EXPECT_GT(least, 0.1) << behind;
    EXPECT_LT(waited, 1.0) << behind;
    obstacles_.clear();
  }
}

/// N7: for a minute 100 things go up and down across the path, at 1 m/s, and a person follows who
/// turns at 0.8 rad/s at most.
TEST_F(OpenHall, N7_among_100_things_that_cross_plans_are_few_and_directions_steady) {
  unsigned plans = 0;
  int turned_back = 0;  // times the side to steer to changed within a second
  for (int begin = 0; begin < 6; ++begin) {
    robot_ = {{1.5, 8}, 0.0};
    navigator_.set_goal({28, 8});
    const unsigned before = status().plans;
    double side = 0.0;
    double changed = -1.0;
    for (double elapsed = 0.0; elapsed < 60.0; elapsed += kTick) {
      obstacles_.clear();
      for (std::uint32_t i = 0; i < 100; ++i) {
        const double way = std::fmod(5.7 * i + 3.1 * begin + elapsed, 28.0);
        const bool up = way < 14.0;
        obstacles_.push_back(
            {i, {3.0 + 0.25 * i, 1.0 + (up ? way : 28.0 - way)}, 0.25, {0.0, up ? 1.0 : -1.0}});
      }
      const Guidance now = status();
      const bool drives = now.state == Guidance::State::following;
      const double steer = drives ? now.steer_angle : 0.0;
      if (std::abs(steer) > navvi_types::radians(15.0)) {
        if (steer * side < 0.0) {
          turned_back += elapsed - changed < 1.0;
          changed = elapsed;
        }
        side = steer;
      }
      robot_.yaw -= std::clamp(steer, -0.8 * kTick, 0.8 * kTick);
      speed_ = drives && std::abs(steer) < 0.8 ? kPace : 0.0;
      const Point ahead{std::cos(robot_.yaw), std::sin(robot_.yaw)};
      robot_.position = robot_.position + speed_ * kTick * ahead;
      tick();
    }
    EXPECT_LE(status().reroutes, 30U) << "but for safety, what was chosen is kept for 3 s";
    plans += status().plans - before;
  }
  EXPECT_GT(plans, 120U) << "they are in the way";
  EXPECT_LE(plans, 720U);
  EXPECT_LE(turned_back, 1) << "in six minutes";
}

/// A corridor of 3 m, closed at its far end, with an aisle across.
class ClosedCorridor : public Lockstep {
 protected:
  ClosedCorridor() : Lockstep(30, 16) {
    for (const double y : {0.5, 9.5}) {
      world_.box(0.5, y, 0, 12, y + 6.0, 1.5);
      world_.box(15, y, 0, 29.5, y + 6.0, 1.5);
    }
    robot_.position = {1.5, 8};
    load();
  }
};

TEST_F(ClosedCorridor, what_crosses_is_waited_for_though_the_way_is_closed_farther_on) {
  for (const double delay : {10.0, 11.0, 12.0, 13.0, 14.0}) {
    robot_ = {{1.5, 8}, 0.0};
    obstacles_ = {{1, {24, 8}, 1.4, {}}};
    navigator_.set_goal({28, 8});
    tick(2);
    double least = 1e9;
    for (double elapsed = 0.0; elapsed < 25.0; elapsed += kTick) {
      obstacles_ = {{1, {24, 8}, 1.4, {}},
                    {2, {13.5, 14.5 - 1.5 * (elapsed - delay)}, 0.8, {0, -1.5}}};
      follow(kPace);
      least = std::min(least, distance(robot_.position, obstacles_[1].center) - 0.8 - 0.35);
    }
    EXPECT_GT(least, 0.2) << delay;
  }
}

/// An aisle of 2.4 m, too narrow for the robot and a forklift side by side, with halls at both
/// ends.
class NarrowAisle : public Lockstep {
 protected:
  NarrowAisle() : Lockstep(22, 8) {
    world_.box(5, 0.1, 0, 17, 2.8, 1.5).box(5, 5.2, 0, 17, 7.9, 1.5);
    robot_.position = {9, 4};
    lead({20, 4});
  }
};

TEST_F(NarrowAisle, a_forklift_that_waits_for_the_robot_is_made_room_for_and_passes) {
  double x = 12.0;
  double away = 0.0;    // s, told to make room
  double waited = 0.0;  // s, told to wait
  double elapsed = 0.0;
  bool named = true;
  while (status().state != Guidance::State::arrived && elapsed < 120.0) {
    elapsed += kTick;
    const Guidance now = status();
    named = named && (!now.blocked_by || now.blocked_by == class_of(9));
    away += now.state == Guidance::State::make_room ? kTick : 0.0;
    waited += now.state == Guidance::State::blocked ? kTick : 0.0;
    EXPECT_NE(now.state, Guidance::State::no_route);
    EXPECT_NE(now.state, Guidance::State::off_mesh);
    // It goes on while the robot is 0.4 m off its straight way, and leaves by the lower left.
    const Point at = robot_.position;
    const bool clear = std::abs(at.y - 4.0) > 0.55 + 0.35 || at.x > x || at.x < x - 1.2 - 0.75;
    if (clear && x > -30.0) x -= 0.6 * kTick;
    things_ = {forklift({x, 4.0}, kPi, clear ? 0.6 : 0.0)};
    if (x < 3.0) things_.clear();
    follow(kPace);
  }
  EXPECT_EQ(status().state, Guidance::State::arrived);
  EXPECT_TRUE(named);
  EXPECT_GT(away, 2.0);
  EXPECT_GT(waited, 10.0);
}

TEST_F(NarrowAisle, what_crosses_is_waited_for_on_the_way_aside_too) {
  std::optional<double> since;
  double least = 1e9;
  bool waited = false;
  for (double elapsed = 0.0; elapsed < 40.0; elapsed += kTick) {
    const Guidance now = status();
    if (now.state == Guidance::State::make_room && robot_.position.x < 6.9 && !since)
      since = elapsed;
    things_ = {forklift({12.0, 4.0}, kPi)};
    obstacles_.clear();
    if (since) {
      const double y = 7.5 - 1.5 * (elapsed - *since);
      if (y > -3.0) obstacles_ = {{2, {4.2, y}, 0.6, {0, -1.5}}};
      least = std::min(least, distance(robot_.position, {4.2, y}) - 0.6 - 0.35);
      waited = waited || (now.state == Guidance::State::blocked && now.blocked_by == class_of(2));
    }
    follow(kPace);
  }
  EXPECT_TRUE(waited);
  EXPECT_GT(least, 0.2);
}

TEST_F(NarrowAisle, a_robot_within_the_circle_of_a_forklift_is_led_out_of_it) {
  things_ = {forklift({3.2, 3.0}, kPi / 2)};
  robot_.position = {4.2, 3.4};  // within 1.35 m and the robot's radius of it
  navigator_.set_goal({20, 4});
  tick(20);
  EXPECT_EQ(status().state, Guidance::State::following);
  robot_.position = {4.15, 3.2};  // beside it, within the hole of the row
  tick(60);
  EXPECT_EQ(status().state, Guidance::State::following);
}

}  // namespace
}  // namespace navvi_nav::guide
