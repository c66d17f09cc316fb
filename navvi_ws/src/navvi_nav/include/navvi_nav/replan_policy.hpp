#pragma once

#include <navvi_config/field.hpp>
#include <optional>
#include <set>
#include <vector>

#include "navvi_nav/geometry.hpp"

namespace navvi_nav {

/// Why a plan was made; values as in navvi_msgs/Guidance.
enum class Reason {
  none,
  new_goal,
  path_carved,
  too_slow,
  period,
  waypoint_blocked,
  obstacle_near,
  map_changed,
};

struct ReplanPolicyConfig {
  double period = 2.0;
  double slow_speed = 0.1;
  double slow_time = 1.0;
  double near_range = 3.0;
  double min_interval = 0.5;
  double robot_radius = 0.35;  ///< m, set from the mesh's
  double tolerance = 0.05;
  double look_ahead = 12.0;
  double gain = 0.1;
  double gain_length = 0.5;
  double hold_time = 4.0;
  double hold_distance = 3.0;

  void describe(navvi_config::Visitor& visit);
};

/// What the policy looks at.
struct ReplanInput {
  double time = 0.0;  ///< s
  bool has_goal = false;
  bool new_goal = false;     ///< not planned for yet
  bool map_changed = false;  ///< since the last plan
  double speed = 0.0;        ///< m/s, forward
  Pose robot;
  Path remaining;  ///< from the robot over the next way-point to the goal; may be empty
  std::vector<Cylinder> obstacles;
};

/// Says when to plan again, and why (R-NAV-9).
class ReplanPolicy {
 public:
  explicit ReplanPolicy(const ReplanPolicyConfig& config) : config_(config) {}

  /// The most telling reason to plan now, or none. A reason that is returned counts as acted on.
  [[nodiscard]] std::optional<Reason> update(const ReplanInput& input);
  /// Forgets all times, after the clock jumped.
  void reset();
  /// False if the path that is being followed should stay: the new one is not shorter by enough.
  [[nodiscard]] bool worth_changing(Reason reason, double followed, double fresh) const;
  /// True if the path that is followed should stay although moving things cut it: they do so only
  /// beyond hold_distance, `fresh` (empty: no route) is a detour or leads back, and that has not
  /// gone on for hold_time. Ask for every plan: it remembers since when.
  [[nodiscard]] bool holds(double time, const Path& followed, const Path& fresh,
                           const std::vector<Cylinder>& obstacles);
  /// True if a robot on some point of the first `look_ahead` m would touch a cylinder.
  [[nodiscard]] bool blocked(const Path& path, const std::vector<Cylinder>& obstacles) const;

 private:
  [[nodiscard]] std::optional<Reason> choose(const ReplanInput& input, bool slow,
                                             bool fresh_near) const;

  /// m along the path to where a robot on it would touch, within look_ahead; nullopt: nowhere.
  [[nodiscard]] std::optional<double> cut_at(const Path& path, const Cylinder& obstacle) const;
  [[nodiscard]] bool may_clear(const Path& path, const std::vector<Cylinder>& obstacles) const;

  ReplanPolicyConfig config_;
  std::optional<double> last_plan_;
  std::optional<double> last_slow_;
  std::optional<double> slow_since_;
  std::optional<double> held_since_;
  std::set<std::uint32_t> near_;
  bool near_pending_ = false;
};

}  // namespace navvi_nav
