#pragma once

#include <navvi_config/field.hpp>
#include <navvi_safety/command_gate.hpp>
#include <optional>
#include <string>

#include "navvi_sim/occupancy.hpp"
#include "navvi_sim/scenario.hpp"
#include "navvi_sim/warehouse.hpp"
#include "navvi_sim/world.hpp"

namespace navvi_sim {

/// Everything that can be chosen of sim_node.
struct SimNodeConfig {
  std::string world = "warehouse";
  std::string models;
  int seed = 1;
  std::string start;              ///< "x,y,yaw" in m and rad; empty: drawn from the seed
  std::string goal;               ///< "x,y" in m; empty: drawn from the seed
  double rate = 1.0;              ///< simulated seconds per second
  int max_catch_up = 10;          ///< steps at once, then the simulation slows down
  double detection_radius = 5.0;  ///< m
  WorldConfig life;
  WarehouseConfig warehouse;
  OccupancyConfig octomap;
  navvi_safety::CommandGateConfig gate;

  /// The gate is quicker than it must be, so that the wheels stand still, and are not just told
  /// to, within 250 ms of the last command.
  SimNodeConfig() { gate.timeout = 0.20; }

  void describe(navvi_config::Visitor& visit);

  /// nullopt where nothing is given.
  /// \throws navvi_config::ConfigError with a sentence if it is not three finite numbers
  [[nodiscard]] std::optional<FloorPose> start_pose() const;
  /// nullopt where nothing is given.
  /// \throws navvi_config::ConfigError with a sentence if it is not two finite numbers
  [[nodiscard]] std::optional<Eigen::Vector2d> goal_point() const;
};

}  // namespace navvi_sim
