#include "navvi_floor/zones.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <navvi_config/reader.hpp>

#include "temp_folder.hpp"

namespace navvi_floor {
namespace {

using Kind = navvi_types::ZoneState::Kind;

constexpr double kRadius = 0.35;  // m
constexpr double kBeat = 0.05;    // s, between two looks at the zones

Zones zones(const std::string& text) {
  const navvi_test::TempFolder folder;
  return Zones(folder.write("zones.yaml", text));
}

std::string refusal(const std::string& text) {
  try {
    zones(text);
  } catch (const navvi_config::ConfigError& error) {
    return error.what();
  }
  return {};
}

const char* const kPress = "- {name: press shop, kind: keep_out, corners: [2, -1, 4, -1, 4, 1, 2, 1]}\n";
const char* const kLane = "- {name: lane, kind: slow, speed: 0.4, corners: [2, -1, 6, -1, 6, 1, 2, 1]}\n";

/// Where a robot is and how fast, that is pushed ahead at 1.2 m/s and given what zones allow one
/// beat ago; its brakes are no better than they have to be.
struct Robot {
  Point at;
  double yaw = 0.0;
  double speed = 0.0;
  double fastest_inside = 0.0;  ///< m/s, with any part of it in the box 2..6, -1..1

  void push(const Zones& zones, double seconds) {
    double allowed = zones.at(at, yaw, kRadius).forward;
    for (double time = 0.0; time < seconds; time += kBeat) {
      const double wanted = std::min(1.2, allowed);
      allowed = zones.at(at, yaw, kRadius).forward;
      const double change = navvi_types::kBrakes * kBeat;
      speed = std::clamp(wanted, speed - change, speed + change);
      at = at + speed * kBeat * Point{std::cos(yaw), std::sin(yaw)};
      const double dx = std::max({2.0 - at.x, 0.0, at.x - 6.0});
      const double dy = std::max(std::abs(at.y) - 1.0, 0.0);
      if (std::hypot(dx, dy) < kRadius) fastest_inside = std::max(fastest_inside, speed);
    }
  }
};

TEST(Zones, a_robot_that_is_pushed_on_comes_to_rest_before_a_closed_one) {
  for (const double side : {0.0, 0.7, -1.2}) {
    for (const double turned : {-0.3, 0.0, 0.3}) {
      Robot robot{{-1.0, side}, turned};
      robot.push(zones(kPress), 12.0);
      const double dx = std::max({2.0 - robot.at.x, 0.0, robot.at.x - 4.0});
      const double dy = std::max(std::abs(robot.at.y) - 1.0, 0.0);
      if (robot.at.x < 8.0) {
        EXPECT_GE(std::hypot(dx, dy), kRadius - 0.01) << side << " " << turned;
        EXPECT_LT(robot.speed, 0.05);
        EXPECT_EQ(zones(kPress).at(robot.at, robot.yaw, kRadius).kind, Kind::keep_out);
        EXPECT_GT(zones(kPress).at(robot.at, robot.yaw, kRadius).backward, 1.2) << "it may go back";
      }
    }
  }
}

TEST(Zones, a_robot_that_passes_beside_a_closed_one_is_let_pass) {
  Robot robot{{-1.0, 1.4}};
  robot.push(zones(kPress), 8.0);
  EXPECT_GT(robot.at.x, 5.5);
}

TEST(Zones, a_slow_one_is_entered_at_its_speed_and_left_at_any) {
  Robot robot{{-1.0, 0.0}};
  robot.push(zones(kLane), 20.0);
  EXPECT_LE(robot.fastest_inside, 0.41);
  EXPECT_GT(robot.at.x, 8.0);
  EXPECT_GT(robot.speed, 1.1);
  const auto inside = zones(kLane).at({3.0, 0.0}, 1.0, kRadius);
  EXPECT_EQ(inside.kind, Kind::slow);
  EXPECT_EQ(inside.name, "lane");
  EXPECT_EQ(inside.forward, 0.4);
  EXPECT_EQ(inside.backward, 0.4);
  EXPECT_EQ(zones(kLane).at({0.0, 0.0}, 0.0, kRadius).kind, Kind::none);
}

TEST(Zones, who_is_in_a_closed_one_is_let_out) {
  const auto inside = zones(kPress).at({3.0, 0.0}, 0.0, kRadius);
  EXPECT_EQ(inside.kind, Kind::keep_out);
  EXPECT_GT(inside.forward, 0.1);
  EXPECT_GT(inside.backward, 0.1);
}

TEST(Zones, of_two_at_one_place_the_strictest_holds_in_any_order) {
  for (const std::string& both : {kPress + std::string(kLane), kLane + std::string(kPress)}) {
    for (const double x : {1.0, 1.9, 3.0, 4.2}) {
      const auto state = zones(both).at({x, 0.0}, 0.0, kRadius);
      const auto press = zones(kPress).at({x, 0.0}, 0.0, kRadius);
      const auto lane = zones(kLane).at({x, 0.0}, 0.0, kRadius);
      EXPECT_EQ(state.forward, std::min(press.forward, lane.forward)) << x;
      EXPECT_EQ(state.backward, std::min(press.backward, lane.backward)) << x;
      EXPECT_EQ(state.name, press.kind == Kind::none ? lane.name : press.name) << x;
    }
  }
}

TEST(Zones, a_border_that_goes_round_twice_or_touches_itself_encloses_the_same) {
  for (const char* const corners : {"0, 0, 4, 0, 4, 4, 0, 4, 0, 0, 4, 0, 4, 4, 0, 4", "0, 0, 4, 0, 4, 4, 0, 4, 0, 0",
                                    "0, 0, 4, 0, 2, 2, 4, 4, 0, 4, 2, 2"}) {
    const Zones one = zones("- {name: a, kind: rack, corners: [" + std::string(corners) + "]}");
    EXPECT_TRUE(one.all().front().contains({2.0, 1.0})) << corners;
    EXPECT_FALSE(one.all().front().contains({5.0, 1.0})) << corners;
  }
}

TEST(Zones, closed_ones_are_obstacles_of_the_floor_and_slow_ones_are_not) {
  MapSurvey survey;
  survey.cell_size = 0.1;
  survey.low = {-20, -20};
  survey.columns = survey.rows = 60;
  survey.ground = Bands<Ground>(60, 60, Ground::floor);
  const Bands<Ground> before = survey.ground;
  zones(kLane).close(survey);
  EXPECT_TRUE(survey.ground == before);
  zones("- {name: bay, kind: rack, corners: [-9, -9, 1, -9, 1, 1]}").close(survey);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      // The bay lies on and below the line y = x, up to x = 1; the cell's corner that is deepest in it:
      const double left = 0.1 * (x - 20), bottom = 0.1 * (y - 20), right = left + 0.1;
      const bool touches = left < 0.99 && bottom < std::min(right, 1.0) - 0.01;
      const bool far = left > 1.05 || bottom > right + 0.05;
      const Ground ground = survey.ground.at(x, y);
      EXPECT_TRUE(touches ? ground == Ground::obstacle : !far || ground == Ground::floor)
          << left << " " << bottom;
    }
  }
  EXPECT_EQ(before.at(0, 0), Ground::floor) << "copies stay";
}

