#include "recount/repetition.hpp"

#include <navvi_msgs/Scenario.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <navvi_config/reader.hpp>
#include <navvi_sim/node/msg_conversion.hpp>
#include <navvi_sim/setup/sim_node_config.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <stdexcept>

#include "recount/bag_message.hpp"

namespace navvi_study::recount {
namespace {

template <typename Message, typename Take>
void for_each(const rosbag::Bag& bag, const Take& take) {
  const std::string type = ros::message_traits::datatype<Message>();
  for (const auto& item : rosbag::View(bag, rosbag::TypeQuery(type))) {
    if (const auto msg = message_of<Message>(item)) take(*msg);
  }
}

}  // namespace

RecordedSession session_in_bag(const std::filesystem::path& path) {
  rosbag::Bag bag;
  bag.open(path.string(), rosbag::bagmode::Read);
  RecordedSession session;
  for_each<navvi_msgs::Scenario>(bag, [&](const navvi_msgs::Scenario& msg) {
    session.parameters = msg.parameters;
    session.world_hash = msg.world_hash;
  });
  if (session.parameters.empty())
    throw std::runtime_error("the bag does not hold what sim_node was started with");
  for_each<navvi_msgs::AppliedCommands>(bag, [&](const navvi_msgs::AppliedCommands& msg) {
    if (!navvi_sim::node::append(msg, session.commands))
      throw std::runtime_error("the bag lacks commands after number " +
                               std::to_string(session.commands.size()));
  });
  for_each<navvi_msgs::StateHash>(bag, [&](const navvi_msgs::StateHash& msg) {
    const auto state = navvi_types::from_msg(msg);
    if (!state) throw std::runtime_error("a state in the bag has no hash");
    if (!session.states.empty() && state->step <= session.states.back().step)
      throw std::runtime_error("the simulator was started anew while the bag was open");
    session.states.push_back(*state);
  });
  if (session.states.empty()) throw std::runtime_error("the bag holds no state of the world");
  return session;
}

RepeatedWorld world_of(const RecordedSession& recorded) {
  navvi_sim::setup::SimNodeConfig config;
  navvi_config::read(config, YAML::Load(recorded.parameters), "the recorded parameters",
                     navvi_config::Removed::ignored);
  navvi_sim::WorldDescription world = navvi_sim::setup::load_world(config).world;
  if (navvi_sim::world_hash(world) != recorded.world_hash)
    throw std::runtime_error("the world \"" + config.world +
                             "\" is no longer the one that was recorded: its hash is " +
                             navvi_sim::world_hash(world) + ", and was " + recorded.world_hash);
  const auto start = config.start_pose();
  if (!start) throw std::runtime_error("the recorded parameters do not say where the robot began");
  return {
      navvi_sim::live::Session(world, config.life, *start, static_cast<std::uint64_t>(config.seed)),
      std::move(world), config.life};
}

std::string first_difference(const RecordedSession& recorded) {
  RepeatedWorld world = world_of(recorded);
  navvi_sim::live::Session& session = world.session;
  double equal_until = -1.0;
  for (const navvi_types::StateHash& state : recorded.states) {
    if (navvi_sim::live::replay(session, recorded.commands, state.step) !=
        navvi_sim::live::World::Status::running)
      return "The repetition stopped after step " + std::to_string(session.steps()) + ".";
    const double time = session.world().now().time;
    const std::uint64_t hash = session.world().state_hash();
    if (hash != state.hash) {
      std::string text = "They differ at " + std::to_string(time) + " s: the record says " +
                         navvi_types::to_hex(state.hash) + ", the repetition " +
                         navvi_types::to_hex(hash);
      return text + (equal_until < 0.0 ? ". No recorded state was equal."
                                       : "; equal up to " + std::to_string(equal_until) + " s.");
    }
    equal_until = time;
  }
  return "";
}

}  // namespace navvi_study::recount
