#include "guide/navigator.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kWayAhead = 3.0;   // m, that must be free of obstacles to keep a path
constexpr double kNearer = 1.0;     // m, a way toward what is not seen leads nearer by so much
constexpr double kParted = 20.0;    // s, for maps that show a way to the goal again
constexpr double kLook = 4.0;       // s, where what is seen ends, for a map that shows more
constexpr double kLongLook = 12.0;  // s, likewise while such a map is being baked
// m, beyond the robot's radius, of the straight way on past a corner
constexpr double kSightRoom = 0.05, kEasyRoom = 0.25;

bool is_unseen(Guidance::Refusal refusal) {
  return refusal == Guidance::Refusal::not_seen || refusal == Guidance::Refusal::off_the_map;
}

std::optional<double> age_of(std::optional<double> then, double now) {
  if (!then) return std::nullopt;
  return std::max(0.0, now - *then);
}

bool leads_nearer(const Path& path, Point goal) {
  return distance(path.front(), goal) - distance(path.back(), goal) >= kNearer;
}

/// Copies the robot's radius to all that depends on it.
NavigatorConfig completed(NavigatorConfig config) {
  const double radius = config.planner.mesh.robot_radius;
  config.replan.trigger.robot_radius = radius;
  config.replan.forecast.robot_radius = radius;
  config.deadlock.robot_radius = radius;
  double& sight = config.path.guidance.sight_radius;
  double& easy = config.path.guidance.easy_radius;
  if (sight > 0.0) sight = std::max(sight, radius + kSightRoom);
  if (easy > 0.0) easy = std::max(easy, radius + kEasyRoom);
  return config;
}

}  // namespace

void ReplanConfig::describe(navvi_config::Visitor& visit) {
  trigger.describe(visit);
  keeper.describe(visit);
  forecast.describe(visit);
}

void NavigatorConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  planner.describe(visit);
  visit.group("replan", replan);
  path.describe(visit);
  visit.group("stand_off", deadlock);
  observation.describe(visit);
  visit(carve_period, "carve_period", Range{0.05, 60.0}, "s",
        "least time between two updates of the planner's moving things without a plan (R-NAV-5)");
  visit(carve_within, "carve_within", Range{10.0, 1e6}, "m",
        "moving things farther from the robot are not carved: they move on before it comes");
  visit(map_timeout, "map_timeout", Range{0.0, 3600.0}, "s",
        "a map older than this is stale, for a mapper that keeps sending; 0: maps do not age");
}

Navigator::Navigator(const NavigatorConfig& config)
    : config_(completed(config)),
      zones_(config_.planner.mesh.zones),
      observation_(config_.observation),
      forecast_(config_.replan.forecast),
      trigger_(config_.replan.trigger),
      keeper_(config_.replan.keeper),
      deadlock_(config_.deadlock),
      path_(config_.path) {}

void Navigator::set_map(std::shared_ptr<const plan::MapMessage> map) {
  map_.new_map = std::move(map);
  map_.new_grid.reset();
  map_.octomap_came = true;
}

bool Navigator::set_map(std::shared_ptr<const map::OccupancyGrid> grid) {
  if (map_.octomap_came) return false;
  map_.new_grid = std::move(grid);
  return true;
}

void Navigator::set_goal(const Eigen::Vector2d& goal, double stamp) {
  drop_goal(Guidance::State::no_goal);
  goal_.place = to_point(goal);
  goal_.stamp = stamp;
  goal_.toward = second_ask_.agrees(*goal_.place, stamp);
  guidance_.goal = goal;
}

bool Navigator::drop_bad_goal(Guidance::Refusal refusal, const std::string& detail) {
  if (goal_.place) return true;
  refuse_goal(refusal, detail);
  return false;
}

void Navigator::refuse_goal(Guidance::Refusal refusal, const std::string& detail) {
  drop_goal(Guidance::State::goal_refused);
  guidance_.refusal = refusal;
  guidance_.detail = detail;
}

void Navigator::refuse_place(Guidance::Refusal refusal, const std::string& detail, double time) {
  second_ask_.refused(*goal_.place, refusal, std::max(goal_.stamp, time));
  refuse_goal(refusal, detail);
}