TEST(Zones, what_cannot_be_a_zone_is_refused_with_its_line) {
  EXPECT_EQ(refusal("[]"), "");
  EXPECT_EQ(refusal(kPress), "");
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "must be a list"},
           {"a: 1", "must be a list"},
           {kPress + std::string("- {name: big, kind: rack, corners: [-1, -1, 3, 3, 3, -1, -1, 3]}"),
            "line 3: the lines between the \"corners\" of \"big\" cross"},
           {"{}", "must be a list"},
           {"some words", "must be a list"},
           {"- {name: a, corners: [0, 0, 1, 0, 1, 1]}", "lacks \"kind\""},
           {"- {name: a, kind: round, corners: [0, 0, 1, 0, 1, 1]}", "keep_out, slow"},
           {"- {name: a, kind: slow, corners: [0, 0, 1, 0, 1, 1]}", "\"speed\""},
           {"- {name: a, kind: rack, speed: 1, corners: [0, 0, 1, 0, 1, 1]}", "\"speed\""},
           {"- {name: \"a<b\", kind: rack, corners: [0, 0, 1, 0, 1, 1]}", "cannot be spoken"},
           {"- {kind: rack, corners: [0, 0, 1, 0, 1, 1]}", "cannot be spoken"},
           {"- {name: a, kind: rack, corners: [0, 0, 1, 0, 1]}", "3 to 100 corners"},
           {"- {name: a, kind: rack}", "3 to 100 corners"},
           {"- {name: a, kind: rack, corners: [0, 0, 1, .nan, 1, 1]}", "corners"},
           {"- {name: a, kind: rack, size: 2, corners: [0, 0, 1, 0, 1, 1]}", "size"}}) {
    EXPECT_NE(refusal("\n" + text).find(says), std::string::npos) << text << ": " << refusal(text);
    EXPECT_NE(refusal("\n" + text).find("zones.yaml"), std::string::npos);
  }
}

}  // namespace
}  // namespace navvi_floor
