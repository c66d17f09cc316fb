#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "navvi_nav/course.hpp"
#include "navvi_nav/pace.hpp"
#include "navvi_nav/planner.hpp"

namespace navvi_nav {

struct NavigatorConfig {
  PlannerConfig planner;
  ReplanPolicyConfig replan;
  CourseConfig course;
  int most_cylinders = 4;
  double carve_period = 0.5;
  double pose_timeout = 1.0;
  double obstacle_timeout = 1.0;
  double plan_timeout = 1.0;
  double map_timeout = 0.0;

  void describe(navvi_config::Visitor& visit);
};

/// What nav_node decides: what the planner does next, which path is followed, what the person is
/// told. Times are s on one clock; after a jump back call reset_times().
class Navigator {
 public:
  explicit Navigator(const NavigatorConfig& config);

  void set_map(std::shared_ptr<const MapMessage> map);
  /// A map for who has no OctoMap. \returns false if it is ignored because an OctoMap came before
  bool set_map(std::shared_ptr<const OccupancyGrid> grid);
  void set_obstacles(const std::vector<MovingThing>& things, double time);
  void set_pose(const Pose& pose, double time);
  void set_speed(double forward) { speed_ = forward; }  ///< m/s
  /// A new goal replaces the old one. It is judged by the next plan.
  void set_goal(Point goal);
  /// A goal message that cannot even be read is dropped whole: a goal that stands stays. Only
  /// without one the refusal is told. \returns true if a goal stands
  bool drop_bad_goal(Refusal refusal, const std::string& detail);
  void reset_times();

  /// Brings everything up to `time`. \returns the next request, if one is due and none is running
  [[nodiscard]] std::optional<PlanRequest> update(double time);
  void deliver(const PlanAnswer& answer, double time);

  [[nodiscard]] Status status(double time) const;
  /// The path as planned; empty when there is none to show.
  [[nodiscard]] const Path& path() const { return course_.guidance().path(); }
  /// True while a first plan for a goal is on its way: nothing new can be said yet.
  [[nodiscard]] bool undecided(double time) const;
  /// Where the robot is; nullopt without a fresh pose.
  [[nodiscard]] std::optional<Pose> pose(double time) const {
    return pose_fresh(time) ? pose_ : std::nullopt;
  }
  [[nodiscard]] bool has_map() const { return floor_ != nullptr; }
  /// True if the obstacles were given up as too old; cleared by the next ones.
  [[nodiscard]] bool obstacles_lost() const { return obstacles_lost_; }
  /// m, z of the floor in map; 0 before there is a map.
  [[nodiscard]] double floor_height() const { return floor_ ? floor_->height() : 0.0; }

 private:
  [[nodiscard]] bool pose_fresh(double time) const;
  [[nodiscard]] bool map_stale(double time) const;
  [[nodiscard]] bool obstacles_fresh(double time) const;
  [[nodiscard]] Scene scene(double time, const std::optional<Pose>& robot) const {
    return {time, robot, pace_.value(), floor_.get(), things_, obstacles_};
  }
  [[nodiscard]] std::optional<PlanRequest> next_request(double time);
  void follow_progress(double time);
  void give_up_late_plan(double time);
  void take_plan(const Plan& plan, Reason reason, double time);
  void drop_goal(State state);
  void refuse_goal(Refusal refusal, const std::string& detail);

  NavigatorConfig config_;
  ReplanPolicy policy_;
  Course course_;
  std::shared_ptr<const Floor> floor_;
  std::shared_ptr<const MapMessage> new_map_;
  std::shared_ptr<const OccupancyGrid> new_grid_;
  bool octomap_came_ = false;
  std::optional<double> map_time_;   ///< s, when the map in use came
  std::optional<double> mesh_time_;  ///< s, as of which the mesh shows what moves
  std::vector<MovingThing> things_;
  std::map<std::uint32_t, double> moved_;  ///< s, when each was last seen to move
  std::vector<Cylinder> obstacles_;        ///< the same things
  std::optional<double> obstacles_time_;   ///< nullopt: none came yet
  bool obstacles_lost_ = false;
  std::optional<Pose> pose_;
  double pose_time_ = 0.0;
  double speed_ = 0.0;
  std::optional<Point> goal_;
  Point last_goal_;
  unsigned goal_number_ = 0;
  bool goal_planned_ = false;
  bool map_changed_ = false;
  std::optional<double> request_since_;  ///< s, when the one that is answered now was sent
  Reason request_reason_ = Reason::none;
  unsigned request_goal_ = 0;  ///< its number
  std::optional<double> carved_at_;
  State state_ = State::no_goal;
  Refusal refusal_ = Refusal::none;
  Reason reason_ = Reason::none;
  unsigned plans_ = 0;
  double plan_time_ = 0.0;
  std::size_t nodes_expanded_ = 0;
  Pace pace_;
  std::string detail_;
};

}  // namespace navvi_nav
