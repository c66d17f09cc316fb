#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "navvi_types/motion.hpp"
#include "navvi_types/names.hpp"

namespace navvi_types {

/// A part of the world that has a name, such as dock 2.
struct Place {
  enum class Kind : std::uint8_t { dock, aisle, cross_aisle, room };

  Kind kind = Kind::dock;
  std::uint32_t number = 0;                      ///< from 1, within its kind
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, in map: where a robot can stand in it
  Eigen::AlignedBox2d area = Eigen::AlignedBox2d(Eigen::Vector2d::Zero());  ///< m, in map
};

/// The task of a session: world, start and goal.
struct Scenario {
  std::string world = {};       ///< its name
  std::string world_hash = {};  ///< hexadecimal, of everything in it
  std::uint64_t seed = 0;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();  ///< m, in map
  Pose2 start = {};                                ///< base_link in map
  double floor = 0.0;                              ///< m, height of the floor in map
  std::vector<Place> places = {};
  std::string parameters = {};  ///< YAML, of sim_node
  std::int64_t stamp = 0;       ///< ns, ROS time
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

/// Hexadecimal. \param digits  at least
[[nodiscard]] inline std::string to_hex(std::uint64_t number, int digits = 16) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%0*" PRIx64, digits, number);
  return text.data();
}

}  // namespace navvi_types
