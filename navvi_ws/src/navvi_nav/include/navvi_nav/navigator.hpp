#pragma once

#include <memory>
#include <optional>
#include <string>

#include "navvi_nav/guidance.hpp"
#include "navvi_nav/octomap_reader.hpp"
#include "navvi_nav/planner.hpp"
#include "navvi_nav/replan_policy.hpp"

namespace navvi_nav {

struct NavigatorConfig {
  PlannerConfig planner;
  ReplanPolicyConfig replan;
  GuidanceConfig guidance;
  double carve_period = 0.5;
  double pose_timeout = 1.0;
  double obstacle_timeout = 1.0;
  double plan_timeout = 1.0;
  double off_path = 1.0;

  void describe(navvi_config::Visitor& visit);
};

/// A map as it came.
struct MapMessage {
  std::vector<std::int8_t> data;
  bool binary = true;
  std::string id;
  double resolution = 0.0;  ///< m
};

/// Work for whoever owns the Planner.
struct Job {
  std::shared_ptr<const MapMessage> map;  ///< null: keep the map
  std::vector<Cylinder> obstacles;
  std::optional<Point> goal;  ///< nullopt: no plan is wanted
  Point start;
  Reason reason = Reason::none;
  unsigned goal_number = 0;
  bool show_mesh = false;  ///< a picture of the mesh is wanted, too
};

/// A finished job.
struct Outcome {
  Reason reason = Reason::none;
  unsigned goal_number = 0;
  std::optional<Plan> plan;
  MeshUpdate mesh;    ///< by the new map, if one came
  MeshUpdate carved;  ///< by the obstacles
  bool map_taken = false;
  std::string map_error;                ///< a sentence if a map came and was refused
  std::size_t polygons = 0;             ///< of the mesh, empty slots included
  std::shared_ptr<const Mesh> navmesh;  ///< if it was to be shown
  std::shared_ptr<const Floor> floor;
  double seconds = 0.0;  ///< wall clock, filled in by the caller of work()
};

/// Does one job. No exception leaves it.
[[nodiscard]] Outcome work(Planner& planner, const Job& job);

/// Values as in navvi_msgs/Guidance.
enum class State {
  no_goal,
  following,
  arrived,
  goal_refused,
  no_route,
  off_mesh,
  no_map,
  pose_stale,
};

/// navvi_msgs/Guidance without ROS.
struct Status {
  State state = State::no_map;
  Refusal refusal = Refusal::none;
  Reason reason = Reason::none;
  unsigned plans = 0;
  double plan_time = 0.0;  ///< s
  std::size_t nodes_expanded = 0;
  Point goal;
  Heading heading;  ///< valid while following
  std::string detail;
};

/// What nav_node decides: which job comes next, which path is followed, what the person is told.
/// Times are s on one clock; after a jump back call reset_times().
class Navigator {
 public:
  explicit Navigator(const NavigatorConfig& config);

  void set_map(std::shared_ptr<const MapMessage> map) { new_map_ = std::move(map); }
  void set_obstacles(std::vector<Cylinder> obstacles, double time);
  void set_pose(const Pose& pose, double time);
  void set_speed(double forward) { speed_ = forward; }  ///< m/s
  /// A new goal replaces the old one. It is judged by the next plan.
  void set_goal(Point goal);
  /// A goal message that cannot even be read is dropped whole: a goal that stands stays. Only
  /// without one the refusal is told. \returns true if a goal stands
  bool drop_bad_goal(Refusal refusal, const std::string& detail);
  void reset_times();

  /// Brings everything up to `time`. \returns the next job, if one is due and none is running
  [[nodiscard]] std::optional<Job> update(double time);
  void deliver(const Outcome& outcome, double time);

  [[nodiscard]] Status status(double time) const;
  /// The path as planned; empty when there is none to show.
  [[nodiscard]] const Path& path() const { return guidance_.path(); }
  /// True while a first plan for a goal is on its way: nothing new can be said yet.
  [[nodiscard]] bool undecided(double time) const;
  /// True if the obstacles were given up as too old; cleared by the next ones.
  [[nodiscard]] bool obstacles_lost() const { return obstacles_lost_; }
  /// m, z of the floor in map; 0 before there is a map.
  [[nodiscard]] double floor_height() const { return floor_ ? floor_->height() : 0.0; }

 private:
  [[nodiscard]] bool pose_fresh(double time) const;
  [[nodiscard]] bool obstacles_fresh(double time) const;
  [[nodiscard]] Space space() const { return {floor_.get(), &obstacles_}; }
  [[nodiscard]] std::optional<Job> next_job(double time);
  void follow_progress(double time);
  void take_plan(const Plan& plan, Reason reason, double time);
  [[nodiscard]] bool keeps_path(const Plan& plan, Reason reason, double time);
  void drop_goal(State state);
  void refuse_goal(Refusal refusal, const std::string& detail);

  NavigatorConfig config_;
  ReplanPolicy policy_;
  Guidance guidance_;
  std::shared_ptr<const Floor> floor_;
  std::shared_ptr<const MapMessage> new_map_;
  std::vector<Cylinder> obstacles_;
  std::optional<double> obstacles_time_;  ///< nullopt: none came yet
  bool obstacles_lost_ = false;
  std::optional<Pose> pose_;
  double pose_time_ = 0.0;
  double speed_ = 0.0;
  std::optional<Point> goal_;
  Point last_goal_;
  unsigned goal_number_ = 0;
  bool goal_planned_ = false;
  bool map_changed_ = false;
  std::optional<double> job_since_;
  Reason job_reason_ = Reason::none;
  std::optional<double> carved_at_;
  State state_ = State::no_goal;
  Refusal refusal_ = Refusal::none;
  Reason reason_ = Reason::none;
  unsigned plans_ = 0;
  double plan_time_ = 0.0;
  std::size_t nodes_expanded_ = 0;
  std::string detail_;
};

}  // namespace navvi_nav
