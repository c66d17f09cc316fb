#pragma once

#include <optional>

#include "geometry.hpp"
#include "guide/path_follower.hpp"
#include "plan/plan_request.hpp"

namespace navvi_nav::guide {

/// m of the first 20 m of `old` from which `fresh` is more than half a metre away: the part of the
/// route that a person has to unlearn.
[[nodiscard]] double moved_length(const Path& old, const Path& fresh);

struct ActivePathConfig {
  PathFollowerConfig guidance;
  /// m, a robot farther off its path gets a new one at the next plan
  static constexpr double kOffPath = 1.0;

  void describe(navvi_config::Visitor& visit);
};

/// What the path that is followed is for.
enum class PathMode {
  to_goal,  ///< it leads to the goal and is free, as far as is known
  closed,   ///< it leads to the goal, only obstacles close it, and there is no other
  retreat,  ///< it leads out of the area that a thing will sweep
  waiting,  ///< it was a retreat or is closed, while the robot waits at the end of a retreat
};

/// The path that is followed, its mode, and how often it changed.
class ActivePath {
 public:
  explicit ActivePath(const ActivePathConfig& config)
      : config_(config), follower_(config.guidance) {}

  /// Follows a new path. \param plan  found, closed or retreat, which leaves ends_short() as it is
  /// \returns m of the path so far, if one was followed by a `robot` whose place is known, that the
  /// new one leaves
  double follow(const plan::Plan& plan, Guidance::Replan reason, std::optional<Point> robot);
  /// There is no path to follow.
  void drop() { follower_.follow({}); }
  /// A new goal, or none.
  void reset();

  void advance(Point robot, const map::Space& space) { follower_.advance(robot, space); }
  void set_mode(PathMode mode) { mode_ = mode; }
  [[nodiscard]] PathMode mode() const { return mode_; }
  /// True if only obstacles close the path to the goal, and there is no other.
  [[nodiscard]] bool closed() const {
    return mode_ == PathMode::closed || mode_ == PathMode::waiting;
  }
  /// True if the goal is not seen yet, and the path ends where the map does.
  [[nodiscard]] bool ends_short() const { return ends_short_; }
  [[nodiscard]] bool following() const { return follower_.following(); }
  [[nodiscard]] const PathFollower& follower() const { return follower_; }
  [[nodiscard]] Path remaining(Point robot) const { return follower_.remaining(robot); }
  /// m, from the robot to its path; 0 if there is none
  [[nodiscard]] double offset(Point robot) const;
  /// True if the robot needs a new path at the next plan. \pre following()
  [[nodiscard]] bool strayed(Point robot) const { return offset(robot) > config_.kOffPath; }
  /// True if the robot is at the goal, or where the path ends short of it.
  [[nodiscard]] bool arrived(Point robot, const map::Space& space) const;

  /// Fills in where the path leads. \pre following()
  void report(Guidance& out, const Pose2& robot, const map::Floor& floor, double pace) const;
  /// Fills in how often it changed, followed or not.
  void report_changes(Guidance& out) const;

 private:
  ActivePathConfig config_;
  PathFollower follower_;
  PathMode mode_ = PathMode::to_goal;
  bool leads_to_goal_ = true;
  bool ends_short_ = false;
  unsigned reroutes_ = 0;
  Guidance::Replan reroute_reason_ = Guidance::Replan::none;
  double shortest_length_ = 0.0;
};

}  // namespace navvi_nav::guide
