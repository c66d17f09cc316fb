#include <gtest/gtest.h>

#include <cmath>
#include <navvi_config/reader.hpp>
#include <set>

#include "navvi_people/loop/closed_loop.hpp"
#include "temp_folder.hpp"

namespace navvi_people::loop {
namespace {

// A bare room of 12 x 8 m; the straight way leads through both zones.
const char* const kRoom =
    "<sdf version='1.7'><world name='w'><model name='ground_plane'><static>true</static>"
    "<pose>0 0 -0.05 0 0 0</pose><link name='l'><collision name='c'><geometry><box>"
    "<size>12 8 0.1</size></box></geometry></collision></link></model></world></sdf>";
const char* const kZones =
    "- {name: press, kind: keep_out, corners: [-2, -1, 0, -1, 0, 1, -2, 1]}\n"
    "- {name: lane, kind: slow, speed: 0.3, corners: [1.5, -4, 3, -4, 3, 4, 1.5, 4]}\n";

TEST(Zones, a_person_is_led_round_a_closed_one_and_slowly_through_a_slow_one) {
  const navvi_test::TempFolder folder;
  ClosedLoopConfig config;
  config.sim.world = folder.write("room.world", kRoom);
  config.sim.start = "-4.5,0,0";
  config.sim.goal = "4.5,0";
  navvi_config::read(config.nav,
                     navvi_config::read_words({"mesh/zones:=" + folder.write("zones.yaml", kZones)}),
                     "the test");
  ClosedLoop loop(config, Spoken(NAVVI_PHRASES));
  std::set<std::string> said;
  double nearest = 10.0, fastest = 0.0;
  while (loop.time() < 120.0 && loop.step()) {
    for (const navvi_msgs::Cue& cue : loop.told().cues)
      if (cue.stage == navvi_msgs::Cue::STARTED) said.insert(cue.text);
    const auto& robot = loop.session().world().now().robot;
    const double dx = std::max({-2.0 - robot.position.x(), 0.0, robot.position.x()});
    const double dy = std::max(std::abs(robot.position.y()) - 1.0, 0.0);
    nearest = std::min(nearest, std::hypot(dx, dy));
    if (robot.position.x() > 1.5 && robot.position.x() < 3.0)
      fastest = std::max(fastest, std::abs(loop.told().odometry.twist.twist.linear.x));
    if ((robot.position - loop.scenario().goal).norm() < 0.5) break;
  }
  EXPECT_LT((loop.session().world().now().robot.position - loop.scenario().goal).norm(), 0.5);
  EXPECT_GE(nearest, 0.34) << "m, from the robot's middle to the closed zone";
  EXPECT_LE(fastest, 0.32);
  EXPECT_EQ(said.count("slow zone, lane"), 1U);
}

}  // namespace
}  // namespace navvi_people::loop
