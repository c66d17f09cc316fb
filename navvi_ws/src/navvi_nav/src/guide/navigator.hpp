#pragma once

#include <memory>
#include <navvi_types/guidance.hpp>
#include <optional>
#include <string>

#include "guide/active_path.hpp"
#include "guide/conflict_forecast.hpp"
#include "guide/deadlock.hpp"
#include "guide/observation.hpp"
#include "guide/path_keeper.hpp"
#include "guide/replan_trigger.hpp"
#include "plan/planner.hpp"

namespace navvi_nav::guide {

/// What the deciders are set by: one group of parameters.
struct ReplanConfig {
  ReplanTriggerConfig trigger;
  PathKeeperConfig keeper;
  ConflictForecastConfig forecast;

  void describe(navvi_config::Visitor& visit);
};

struct NavigatorConfig {
  plan::PlannerConfig planner;
  ReplanConfig replan;
  ActivePathConfig path;
  DeadlockConfig deadlock;
  ObservationConfig observation;
  double carve_period = 0.5;
  double carve_within = 80.0;
  /// s, a path that must change is hidden when no plan came for so long
  static constexpr double kPlanTimeout = 1.0;
  double map_timeout = 0.0;

  void describe(navvi_config::Visitor& visit);
};

/// The decisions of nav_node: the planner's next request, the path to follow, the guidance to
/// publish. It hands one forecast a tick to three deciders that do not know each other:
/// ReplanTrigger (when to plan), PathKeeper (keep or change the path), Deadlock (when to yield).
/// Times are s on one clock; after a jump back call reset_times().
class Navigator {
 public:
  explicit Navigator(const NavigatorConfig& config);

  void set_map(std::shared_ptr<const plan::MapMessage> map);
  /// A map where there is no OctoMap. \returns false if it is ignored because an OctoMap came
  /// before
  bool set_map(std::shared_ptr<const map::OccupancyGrid> grid);
  void set_obstacles(std::vector<MovingThing> things, double time) {
    observation_.set_obstacles(std::move(things), time);
  }
  /// Obstacles came that cannot be taken: malformed, or too many.
  void reject_obstacles() { observation_.reject_obstacles(); }
  /// \param height  m, z of base_link, which is on the floor. An OctoMap is taken only when it is
  ///                known: the first one tells which of its levels is the floor.
  /// \param stamp   s, of the pose
  void set_pose(const Pose2& pose, double height, double stamp) {
    observation_.set_pose(pose, stamp);
    height_ = height;
  }
  void set_velocity(const navvi_types::Velocity& velocity) { observation_.set_velocity(velocity); }
  /// \param ahead  s, by which guidance is ahead of the robot
  void set_foresight(double ahead) { observation_.set_foresight(ahead); }
  /// \param place  m, in map, where the robot is by odometry, which may contradict an arrival;
  /// nullopt: unknown
  void set_odometry_place(const std::optional<Eigen::Vector2d>& place) { by_odometry_ = place; }
  /// A new goal replaces the old one. It is judged by the next plan; one that the map does not show
  /// yet is led toward only on a SecondAsk.
  /// \param stamp  s, of its message; 0: it is nobody's second ask
  void set_goal(const Eigen::Vector2d& goal, double stamp = 0.0);
  void cancel_goal() { drop_goal(Guidance::State::no_goal); }
  /// A goal message that cannot even be read is dropped whole: a goal that stands stays. Only
  /// without one the refusal is reported. \returns true if a goal stands
  bool drop_bad_goal(Guidance::Refusal refusal, const std::string& detail);
  /// \param jump  s, by which the clock was set; negative: back. Ages go on as they were.
  void reset_times(double jump);

  /// Brings everything up to `time`. \returns the next request to the planner, if one is due and
  /// none of its kind is being answered: those that bring a map, and all others
  [[nodiscard]] std::optional<plan::PlanRequest> update(double time);
  void deliver(const plan::PlanAnswer& answer, double time);

