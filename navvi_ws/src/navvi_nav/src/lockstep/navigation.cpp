#include "navvi_nav/lockstep/navigation.hpp"

#include <utility>

#include "guide/cylinders.hpp"
#include "guide/navigator.hpp"
#include "guide/publish_throttle.hpp"
#include "plan/planner.hpp"

namespace navvi_nav::lockstep {

using guide::NavigatorConfig;

NavigationConfig::NavigationConfig() {
  NavigatorConfig values;
  values.planner.mesh.threads = 1;
  values_ = values;
}

void NavigationConfig::describe(navvi_config::Visitor& visit) {
  std::any_cast<NavigatorConfig&>(values_).describe(visit);
}

double NavigationConfig::robot_height() const {
  return std::any_cast<const NavigatorConfig&>(values_).planner.mesh.robot_height;
}

struct Navigation::Parts {
  Parts(const NavigatorConfig& config, const navvi_files::Cache* cache)
      : navigator(config), planner(config.planner, cache) {}

  guide::Navigator navigator;
  plan::Planner planner;
  std::optional<plan::PlanAnswer> answer = {};  ///< to the request of the last beat
  guide::PublishThrottle throttle = {};
  std::uint32_t published = 0;
  std::string map_error = {};
};

Navigation::Navigation(const NavigationConfig& config, const navvi_files::Cache* cache)
    : parts_(
          std::make_unique<Parts>(std::any_cast<const NavigatorConfig&>(config.values_), cache)) {}
Navigation::~Navigation() = default;

void Navigation::set_map(navvi_floor::Voxels voxels) {
  parts_->navigator.set_map(std::make_shared<const plan::MapMessage>(
      plan::MapMessage{{}, true, {}, 0.0, std::move(voxels)}));
}

void Navigation::set_map(std::vector<std::int8_t> data, const std::string& id, double resolution) {
  parts_->navigator.set_map(std::make_shared<const plan::MapMessage>(
      plan::MapMessage{std::move(data), true, id, resolution}));
}

void Navigation::set_obstacles(const navvi_types::Obstacles& obstacles, double time) {
  parts_->navigator.set_obstacles(obstacles.things, time);
}

void Navigation::set_pose(const navvi_types::Pose2& pose, double height, double time) {
  parts_->navigator.set_pose(pose, height, time);
}

void Navigation::set_velocity(const navvi_types::Velocity& velocity) {
  parts_->navigator.set_velocity(velocity);
}

void Navigation::set_foresight(double ahead) {
  parts_->navigator.set_foresight(ahead);
}

void Navigation::set_goal(const Eigen::Vector2d& goal) { parts_->navigator.set_goal(goal); }

bool Navigation::has_map() const { return parts_->navigator.has_map(); }

const std::string& Navigation::map_error() const { return parts_->map_error; }

std::vector<Eigen::Vector2d> Navigation::path() const {
  return guide::to_vectors(parts_->navigator.path());
}

std::optional<navvi_types::ZoneState> Navigation::zone(double time) const {
  return parts_->navigator.zone(time);
}

bool Navigation::plan_waits() const { return parts_->answer.has_value(); }

std::optional<navvi_types::Guidance> Navigation::update(double time) {
  guide::Navigator& navigator = parts_->navigator;
  if (const auto answer = std::exchange(parts_->answer, std::nullopt)) {
    if (answer->map_taken || !answer->map_error.empty()) parts_->map_error = answer->map_error;
    navigator.deliver(*answer, time);
  }
  if (const auto request = navigator.update(time))
    parts_->answer = parts_->planner.answer(*request);
  if (navigator.undecided(time)) return std::nullopt;
  navvi_types::Guidance guidance = navigator.guidance(time);
  if (!parts_->throttle.due(guidance, time)) return std::nullopt;
  guidance.seq = ++parts_->published;
  return guidance;
}

}  // namespace navvi_nav::lockstep
