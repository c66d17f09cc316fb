#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>
#include <navvi_types/cue_kind.hpp>

#include "navvi_people/loop/closed_loop.hpp"
#include "temp_folder.hpp"

namespace navvi_people::loop {
namespace {

/// A thing of one box that stands still. \param at  m, its centre: x y z
std::string box(const std::string& name, const std::string& size, const std::string& at) {
  return "<model name='" + name + "'><static>true</static><pose>" + at +
         " 0 0 0</pose><link name='l'><collision name='c'><geometry><box><size>" + size +
         "</size></box></geometry></collision></link></model>\n";
}

/// A trial in a room in which a lamp hangs on the straight way.
struct Trial {
  bool under = false;  ///< the way led under the lamp
  int stops = 0;       ///< that were asked for
  int contacts = 0;
  double left = 0.0;  ///< m, to the goal
};

/// \param height  m, of the robot, as navigation has it
Trial drive(double bottom, const std::string& sensing, const std::string& height) {
  const navvi_test::TempFolder folder;
  ClosedLoopConfig config;
  config.sim.world = folder.write(
      "lamp.world", "<sdf version='1.7'><world name='w'>\n" +
                        box("ground_plane", "12 6 0.1", "0 0 -0.05") +
                        box("lamp", "0.8 0.8 0.4", "0 0 " + std::to_string(bottom + 0.2)) +
                        "</world></sdf>");
  config.sim.start = "-3,0,0";
  config.sim.goal = "3,0";
  config.sim.sensing = sensing;
  navvi_config::read(config.nav, navvi_config::read_words({"mesh/robot_height:=" + height}),
                     "the test");
  ClosedLoop loop(config, Spoken(NAVVI_PHRASES));
  Trial trial;
  while (loop.time() < 40.0 && loop.step()) {
    trial.contacts += static_cast<int>(loop.told().contacts.size());
    for (const navvi_msgs::Cue& cue : loop.told().cues)
      trial.stops += cue.stage == navvi_msgs::Cue::STARTED && cue.kind == "obstacle_stop" ? 1 : 0;
    const Eigen::Vector2d at = loop.session().world().now().robot.position;
    trial.under = trial.under || at.cwiseAbs().maxCoeff() < 0.7;
    trial.left = (at - loop.scenario().goal).norm();
    if (trial.left < 1.0) break;
  }
  return trial;
}

void expect_led(double bottom, const std::string& sensing, double height) {
  const Trial trial = drive(bottom, sensing, std::to_string(height));
  SCOPED_TRACE("a lamp at " + std::to_string(bottom) + " m, by " + sensing);
  EXPECT_EQ(trial.under, bottom > height - 1e-9);
  EXPECT_LT(trial.left, 1.0);
  if (height > 0.8) return;
  EXPECT_FALSE(trial.under && trial.stops > 0) << trial.stops << " stops";
  EXPECT_EQ(trial.contacts, 0);
}

TEST(Headroom, is_one_for_map_hull_and_what_is_near_so_no_path_leads_under_what_is_stopped_for) {
  for (int i = 0; i <= 30; ++i) expect_led(0.1 * i, "truth", 0.8);
  for (const double bottom : {0.4, 0.7, 0.9, 1.2, 2.0}) expect_led(bottom, "robot", 0.8);
}

TEST(Headroom, of_a_higher_robot_is_that_of_its_sensors_too_and_none_is_lower_than_the_hull) {
  for (const double bottom : {0.9, 1.4})  // the camera sees no higher lamp in time
    expect_led(bottom, "robot", 1.2);
  EXPECT_THROW(drive(1.0, "truth", "0.5"), navvi_config::ConfigError);
}

}  // namespace
}  // namespace navvi_people::loop
