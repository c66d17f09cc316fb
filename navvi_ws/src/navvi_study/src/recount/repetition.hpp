#pragma once

#include <filesystem>
#include <navvi_sim/live/session.hpp>
#include <string>
#include <vector>

namespace navvi_study::recount {

/// What a bag holds of a simulated session, from the world's first step on.
struct RecordedSession {
  std::string parameters;  ///< YAML, of sim_node
  std::string world_hash;
  std::vector<navvi_sim::live::AppliedCommand> commands;
  std::vector<navvi_types::StateHash> states;  ///< one each second while the bag was open
};

/// \throws std::runtime_error with a sentence on what the bag lacks. Rosbag's reader can crash on a
/// damaged file: call this in a child process.
[[nodiscard]] RecordedSession session_in_bag(const std::filesystem::path& bag);

/// The recorded world, built anew as it was before its first step.
struct RepeatedWorld {
  navvi_sim::live::Session session;
  navvi_sim::WorldDescription description;
  navvi_sim::live::WorldConfig config;
};
/// \throws std::runtime_error with a sentence if the world cannot be built as it was
[[nodiscard]] RepeatedWorld world_of(const RecordedSession& recorded);

/// Builds the recorded world anew, steps it with the recorded commands, and compares each recorded
/// state. \return empty if all are equal, or a sentence on where they first differ
/// \throws std::runtime_error with a sentence if the world cannot be built as it was
[[nodiscard]] std::string first_difference(const RecordedSession& recorded);

}  // namespace navvi_study::recount
