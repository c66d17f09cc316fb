#pragma once

#include <navvi_config/field.hpp>
#include <navvi_types/guidance.hpp>
#include <optional>
#include <set>
#include <vector>

#include "geometry.hpp"
#include "guide/conflict_forecast.hpp"

namespace navvi_nav::guide {

using navvi_types::Guidance;

/// Whether a person has asked a second time for a goal that was refused because the map does not
/// show it yet: then they are led toward it. Only a message with a newer stamp is a person's word:
/// who sends a goal again, as trial_node does, keeps its stamp, and a goal that nobody chose has 0.
/// Times and stamps are s of ROS time.
class SecondAsk {
 public:
  /// A goal is set. \returns true if it is to be led toward: it lies within 0.5 m of the one that
  /// was refused and is stamped later, or it is one for which that was so, sent again
  [[nodiscard]] bool agrees(Point goal, double stamp);
  /// A goal was refused: once more if the person had agreed to it.
  /// \param heard  the later one of its stamp and the time of the refusal
  void refused(Point goal, Guidance::Refusal why, double heard);
  void reset();

 private:
  struct Goal {
    Point place;
    double stamp = 0.0;
  };
  std::optional<Goal> refused_;  ///< stamp: that a second ask must be later than
  std::optional<Goal> agreed_;
};

struct ReplanTriggerConfig {
  double robot_radius = 0.35;  ///< m, set from the mesh's
  double period = 2.0;
  static constexpr double kSlowSpeed = 0.1;  ///< m/s, slower counts as too slow (R-NAV-9)
  static constexpr double kSlowTime = 1.0;  ///< s, how long the robot must be too slow
  double near_range = 3.0;
  static constexpr double kMinInterval = 0.5;  ///< s, least time between plans because of obstacles
  bool only_if_it_matters = true;

  void describe(navvi_config::Visitor& visit);
};

/// What the trigger looks at.
struct ReplanInput {
  double time = 0.0;         ///< s
  bool new_goal = false;     ///< not planned for yet
  bool map_changed = false;  ///< since the last plan
  bool cut_off = false;      ///< something stands between the robot and its path
  double speed = 0.0;        ///< m/s, forward
  Point robot;
  Path remaining;            ///< from the robot over the next way-point to the goal; may be empty
  double path_offset = 0.0;  ///< m, from the robot to its path
  bool closed = false;       ///< the path is known to be cut and there was no other
  std::vector<Cylinder> obstacles;
  Conflict conflict;        ///< with them on that path
  bool kept = false;        ///< the path is kept, whatever obstacles do
  bool evades = false;      ///< a path that avoids the conflict is wanted
  double worthwhile = 0.0;  ///< m, only a path shorter than this would replace a free one
};

/// Decides when to plan again, and why (R-NAV-9).
class ReplanTrigger {
 public:
  explicit ReplanTrigger(const ReplanTriggerConfig& config) : config_(config) {}

  /// The most telling reason to plan now, or none. A reason that is returned counts as acted on.
  [[nodiscard]] std::optional<Guidance::Replan> update(const ReplanInput& input);
  /// Forgets all times, after the clock jumped.
  void reset();

 private:
  [[nodiscard]] std::optional<Guidance::Replan> choose(const ReplanInput& input, bool slow);
  [[nodiscard]] bool is_slow(const ReplanInput& input);
  [[nodiscard]] bool note_near(const ReplanInput& input);
  [[nodiscard]] bool matters(const ReplanInput& input) const;
  [[nodiscard]] bool may_have_opened(const ReplanInput& input) const;

  ReplanTriggerConfig config_;
  std::vector<Cylinder> searched_;  // obstacles among which the last path was searched
  std::optional<double> last_plan_;
  std::optional<double> last_slow_;
  std::optional<double> slow_since_;
  std::set<std::uint32_t> near_;
  bool near_pending_ = false;
};

}  // namespace navvi_nav::guide