void Navigator::drop_goal(Guidance::State state) {
  goal_ = Goal{std::nullopt, goal_.number + 1};
  path_.reset();
  trigger_.reset();
  keeper_.reset();
  deadlock_.reset();
  conflict_ = {};
  blocker_.reset();
  held_.reset();
  guidance_.state = state;
  guidance_.refusal = Guidance::Refusal::none;
  guidance_.detail.clear();
}

void Navigator::reset_times(double jump) {
  observation_.reset_times();
  trigger_.reset();
  keeper_.reset();
  deadlock_.reset_times();
  conflict_ = {};
  second_ask_.reset();
  sent_.carved.reset();
  for (auto* const time : {&sent_.since, &map_.sent, &map_.time, &map_.mesh_time, &cut_off_,
                           &goal_.at_end, &goal_.parted})
    if (*time) **time += jump;
}

std::optional<navvi_types::ZoneState> Navigator::zone(double time) const {
  const std::optional<Pose2> robot = pose(time);
  if (zones_.empty() || !robot) return std::nullopt;
  return zones_.at(to_point(robot->position), robot->yaw, config_.planner.mesh.robot_radius);
}

/// An arrival or a refusal is still true when the map is old.
bool Navigator::map_stale(double time) const {
  return config_.map_timeout > 0.0 && map_.time && time - *map_.time > config_.map_timeout &&
         (goal_.place || guidance_.state == Guidance::State::no_goal);
}

bool Navigator::undecided(double time) const {
  const bool cut_off = cut_off_ && time - *cut_off_ < config_.kPlanTimeout;
  return goal_.place && (!goal_.planned || cut_off) && map_.floor && pose(time) &&
         (!sent_.since || time - *sent_.since < config_.kPlanTimeout);
}

std::optional<plan::PlanRequest> Navigator::update(double time) {
  held_ = waits_for();
  observation_.update(time);
  const Conflict now = follow_progress(time);
  if (map_.new_map && !map_.stands_at && pose(time)) map_.stands_at = height_;
  if (((map_.new_map && map_.stands_at) || map_.new_grid) && !map_.sent) {
    map_.sent = sent_.carved = time;
    plan::PlanRequest request;
    request.stands_at = map_.stands_at;
    request.obstacles = holes();
    request.map = std::exchange(map_.new_map, nullptr);
    request.grid = std::exchange(map_.new_grid, nullptr);
    return request;
  }
  const std::optional<Point> robot =
      map_.floor && goal_.place ? position_of(pose(time)) : std::nullopt;
  if (robot) conflict_ = now;
  const bool kept = robot && keeper_.update(time, now);
  if (sent_.since) {
    if (robot) give_up_late_plan(time, kept);
    return std::nullopt;
  }
  if (const auto reason = robot ? decide_replan(time, *robot, kept) : std::nullopt) {
    plan::PlanRequest request = send(time, *reason);
    ask_for_path(request, *robot);
    return request;
  }
  const bool carve = map_.floor && (!sent_.carved || time - *sent_.carved >= config_.carve_period);
  return carve ? std::optional(send(time, Guidance::Replan::none)) : std::nullopt;
}

Pose2 Navigator::foreseen() const {
  Pose2 ahead = *observation_.foreseen();
  const Eigen::Vector2d& now = observation_.last_pose()->position;
  if (ahead.position != now && !space().segment_clear(to_point(now), to_point(ahead.position), 0.0))
    ahead.position = now;
  return ahead;
}

Conflict Navigator::forecast(const Path& path) const {
  return forecast_.forecast(path, observation_.obstacles(), observation_.pace());
}

/// Follows the robot along the path. \returns the conflict on the rest of it
Conflict Navigator::follow_progress(double time) {
  const std::optional<Point> robot = position_of(pose(time));
  blocker_.reset();
  const auto cut_off = std::exchange(cut_off_, std::nullopt);
  if (!robot || !path_.following()) return {};
  const Point ahead = to_point(foreseen().position);
  path_.advance(ahead, space());
  if (path_.follower().cut_off(ahead, *map_.floor)) cut_off_ = cut_off.value_or(time);
  end_retreat(time, *robot);
  end_path(time, *robot);
  const Conflict now = forecast(path_.remaining(*robot));
  if (path_.following()) watch_deadlock(time, *robot, now);
  return now;
}

