#pragma once

#include <Eigen/Core>
#include <any>
#include <memory>
#include <navvi_config/field.hpp>
#include <navvi_files/cache.hpp>
#include <navvi_floor/octomap_reader.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/zone.hpp>
#include <optional>
#include <string>
#include <vector>

namespace navvi_nav::lockstep {

/// The parameters of nav_node's core.
class NavigationConfig {
 public:
  NavigationConfig();

  void describe(navvi_config::Visitor& visit);
  /// m, with its load: what begins higher over the floor does not matter
  [[nodiscard]] double robot_height() const;

 private:
  friend class Navigation;
  std::any values_;  ///< guide::NavigatorConfig
};

/// The core of nav_node without threads and without a clock: a plan is there at the next beat,
/// which follows soon on the one that asked for it. The same values give the same guidance, bit for
/// bit. Times are s on one clock that only goes forward; places are m, in map.
class Navigation {
 public:
  /// \param cache  of meshes of first maps, which must last as long; nullptr: none is kept
  explicit Navigation(const NavigationConfig& config, const navvi_files::Cache* cache = nullptr);
  ~Navigation();

  /// What an OctoMap would show.
  void set_map(navvi_floor::Voxels voxels);
  /// \param data  of a binary OctoMap message, as are `id` and `resolution`, m
  void set_map(std::vector<std::int8_t> data, const std::string& id, double resolution);
  void set_obstacles(const navvi_types::Obstacles& obstacles, double time);
  /// \param height  m, z of base_link, which is on the floor. The map is taken only when it is
  ///                known: it tells which of the map's levels is the floor.
  void set_pose(const navvi_types::Pose2& pose, double height, double time);
  void set_velocity(const navvi_types::Velocity& velocity);
  /// \param ahead  s, by which guidance is ahead of the robot
  void set_foresight(double ahead);
  /// A new goal replaces the old one. It is judged by the next plan.
  void set_goal(const Eigen::Vector2d& goal);
  [[nodiscard]] bool has_map() const;
  /// A sentence if the last map was rejected, else empty.
  [[nodiscard]] const std::string& map_error() const;
  /// From where the robot was when it was planned to the goal; empty if none is followed.
  [[nodiscard]] std::vector<Eigen::Vector2d> path() const;

  /// What zones allow the robot; nullopt without any.
  [[nodiscard]] std::optional<navvi_types::ZoneState> zone(double time) const;

  /// True if a plan waits for the next beat, which is then due at once.
  [[nodiscard]] bool plan_waits() const;
  /// One beat. \returns the guidance if it is to be published now, numbered, without a stamp
  [[nodiscard]] std::optional<navvi_types::Guidance> update(double time);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace navvi_nav::lockstep
