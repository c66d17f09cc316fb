#include "recount/repetition.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>
#include <navvi_config/writer.hpp>
#include <navvi_sim/setup/sim_node_config.hpp>

namespace navvi_study::recount {
namespace {

/// What sim_node would record of two seconds in which the robot is told to drive ahead.
RecordedSession drive_ahead(navvi_sim::setup::SimNodeConfig config) {
  const navvi_sim::WorldDescription world = navvi_sim::setup::load_world(config).world;
  navvi_sim::live::Session session(world, config.life, config.start_pose().value(),
                                   static_cast<std::uint64_t>(config.seed));
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(session.step({0.5, 0.1}, navvi_sim::physics::Braking::normal),
              navvi_sim::live::World::Status::running);
  }
  RecordedSession out;
  out.parameters = navvi_config::write(config);
  out.world_hash = navvi_sim::world_hash(world);
  out.commands = session.commands();
  out.states = session.hashes();
  return out;
}

class Repetition : public testing::Test {
 protected:
  Repetition() {
    config_.world = "training";
    config_.seed = 3;
    config_.start = "0,0,0";
  }
  navvi_sim::setup::SimNodeConfig config_;
};

TEST_F(Repetition, equalsWhatWasRecorded) { EXPECT_EQ(first_difference(drive_ahead(config_)), ""); }

TEST_F(Repetition, takesARecordOfBeforeWithItsRetiredParameters) {
  RecordedSession recorded = drive_ahead(config_);
  recorded.parameters +=
      "box_fill: 0.6\nforklift_speed: 1\npallet_robot_speed: 0.7\nworker_speed: 0.8\n"
      "movers: {yield: true}\nceiling: 2\ndetection_radius: 5\n";
  EXPECT_EQ(first_difference(recorded), "");
}

TEST_F(Repetition, namesAParameterThatNoVersionHad) {
  RecordedSession recorded = drive_ahead(config_);
  recorded.parameters += "box_filled: 0.6\n";
  EXPECT_THROW(static_cast<void>(first_difference(recorded)), navvi_config::ConfigError);
}

TEST_F(Repetition, tellsWhereTheStateDiffers) {
  RecordedSession recorded = drive_ahead(config_);
  recorded.states.back().hash ^= 1;
  EXPECT_NE(first_difference(recorded).find("They differ at"), std::string::npos);
}

}  // namespace
}  // namespace navvi_study::recount