/// At the goal it has arrived, if odometry agrees; where the path ends short of it, it never has:
/// unless a map shows more, the goal is refused.
void Navigator::end_path(double time, Point robot) {
  goal_.elsewhere = false;
  if (!path_.arrived(robot, space())) return goal_.at_end.reset();
  if (!path_.ends_short()) {
    const double range = config_.path.guidance.goal_reached + navvi_types::kArrivalMargin;
    goal_.elsewhere =
        by_odometry_ && navvi_types::arrived_elsewhere(*by_odometry_, guidance_.goal, range);
    if (!goal_.elsewhere) drop_goal(Guidance::State::arrived);
    return;
  }
  if (!goal_.at_end) goal_.at_end = time;
  const bool awaits = map_.sent || map_.changed || sent_.since;
  if (time - *goal_.at_end <= (awaits ? kLongLook : kLook)) return;
  refuse_place(Guidance::Refusal::not_seen, "the map ends here and does not show the goal", time);
}

/// A robot that stops just short of the end may still be in the way.
void Navigator::end_retreat(double time, Point robot) {
  if (path_.mode() != PathMode::retreat || !deadlock_.has_retreated(robot, path().back())) return;
  path_.set_mode(PathMode::waiting);
  deadlock_.retreated(time);
}

/// A path must change, too, that has been cut since a plan was asked for, whatever for.
void Navigator::give_up_late_plan(double time, bool kept) {
  const bool cut = conflict_.waypoint_taken || (conflict_.cut && conflict_.cut->at <= kWayAhead);
  const bool must_change = sent_.reason == Guidance::Replan::path_carved ||
                           sent_.reason == Guidance::Replan::waypoint_blocked ||
                           sent_.reason == Guidance::Replan::map_changed || cut_off_ ||
                           (cut && !kept && !path_.closed());
  if (!path_.following() || !must_change || time - *sent_.since <= config_.kPlanTimeout) return;
  path_.drop();
  guidance_.state = Guidance::State::no_route;
  guidance_.detail = "no plan came in time";
}

/// Ends the wait in a retreat, and detects whether the robot and the thing that closes the only
/// path wait for each other.
void Navigator::watch_deadlock(double time, Point robot, const Conflict& now) {
  if (path_.mode() == PathMode::retreat) return;
  if (path_.mode() == PathMode::waiting) {
    // Not where it is hit while it could drive on.
    if (!conflict_.hits_only_waiting() && deadlock_.waits(time)) return;
    path_.set_mode(PathMode::closed);
  }
  if (path_.mode() == PathMode::closed) blocker_ = keeper_.blocker(now.cut, conflict_.state);
  deadlock_.update(time, robot, blocker_ ? observation_.thing(blocker_->by) : std::nullopt);
}

std::optional<Guidance::Replan> Navigator::decide_replan(double time, Point robot, bool kept) {
  ReplanInput input;
  input.time = time;
  input.new_goal = !goal_.planned;
  input.map_changed = map_.changed;
  input.cut_off = cut_off_.has_value();
  input.speed = observation_.speed();
  input.robot = robot;
  input.remaining = path_.remaining(robot);
  input.path_offset = path_.offset(robot);
  input.closed = path_.closed();
  input.obstacles = observation_.obstacles();
  input.conflict = conflict_;
  input.kept = kept;
  input.evades = keeper_.evades(conflict_);
  input.worthwhile = keeper_.worthwhile(length_of(input.remaining));
  return trigger_.update(input);
}

/// A request that at least tells the planner what moves.
plan::PlanRequest Navigator::send(double time, Guidance::Replan reason) {
  sent_ = {time, reason, goal_.number, time};
  plan::PlanRequest request;
  request.obstacles = holes();
  return request;
}

