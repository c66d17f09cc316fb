#include "navvi_sim/live/session.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <navvi_config/reader.hpp>

#include "navvi_sim/setup/sim_node_config.hpp"

namespace navvi_sim::live {
namespace {

struct Record {
  std::vector<navvi_types::StateHash> hashes;
  std::vector<AppliedCommand> commands;
};

/// The warehouse and a drive through it that brakes, turns and bumps.
struct Drive {
  setup::SimNodeConfig config;
  WorldDescription world;
  scenario::StartAndGoal scenario;

  explicit Drive(int seed) {
    config.seed = seed;
    world = setup::load_world(config).world;
    scenario = setup::scenario_of(config, world, occupancy::voxels_of(world, config.octomap));
  }
  [[nodiscard]] Session begin() const {
    return Session(world, config.life, scenario.start, static_cast<std::uint64_t>(config.seed));
  }
  /// By hand, step by step, as a person's commands come: at any step, not at every one.
  [[nodiscard]] Record driven(int steps) const {
    Session session = begin();
    for (int i = 0; i < steps; ++i) {
      const double t = 0.02 * (i / 2);
      const bool stop = i % 700 > 640;
      const navvi_types::Velocity command{stop ? 0.0 : 0.7 + 0.3 * std::sin(t), std::sin(0.4 * t)};
      EXPECT_EQ(
          session.step(command, stop ? physics::Braking::emergency : physics::Braking::normal),
          World::Status::running);
    }
    return {session.hashes(), session.commands()};
  }
};

constexpr int kSteps = 2000;

TEST(Session, writes_down_each_second_and_each_change_of_the_command) {
  Session session = Drive(1).begin();
  for (int i = 0; i < 250; ++i)
    ASSERT_EQ(session.step({i < 100 ? 0.0 : 0.5, 0.0}), World::Status::running);
  ASSERT_EQ(session.hashes().size(), 3u);
  EXPECT_EQ(session.hashes()[0].step, 0u);
  EXPECT_EQ(session.hashes()[2].step, 200u);
  ASSERT_EQ(session.commands().size(), 2u);
  EXPECT_EQ(session.commands()[1].step, 100u);
  EXPECT_EQ(session.commands()[1].velocity.linear, 0.5);
}

TEST(Session, its_record_repeats_it) {
  const Drive drive(3);
  const Record first = drive.driven(kSteps);
  Session again = drive.begin();
  EXPECT_EQ(replay(again, first.commands, kSteps), World::Status::running);
  EXPECT_EQ(again.hashes(), first.hashes);

  std::vector<AppliedCommand> other = first.commands;
  for (AppliedCommand& command : other) command.velocity.linear += 1e-12;
  Session different = drive.begin();
  EXPECT_EQ(replay(different, other, kSteps), World::Status::running);
  EXPECT_NE(different.hashes(), first.hashes) << "the hash must see the least change";
}

TEST(Session, S6_repeats_after_fifty_other_trials_in_the_same_process) {
  const Drive drive(3);
  const std::vector<navvi_types::StateHash> first = drive.driven(kSteps).hashes;
  for (int trial = 0; trial < 50; ++trial) {
    Drive other = drive;
    other.config.seed = trial;
    other.world = setup::load_world(other.config).world;
    ASSERT_EQ(other.driven(100).hashes.size(), 2u);
  }
  EXPECT_EQ(drive.driven(kSteps).hashes, first);
}

TEST(Recipe, gives_start_and_goal_back_bit_for_bit) {
  const Drive drive(11);
  setup::SimNodeConfig again;
  navvi_config::read(again, YAML::Load(setup::recipe(drive.config, drive.scenario)), "the recipe");
  ASSERT_TRUE(again.start_pose() && again.goal_point());
  EXPECT_EQ(again.start_pose()->position, drive.scenario.start.position);
  EXPECT_EQ(again.start_pose()->yaw, drive.scenario.start.yaw);
  EXPECT_EQ(*again.goal_point(), drive.scenario.goal);
  EXPECT_EQ(world_hash(setup::load_world(again).world), world_hash(drive.world));
}

}  // namespace
}  // namespace navvi_sim::live
