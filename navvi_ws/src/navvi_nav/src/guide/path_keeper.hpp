#pragma once

#include <navvi_config/field.hpp>
#include <optional>

#include "guide/active_path.hpp"
#include "guide/conflict_forecast.hpp"
#include "plan/plan_request.hpp"

namespace navvi_nav::guide {

struct PathKeeperConfig {
  double gain = 0.1;
  double gain_length = 0.5;
  double gain_back = 4.0;
  double hold_time = 8.0;
  /// s, a path chosen because of moving things is kept so long at least, if no collision is
  /// forecast within as long, or none a second later on the one that was found since
  static constexpr double kHoldChoice = 3.0;
  double hold_detour = 6.0;  ///< m, longest detour around a moving thing while the path may be kept
  /// m, nearer than this the robot waits for a thing that crosses or closes the only way
  static constexpr double kWaitDistance = 3.0;

  void describe(navvi_config::Visitor& visit);
};

/// Replan hysteresis: decides whether the robot keeps its path, and whether it waits on it. A
/// person is not sent another way, and least of all back, because something passes by.
class PathKeeper {
 public:
  explicit PathKeeper(const PathKeeperConfig& config) : config_(config) {}

  /// Call it on every tick. \returns true to keep the path without a search: no obstacle that cuts
  /// it will hit the robot, or all leave it soon and have not closed it for hold_time, or the first
  /// one comes but is not met within 4 s
  [[nodiscard]] bool update(double time, const Conflict& conflict);

  struct Candidate {
    Path path;  ///< empty: none
    Conflict conflict;
  };
  struct Choice {
    double time = 0.0;  ///< s
    Guidance::Replan reason = Guidance::Replan::none;
    PathMode mode = PathMode::to_goal;  ///< of the path that is followed
    plan::PlanStatus found = plan::PlanStatus::no_route;
    Candidate followed;          ///< the rest of it, from the robot
    Candidate fresh;             ///< found by the search
    bool strayed = false;        ///< the robot is off its path
    bool sees_waypoint = false;  ///< no wall stands between the robot and its next way-point
    bool way_is_free = false;    ///< nor does an obstacle on the first metres of that way
  };
  /// Call it after every search while a path is followed. \returns true to keep that path. It is
  /// kept, too, while only an obstacle far ahead closes it, or a moving one that would make the
  /// person turn back or go a long way round: it may have left by then. A free path is left for one
  /// that is shorter by `gain`, or on which something is hit a second later.
  [[nodiscard]] bool decide(const Choice& choice);
  /// A path was chosen now because of obstacles.
  void chose(double time) { chosen_ = time; }
  void reset();

  /// What crosses right in front of the robot and is waited for. As of the last update.
  [[nodiscard]] std::optional<Blocker> waits_for() const { return wait_; }
  /// What closes the only path, if that is near or oncoming.
  [[nodiscard]] std::optional<Blocker> blocker(const std::optional<Conflict::Cut>& cut,
                                               Conflict::State state) const;
  /// True if a search should look for a path that avoids the conflict.
  [[nodiscard]] bool evades(const Conflict& conflict) const;
  /// False if every plan is taken.
  [[nodiscard]] bool holds_paths() const { return config_.hold_time > 0.0; }
  /// m, a new path must be shorter to replace a free one that is `followed` m long
  [[nodiscard]] double worthwhile(double followed) const {
    return followed * (1.0 - config_.gain) - config_.gain_length;
  }
  /// True if `fresh` is shorter by enough.
  [[nodiscard]] bool shorter(const Path& followed, const Path& fresh) const;
  /// True if the robot should wait for a moving thing right in front of it.
  [[nodiscard]] bool must_wait(const Conflict& conflict) const;

 private:
  [[nodiscard]] bool holds(double time, const Candidate& followed, const Candidate& fresh);
  [[nodiscard]] bool is_near(double at) const { return at <= config_.kWaitDistance; }
  [[nodiscard]] bool waits_safely(const Conflict& conflict) const;
  /// True if nothing that cuts the path hits a robot that drives on or waits, or it is still far.
  [[nodiscard]] bool goes_on_safely(const Conflict& conflict);
  [[nodiscard]] bool goes_on(double time, bool held);

  PathKeeperConfig config_;
  std::optional<double> since_;   // s, when something began to cut the path that is kept
  std::optional<double> chosen_;  // s
  std::optional<Blocker> wait_;
  double wait_time_ = 0.0;  // s, when it was last seen
};

}  // namespace navvi_nav::guide