/// The obstacles that holes are cut for.
std::vector<Cylinder> Navigator::holes() const {
  std::vector<Cylinder> out = observation_.obstacles();
  const std::optional<Point> robot = position_of(observation_.last_pose());
  const auto goes_far_off = [&](const Cylinder& one) {
    return robot && distance(one.center, *robot) > config_.carve_within &&
           norm(one.velocity) > kStandingSpeed;
  };
  out.erase(std::remove_if(out.begin(), out.end(), goes_far_off), out.end());
  return out;
}

void Navigator::ask_for_path(plan::PlanRequest& request, Point robot) {
  request.goal = goal_.place;
  request.toward = goal_.toward;
  request.start = robot;
  if (path_.mode() == PathMode::to_goal || path_.mode() == PathMode::closed)
    request.followed = path_.remaining(robot);
  if (keeper_.holds_paths())
    request.predicted =
        forecast_.predicted(path_.remaining(robot), observation_.obstacles(), observation_.pace());
  const bool retreats = path_.mode() == PathMode::retreat;
  if (const std::optional<MovingThing> rival =
          observation_.thing(retreats ? deadlock_.yields_to() : deadlock_.due())) {
    deadlock_.yield_to(*rival);
    request.swept_area = deadlock_.swept_area();
  }
  map_.changed = false;
}

void Navigator::deliver(const plan::PlanAnswer& answer, double time) {
  const bool of_map = answer.map_taken || !answer.map_error.empty();
  const std::optional<double> as_of = std::exchange(of_map ? map_.sent : sent_.since, std::nullopt);
  if (answer.map_taken) {
    map_.changed = goal_.planned || sent_.since;
    map_.time = as_of;
  }
  if (answer.floor && !answer.floor->empty()) {
    map_.floor = answer.floor;
    map_.mesh_time = as_of;
  }
  if (!answer.plan || sent_.goal != goal_.number) return;
  ++guidance_.plans;
  guidance_.plan_time = answer.seconds;
  guidance_.replan_reason = sent_.reason;
  goal_.planned = true;
  take_plan(*answer.plan, sent_.reason, time);
}

void Navigator::take_plan(const plan::Plan& plan, Guidance::Replan reason, double time) {
  if (plan.ends_short && !path_.following() && plan.status == plan::PlanStatus::found &&
      !leads_nearer(plan.path, *goal_.place))
    return refuse_place(plan.refusal, plan.detail, time);
  const bool of_map = reason == Guidance::Replan::map_changed;
  if (plan.status != plan::PlanStatus::refused) goal_.parted.reset();
  switch (plan.status) {
    case plan::PlanStatus::found:
    case plan::PlanStatus::closed:
    case plan::PlanStatus::retreat:
      if (!keeps_path(plan, reason, time))
        change_path(plan, reason, time);
      else if (plan.status == plan::PlanStatus::found && path_.mode() == PathMode::closed)
        path_.set_mode(PathMode::to_goal);
      guidance_.state = Guidance::State::following;
      guidance_.detail = plan.detail;
      follow_progress(time);
      return;
    case plan::PlanStatus::refused:
      // A goal that was accepted is not refused later on because of where the robot strayed, or of
      // a map that is soon made good; but one that is not seen may turn out to be none.
      if (of_map && !goal_.parted) goal_.parted = time;
      if (reason == Guidance::Replan::new_goal || (of_map && path_.ends_short()) ||
          (goal_.parted && time - *goal_.parted >= (is_unseen(plan.refusal) ? kLook : kParted)))
        return refuse_place(plan.refusal, plan.detail, time);
      guidance_.state = Guidance::State::no_route;
      break;
    case plan::PlanStatus::no_map:
    case plan::PlanStatus::no_route:
      if (keeps_path(plan, reason, time)) return;
      guidance_.state = Guidance::State::no_route;
      break;
    case plan::PlanStatus::off_mesh:
      guidance_.state = Guidance::State::off_mesh;
      break;
  }
  path_.drop();
  guidance_.detail = plan.detail;
}

