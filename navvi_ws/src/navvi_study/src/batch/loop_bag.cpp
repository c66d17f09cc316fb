#include "batch/loop_bag.hpp"

#include <navvi_msgs/AppliedCommands.h>
#include <navvi_msgs/Scenario.h>
#include <navvi_msgs/StateHash.h>
#include <navvi_msgs/TrialEvent.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <navvi_sim/description/world_hash.hpp>
#include <navvi_sim/node/msg_conversion.hpp>
#include <navvi_sim/setup/sim_node_config.hpp>

#include "node/msg_conversion.hpp"

namespace navvi_study::batch {

namespace people = navvi_people::people;

navvi_types::Scenario LoopBag::scenario_of(const navvi_people::loop::ClosedLoop& loop) {
  const navvi_sim::setup::SimNodeConfig& sim = loop.config().sim;
  navvi_types::Scenario scenario;
  scenario.world = loop.world().name;
  scenario.world_hash = navvi_sim::world_hash(loop.world());
  scenario.seed = static_cast<std::uint64_t>(sim.seed);
  scenario.goal = loop.scenario().goal;
  scenario.start = loop.scenario().start;
  scenario.floor = loop.world().floor_height;
  scenario.parameters = navvi_sim::setup::recipe(sim, loop.scenario());
  return scenario;
}

LoopBag::LoopBag(const std::filesystem::path& path, const navvi_people::loop::ClosedLoop& loop)
    : loop_(loop), bag_(path.string(), rosbag::bagmode::Write) {
  bag_.setCompression(rosbag::compression::LZ4);
  bag_.write("/navvi/scenario", ros::TIME_MIN, navvi_types::to_msg(scenario_of(loop)));
}

template <typename Message>
void LoopBag::write(const char* topic, const Message& message) {
  bag_.write(topic, ros::Time(loop_.time()), message);
}

void LoopBag::watch(const std::vector<record::Row>& rows) {
  const auto& told = loop_.told();
  const navvi_sim::live::Session& session = loop_.session();
  write("/odom", told.odometry);
  if (loop_.config().sim.life.robot.imperfections.odometry_drifts()) {
    tf2_msgs::TFMessage frames;
    frames.transforms = {navvi_sim::node::odom_msg(session.world().now())};
    write("/tf", frames);
  }
  for (const auto& contact : told.contacts) write("/navvi/contacts", contact);
  if (told.proximity) write("/navvi/proximity", *told.proximity);
  if (told.obstacles) write("/navvi/obstacles", *told.obstacles);
  if (told.guidance) write("/navvi/guidance", *told.guidance);
  for (const auto& cue : told.cues) write("/navvi/cues", cue);
  const int drive = 256 * told.drive.state + told.drive.reason;
  if (drive != drive_) write("/navvi/drive_state", told.drive);
  drive_ = drive;
  const people::StickAndButtons& hand = loop_.hand();
  sensor_msgs::Joy joy;
  joy.header.stamp = ros::Time(loop_.time());
  joy.axes = {static_cast<float>(hand.left), static_cast<float>(hand.forward)};
  joy.buttons = {hand.repeat ? 1 : 0};
  write("/joy", joy);
  for (; hashes_ < session.hashes().size(); ++hashes_)
    write("/navvi/state_hash", navvi_types::to_msg(session.hashes()[hashes_]));
  if (commands_ < session.commands().size()) {
    write("/navvi/applied_commands",
          navvi_sim::node::applied_commands_msg(session.commands(), commands_,
                                                ros::Time(loop_.time())));
    commands_ = session.commands().size();
  }
  for (const record::Row& row : rows) write("/navvi/events", node::to_msg(row));
}

}  // namespace navvi_study::batch
