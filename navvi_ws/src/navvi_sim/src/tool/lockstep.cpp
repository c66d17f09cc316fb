// lockstep PARAMETERS.yaml COMMANDS.csv SECONDS: plays a world with recorded commands as fast as it
// goes, and prints its state hash after each simulated second. No ROS, no clock.
// COMMANDS.csv: a line step,linear,angular,braking for each change; braking is 0 or 1.

#include <cmath>
#include <cstdio>
#include <exception>
#include <navvi_config/reader.hpp>
#include <navvi_files/files.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "navvi_sim/live/session.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"

namespace {

using namespace navvi_sim;

std::vector<live::AppliedCommand> read_commands(const std::string& path) {
  const auto content = navvi_files::read_file(path);
  if (!content) throw std::runtime_error("\"" + path + "\" cannot be read");
  std::istringstream file(*content);
  std::vector<live::AppliedCommand> commands;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    unsigned long long step = 0;
    live::AppliedCommand command;
    char braking = 0, rest = 0;
    const int found =
        std::sscanf(line.c_str(), "%llu,%lf,%lf,%c%c", &step, &command.velocity.linear,
                    &command.velocity.angular, &braking, &rest);
    command.step = step;
    command.braking = braking == '1' ? physics::Braking::emergency : physics::Braking::normal;
    if (found != 4 || (braking != '0' && braking != '1') ||
        !std::isfinite(command.velocity.linear) || !std::isfinite(command.velocity.angular) ||
        (!commands.empty() && command.step <= commands.back().step))
      throw std::runtime_error(path + ", line " + std::to_string(number) +
                               ": allowed is step,linear,angular,braking with rising steps, finite "
                               "numbers and braking 0 or 1");
    commands.push_back(command);
  }
  return commands;
}

double read_seconds(const std::string& text) {
  std::size_t used = 0;
  double seconds = -1.0;
  try {
    seconds = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  if (used != text.size() || !(seconds >= 0.0 && seconds <= 1e6))
    throw std::runtime_error("SECONDS is \"" + text + "\"; allowed is a number from 0 to 1000000");
  return seconds;
}

int play(const std::string& parameters, const std::string& commands, const std::string& seconds) {
  setup::SimNodeConfig config;
  navvi_config::read(config, navvi_config::load_yaml(parameters), parameters);
  const double duration = read_seconds(seconds);
  const std::vector<live::AppliedCommand> script = read_commands(commands);
  const WorldDescription world = setup::load_world(config).world;
  const scenario::StartAndGoal scenario =
      setup::scenario_of(config, world, setup::map_of(config, world));
  live::Session session(world, config.life, scenario.start,
                        static_cast<std::uint64_t>(config.seed));
  const auto steps = static_cast<std::uint64_t>(std::llround(duration / config.life.step));
  const live::World::Status status = live::replay(session, script, steps);
  for (const navvi_types::StateHash& state : session.hashes())
    std::printf("%llu %s\n", static_cast<unsigned long long>(state.step),
                navvi_types::to_hex(state.hash).c_str());
  if (status == live::World::Status::running) return 0;
  std::fprintf(stderr, "The world has stopped after step %llu: a number in it is not finite.\n",
               static_cast<unsigned long long>(session.steps()));
  return 3;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: lockstep PARAMETERS.yaml COMMANDS.csv SECONDS\n");
    return 2;
  }
  try {
    return play(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