bool Navigator::keeps_path(const plan::Plan& plan, Guidance::Replan reason, double time) {
  const std::optional<Point> robot = position_of(observation_.last_pose());
  if (!path_.following() || !robot) return false;
  const std::vector<Cylinder> none;
  if (path_.mode() == PathMode::retreat && observation_.obstacles_held() && !cut_off_ &&
      path_.follower().sees_next(*robot, {map_.floor.get(), &none}))
    return true;
  const Path remaining = path_.remaining(*robot);
  PathKeeper::Choice choice;
  choice.time = time;
  choice.reason = reason;
  choice.mode = path_.mode();
  choice.found = plan.status;
  choice.followed = {remaining, forecast(remaining)};
  choice.fresh = {plan.path, forecast(plan.path)};
  choice.strayed = path_.strayed(*robot);
  choice.sees_waypoint = path_.follower().sees_next(*robot, {map_.floor.get(), &none});
  choice.way_is_free = path_.follower().sees_next(*robot, space(), kWayAhead);
  return keeper_.decide(choice);
}

void Navigator::change_path(const plan::Plan& plan, Guidance::Replan reason, double time) {
  const double moved = path_.follow(plan, reason, position_of(observation_.last_pose()));
  if (moved > 0.0 && reason != Guidance::Replan::new_goal &&
      reason != Guidance::Replan::map_changed)
    keeper_.chose(time);
}

Guidance Navigator::guidance(double time) const {
  Guidance out = guidance_;
  path_.report_changes(out);
  out.mesh_age = age_of(map_.mesh_time, time);
  out.map_age = age_of(map_.time, time);
  out.floor = floor_height();
  if (!map_.floor && map_.new_map && !map_.stands_at) {
    out.state = Guidance::State::pose_stale;
    out.detail =
        "no fresh pose of the robot, whose height tells which level of the map is the floor";
  } else if (!map_.floor) {
    out.state = Guidance::State::no_map;
    out.detail = "no usable map came yet";
  } else if (map_stale(time)) {
    out.state = Guidance::State::map_stale;
    out.detail = "no fresh map came";
  } else if (goal_.place && !pose(time)) {
    out.state = Guidance::State::pose_stale;
    out.detail = "no fresh pose of the robot";
  } else if (goal_.elsewhere) {
    out.state = Guidance::State::pose_stale;
    out.detail = std::string("the pose is at the goal, and odometry is ") +
                 (observation_.velocity_fresh(time) ? "not" : "silent");
  } else if (out.state == Guidance::State::following) {
    report_path(out);
  }
  const bool fresh = observation_.obstacles_fresh();
  const bool rejected = observation_.obstacles_rejected();
  if (map_.floor && goal_.place && (!fresh || rejected)) {
    if (!out.detail.empty()) out.detail += "; ";
    out.detail +=
        rejected ? "the obstacles are rejected, as malformed or too many" : "no fresh obstacles";
    if (!fresh && out.state == Guidance::State::following)
      out.detail += ": moving things are not in the path";
  }
  return out;
}

std::optional<Blocker> Navigator::waits_for() const {
  if (held_ && observation_.obstacles_held()) return Blocker{held_->by, held_->at, std::nullopt};
  if (path_.mode() == PathMode::waiting) return Blocker{*deadlock_.yields_to(), 0.0, std::nullopt};
  return blocker_ ? blocker_ : keeper_.waits_for();
}

void Navigator::report_path(Guidance& out) const {
  const std::optional<Pose2>& robot = observation_.last_pose();
  if (!path_.following() || !robot) {
    out.state = Guidance::State::no_route;
    return;
  }
  path_.report(out, *robot, *map_.floor, observation_.pace());
  std::optional<Blocker> blocked = waits_for();
  if (blocked) {
    out.state = Guidance::State::blocked;
  } else if (path_.mode() == PathMode::retreat) {
    out.state = Guidance::State::make_room;
    blocked = Blocker{*deadlock_.yields_to(), 0.0, 0.0};
  } else {
    return;
  }
  if (const auto thing = observation_.thing(blocked->by)) out.blocked_by = thing->thing_class;
  out.blocked_distance = blocked->at;
  out.blocked_for = blocked->time_to_clear;
}

}  // namespace navvi_nav::guide
