#pragma once

#include <navvi_perception/see/perception.hpp>
#include <navvi_sim/live/session.hpp>
#include <navvi_sim/occupancy/occupancy_map.hpp>
#include <navvi_sim/setup/sim_node_config.hpp>
#include <optional>
#include <vector>

namespace navvi_people::loop {

/// What a robot's own sensors tell of the world, as perception_node tells it: sim_node's sensors, a
/// prior map as a lidar would have made it, and a bumper. Where the robot is, is true.
class RobotSenses {
 public:
  RobotSenses(const navvi_sim::setup::SimNodeConfig& config,
              const navvi_perception::see::PerceptionConfig& perception,
              const navvi_sim::WorldDescription& world,
              const navvi_sim::occupancy::OccupancyMap& map);

  /// What is new after a step; nullopt or empty what is not due.
  struct News {
    std::optional<navvi_types::Obstacles> obstacles;
    std::optional<navvi_types::Proximity> proximity;
    std::optional<std::vector<std::int8_t>> map;  ///< a binary OcTree
    std::vector<navvi_types::Contact> contacts;
  };
  [[nodiscard]] News look(const navvi_sim::live::Session& session);

  [[nodiscard]] double resolution() const { return resolution_; }  ///< m, of the map
  /// The last of the lidar, with what it truly met.
  [[nodiscard]] const navvi_sim::sensors::Reading& scan() const { return scan_; }

 private:
  double resolution_;
  navvi_sim::sensors::Sensors sensors_;
  std::vector<navvi_sim::sensors::Sensor> mounted_;
  navvi_perception::see::Perception perception_;
  navvi_sim::sensors::Reading scan_;
  std::uint32_t bumps_ = 0;
};

}  // namespace navvi_people::loop
