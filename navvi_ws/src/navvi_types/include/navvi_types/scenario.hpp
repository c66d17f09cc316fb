#pragma once

#include <cstdint>
#include <string>

#include "navvi_types/motion.hpp"

namespace navvi_types {

/// The task of a session: world, start and goal.
struct Scenario {
  std::string world = {};       ///< its name
  std::string world_hash = {};  ///< hexadecimal, of everything in it
  std::uint64_t seed = 0;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();  ///< m, in map
  Pose2 start = {};                                ///< base_link in map
  double floor = 0.0;                              ///< m, height of the floor in map
  std::string parameters = {};                     ///< YAML, of sim_node
  std::int64_t stamp = 0;                          ///< ns, ROS time
};

/// The state of the world after so many steps, by which a repetition is compared.
struct StateHash {
  std::int64_t stamp = 0;  ///< ns, ROS time
  std::uint64_t step = 0;
  std::uint64_t hash = 0;  ///< over every state so far

  /// Whenever the two were published.
  [[nodiscard]] bool operator==(const StateHash& other) const {
    return step == other.step && hash == other.hash;
  }
};

/// 16 hexadecimal digits.
[[nodiscard]] std::string to_hex(std::uint64_t number);

}  // namespace navvi_types
