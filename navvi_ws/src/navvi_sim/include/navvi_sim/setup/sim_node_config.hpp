#pragma once

#include <navvi_config/field.hpp>
#include <navvi_safety/command_gate.hpp>
#include <optional>
#include <string>

#include "navvi_sim/live/world.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/read/world_source.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "navvi_sim/sensors/sensors.hpp"

namespace navvi_sim::setup {

/// Everything that can be chosen of sim_node.
struct SimNodeConfig {
  std::string world = "warehouse";
  std::string models;
  std::string missing = "refuse";  ///< of SDF: read::Missing
  std::string classes;
  int seed = 1;
  std::string start;              ///< "x,y,yaw" in m and rad; empty: drawn from the seed
  std::string goal;               ///< "x,y" in m; empty: drawn from the seed
  double rate = 1.0;              ///< simulated seconds per second
  double detection_radius = 5.0;  ///< m, gap up to which things are reported as near
  live::WorldConfig life;
  std::string workers = "both";  ///< of layouts: standing, walking, or both as laid out
  scenario::ScenarioConfig scenario;
  occupancy::OccupancyConfig octomap;
  navvi_safety::CommandGateConfig gate;
  std::string sensing = "truth";  ///< truth, lidar, or robot: what NavVI gets of the world
  sensors::LidarConfig lidar;
  sensors::CameraConfig camera;

  /// The gate is quicker than it must be, so that the wheels stand still, and do not just begin
  /// to brake, within 250 ms of the last command.
  SimNodeConfig() { gate.timeout = 0.20; }

  void describe(navvi_config::Visitor& visit);

  [[nodiscard]] read::Workers worker_choice() const;
  /// nullopt where nothing is given.
  /// \throws navvi_config::ConfigError with a sentence if it is not three finite numbers
  [[nodiscard]] std::optional<Pose2> start_pose() const;
  /// nullopt where nothing is given.
  /// \throws navvi_config::ConfigError with a sentence if it is not two finite numbers
  [[nodiscard]] std::optional<Eigen::Vector2d> goal_point() const;
};

/// The world that `config` names. \throws WorldError with a sentence
[[nodiscard]] read::LoadedWorld load_world(const SimNodeConfig& config);

/// The map of `world` for this robot. \throws WorldError with a sentence
[[nodiscard]] occupancy::OccupancyMap map_of(const SimNodeConfig& config,
                                             const WorldDescription& world);
/// What navigation reads of that map.
[[nodiscard]] navvi_floor::Voxels voxels_of(const SimNodeConfig& config,
                                            const WorldDescription& world);

/// Start and goal: as given, and drawn from the seed where they are not.
/// \param voxels  by voxels_of
/// \throws ConfigError or WorldError with a sentence
[[nodiscard]] scenario::StartAndGoal scenario_of(const SimNodeConfig& config,
                                                 const WorldDescription& world,
                                                 const navvi_floor::Voxels& voxels);

/// Every parameter as YAML, with the scenario's start and goal written exactly and the world's path
/// absolute: with them the same world is played again, and nothing is drawn.
[[nodiscard]] std::string recipe(SimNodeConfig config, const scenario::StartAndGoal& scenario);

}  // namespace navvi_sim::setup
