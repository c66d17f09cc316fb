#include "navvi_sim/setup/sim_node_config.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <navvi_config/reader.hpp>
#include <navvi_config/writer.hpp>
#include <vector>

namespace navvi_sim::setup {
namespace {

/// The numbers of a list such as "1,-9,1.57".
std::vector<double> numbers(const std::string& list, std::size_t count, const std::string& key,
                            const std::string& form) {
  const bool plain = list.find_first_not_of("0123456789+-.,eE \t") == std::string::npos;
  try {
    const auto values = YAML::Load(plain ? "[" + list + "]" : "[]").as<std::vector<double>>();
    const bool finite = std::all_of(values.begin(), values.end(),
                                    [](double value) { return std::isfinite(value); });
    if (values.size() == count && finite && list.back() != ',') return values;
  } catch (const YAML::Exception&) {
  }
  throw navvi_config::ConfigError(key + ": \"" + list + "\" is not of the form " + form +
                                  " with finite numbers");
}

std::string exact(const std::vector<double>& values) {
  std::string list;
  for (const double value : values)
    list += (list.empty() ? "" : ",") + navvi_config::exact(value);
  return list;
}

/// Where there is such a file, or folder; else the word itself.
std::string absolute(const std::string& path, std::filesystem::file_type type) {
  std::error_code error;
  if (path.empty() || std::filesystem::status(path, error).type() != type) return path;
  return std::filesystem::absolute(path).lexically_normal().string();
}

occupancy::OccupancyConfig octomap_for_robot(const SimNodeConfig& config) {
  occupancy::OccupancyConfig octomap = config.octomap;
  octomap.underside = config.life.robot.clearance;
  return octomap;
}

}  // namespace

void SimNodeConfig::describe(navvi_config::Visitor& visit) {
  using namespace navvi_config;
  visit(world, "world", Any{}, "",
        "training, easy, warehouse, busy, narrow, maze, or the path of a .yaml, .sdf or .world "
        "file");
  visit(models, "models", Any{}, "",
        "folders for SDF's model://, separated by colons; those beside the world are always "
        "searched");
  visit(missing, "missing", navvi_config::OneOf{{"refuse", "leave_out"}}, "",
        "what to do with pieces of an SDF world that are missing or wrong: refuse the world, or "
        "read it without them");
  visit(classes, "classes", Any{}, "",
        "a YAML file of class rules for SDF's models; empty: navvi_sim's config/classes.yaml");
  visit(seed, "seed", Range{0, std::numeric_limits<int>::max()}, "",
        "draws the world's fill, the movers' pauses, and start and goal where not given");
  visit(start, "start", Any{}, "m, m, rad", "x,y,yaw of the robot; empty: drawn from the seed");
  visit(goal, "goal", Any{}, "m, m", "x,y of the goal; empty: drawn from the seed");
  visit(rate, "rate", Range{0.05, 50.0}, "", "simulated seconds per second of wall time");
  life.describe(visit);
  visit(workers, "workers", navvi_config::OneOf{{"standing", "walking", "both"}}, "",
        "whether all workers of a layout stand, all walk a route, or both as the layout says");
  visit.group("scenario", scenario);
  visit.group("octomap", octomap);
  visit.group("gate", gate);
  visit(sensing, "sensing", navvi_config::OneOf{{"truth", "lidar", "robot"}}, "",
        "the sensors of the robot: none, as the truth is told; a lidar; or a lidar and a depth "
        "camera");
  visit.group("lidar", lidar);
}

read::Workers SimNodeConfig::worker_choice() const {
  if (workers == "standing") return read::Workers::standing;
  return workers == "walking" ? read::Workers::walking : read::Workers::as_laid_out;
}

std::optional<Pose2> SimNodeConfig::start_pose() const {
  if (start.empty()) return std::nullopt;
  const auto values = numbers(start, 3, "start", "x,y,yaw");
  return Pose2{{values[0], values[1]}, values[2]};
}

std::optional<Eigen::Vector2d> SimNodeConfig::goal_point() const {
  if (goal.empty()) return std::nullopt;
  const auto values = numbers(goal, 2, "goal", "x,y");
  return Eigen::Vector2d(values[0], values[1]);
}

read::LoadedWorld load_world(const SimNodeConfig& config) {
  const bool all = config.missing != "leave_out";
  return read::load_world({config.world, config.models, static_cast<std::uint64_t>(config.seed),
                           config.worker_choice(), config.classes,
                           all ? read::Missing::refuse : read::Missing::leave_out});
}

occupancy::OccupancyMap map_of(const SimNodeConfig& config, const WorldDescription& world) {
  return occupancy::occupancy_of(world, octomap_for_robot(config));
}

navvi_floor::Voxels voxels_of(const SimNodeConfig& config, const WorldDescription& world) {
  return occupancy::voxels_of(world, octomap_for_robot(config));
}

scenario::StartAndGoal scenario_of(const SimNodeConfig& config, const WorldDescription& world,
                                   const navvi_floor::Voxels& voxels) {
  scenario::ScenarioConfig drawing = config.scenario;
  drawing.robot_radius = config.life.robot.radius;
  drawing.robot_height = config.life.robot.height;
  drawing.movers = config.life.movers;
  return scenario::draw_scenario(world, voxels, drawing, static_cast<std::uint64_t>(config.seed),
                                 config.start_pose(), config.goal_point());
}

std::string recipe(SimNodeConfig config, const scenario::StartAndGoal& scenario) {
  config.start =
      exact({scenario.start.position.x(), scenario.start.position.y(), scenario.start.yaw});
  config.goal = exact({scenario.goal.x(), scenario.goal.y()});
  for (std::string* path : {&config.world, &config.classes})
    *path = absolute(*path, std::filesystem::file_type::regular);
  std::string models;
  for (const std::filesystem::path& folder : read::folders(config.models))
    models += (models.empty() ? "" : ":") +
              absolute(folder.string(), std::filesystem::file_type::directory);
  config.models = models;
  return navvi_config::write(config);
}

}  // namespace navvi_sim::setup