  /// All but its stamp and number.
  [[nodiscard]] Guidance guidance(double time) const;
  /// The path as planned; empty when there is none to show.
  [[nodiscard]] const Path& path() const { return path_.follower().path(); }
  /// True while the first plan for a goal is being made, or the first from a place that something
  /// cuts off from the path: there is no new guidance yet.
  [[nodiscard]] bool undecided(double time) const;
  /// Where the robot is; nullopt without a fresh pose.
  [[nodiscard]] std::optional<Pose2> pose(double time) const { return observation_.pose(time); }
  [[nodiscard]] bool has_map() const { return map_.floor != nullptr; }
  /// What zones allow where the robot is; nullopt without zones, or a fresh pose.
  [[nodiscard]] std::optional<navvi_types::ZoneState> zone(double time) const;
  [[nodiscard]] const map::Zones& zones() const { return zones_; }
  /// True if the obstacles were given up as too old; cleared by the next ones.
  [[nodiscard]] bool obstacles_lost() const { return observation_.obstacles_lost(); }
  /// m, z of the floor in map; 0 before there is a map.
  [[nodiscard]] double floor_height() const { return map_.floor ? map_.floor->height() : 0.0; }

 private:
  struct Goal {
    std::optional<Point> place;
    unsigned number = 0;  ///< changes with each goal
    bool planned = false;
    double stamp = 0.0;                 ///< s, of its message
    bool toward = false;                ///< it is led toward though not seen yet
    std::optional<double> at_end = {};  ///< s, since when the robot is at an end short of it
    std::optional<double> parted = {};  ///< s, since when the map joins it with the robot no more
    bool elsewhere = false;             ///< the pose is at it, and odometry is not
  };
  struct MapState {
    std::shared_ptr<const map::Floor> floor;  ///< null: no map yet
    std::shared_ptr<const plan::MapMessage> new_map;
    std::shared_ptr<const map::OccupancyGrid> new_grid;
    bool octomap_came = false;
    std::optional<double> stands_at;  ///< m, z of base_link when the first one was taken
    std::optional<double> sent;       ///< s, when the one that is being baked was
    bool changed = false;             ///< since the last plan
    std::optional<double> time;       ///< s, when the map in use came
    std::optional<double> mesh_time;  ///< s, of the moving things that the planner knows
  };
  /// The last request: its reason, and whether it is answered.
  struct Sent {
    std::optional<double> since;  ///< s; nullopt: answered
    Guidance::Replan reason = Guidance::Replan::none;
    unsigned goal = 0;             ///< its number
    std::optional<double> carved;  ///< s, when the planner was last told what moves
  };

  /// Where the robot will be when a person's answer comes; where it is if something stands between.
  [[nodiscard]] Pose2 foreseen() const;
  [[nodiscard]] map::Space space() const { return {map_.floor.get(), &observation_.obstacles()}; }
  [[nodiscard]] bool map_stale(double time) const;
  [[nodiscard]] Conflict forecast(const Path& path) const;
  Conflict follow_progress(double time);
  void end_retreat(double time, Point robot);
  void end_path(double time, Point robot);
  void give_up_late_plan(double time, bool kept);
  void watch_deadlock(double time, Point robot, const Conflict& now);
  [[nodiscard]] std::optional<Guidance::Replan> decide_replan(double time, Point robot, bool kept);
  [[nodiscard]] std::vector<Cylinder> holes() const;
  [[nodiscard]] plan::PlanRequest send(double time, Guidance::Replan reason);
  void ask_for_path(plan::PlanRequest& request, Point robot);
  void take_plan(const plan::Plan& plan, Guidance::Replan reason, double time);
  [[nodiscard]] bool keeps_path(const plan::Plan& plan, Guidance::Replan reason, double time);
  void change_path(const plan::Plan& plan, Guidance::Replan reason, double time);
  void drop_goal(Guidance::State state);
  void refuse_goal(Guidance::Refusal refusal, const std::string& detail);
  void refuse_place(Guidance::Refusal refusal, const std::string& detail, double time);
  [[nodiscard]] std::optional<Blocker> waits_for() const;
  void report_path(Guidance& out) const;

  NavigatorConfig config_;
  map::Zones zones_;
  Observation observation_;
  double height_ = 0.0;  ///< m, z of base_link
  std::optional<Eigen::Vector2d> by_odometry_;  ///< m, in map
  ConflictForecast forecast_;
  ReplanTrigger trigger_;
  PathKeeper keeper_;
  Deadlock deadlock_;
  ActivePath path_;
  MapState map_;
  Goal goal_;
  SecondAsk second_ask_;
  std::optional<double> cut_off_;  ///< s, since when something stands between robot and path
  Sent sent_;
  Conflict conflict_;               ///< as of the last tick with a goal and a place
  std::optional<Blocker> blocker_;  ///< of the only path, if near
  std::optional<Blocker> held_;     ///< what was waited for before this tick
  Guidance guidance_;               ///< without the values that change with time
};

}  // namespace navvi_nav::guide
