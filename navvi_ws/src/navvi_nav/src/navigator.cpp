#include "navvi_nav/navigator.hpp"

namespace navvi_nav {
namespace {

std::optional<double> age_of(std::optional<double> then, double now) {
  if (!then) return std::nullopt;
  return std::max(0.0, now - *then);
}

ReplanPolicyConfig policy_of(const NavigatorConfig& config) {
  ReplanPolicyConfig out = config.replan;
  out.way.robot_radius = config.planner.mesh.robot_radius;
  return out;
}

CourseConfig course_of(const NavigatorConfig& config) {
  CourseConfig out = config.course;
  out.robot_radius = config.planner.mesh.robot_radius;
  return out;
}

}  // namespace

void NavigatorConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  planner.describe(visit);
  visit.group("replan", replan);
  course.describe(visit);
  visit({"most_cylinders", Range{1.0, 4.0}, "",
         "as which a long thing is taken, in a row; 1: the one about it (R-NAV-4)"},
        most_cylinders);
  visit({"carve_period", Range{0.05, 60.0}, "s",
         "least time between two updates of the holes while nothing asks for a plan (R-NAV-5)"},
        carve_period);
  visit({"pose_timeout", Range{0.1, 10.0}, "s", "an older pose of the robot is stale"},
        pose_timeout);
  visit({"obstacle_timeout", Range{0.1, 10.0}, "s", "older obstacles are forgotten"},
        obstacle_timeout);
  visit({"plan_timeout", Range{0.1, 10.0}, "s",
         "a path that must change is hidden when no plan came for so long"},
        plan_timeout);
  visit({"map_timeout", Range{0.0, 3600.0}, "s",
         "a map older than this is stale, for a mapper that keeps sending; 0: maps do not age"},
        map_timeout);
}

Navigator::Navigator(const NavigatorConfig& config)
    : config_(config), policy_(policy_of(config)), course_(course_of(config)) {}

void Navigator::set_map(std::shared_ptr<const MapMessage> map) {
  new_map_ = std::move(map);
  new_grid_.reset();
  octomap_came_ = true;
}

bool Navigator::set_map(std::shared_ptr<const OccupancyGrid> grid) {
  if (octomap_came_) return false;
  new_grid_ = std::move(grid);
  return true;
}

void Navigator::set_obstacles(const std::vector<MovingThing>& things, double time) {
  std::map<std::uint32_t, double> moved;
  things_ = things;
  for (MovingThing& thing : things_) {
    Cylinder& one = thing.cylinder;
    const auto before = moved_.find(one.id);
    if (norm(one.velocity) > config_.replan.way.standing_speed)
      moved[one.id] = time;
    else if (before != moved_.end())
      moved[one.id] = before->second;
    const auto last = moved.find(one.id);
    if (last != moved.end()) one.stood = time - last->second;
  }
  moved_ = std::move(moved);
  obstacles_ = cylinders_of(things_, config_.most_cylinders);
  obstacles_time_ = time;
  obstacles_lost_ = false;
}

void Navigator::set_pose(const Pose& pose, double time) {
  pose_ = pose;
  pose_time_ = time;
}

void Navigator::set_goal(Point goal) {
  drop_goal(State::no_goal);
  goal_ = goal;
  last_goal_ = goal;
}

bool Navigator::drop_bad_goal(Refusal refusal, const std::string& detail) {
  if (goal_) return true;
  refuse_goal(refusal, detail);
  return false;
}

void Navigator::refuse_goal(Refusal refusal, const std::string& detail) {
  drop_goal(State::goal_refused);
  refusal_ = refusal;
  detail_ = detail;
}

void Navigator::drop_goal(State state) {
  goal_.reset();
  ++goal_number_;
  goal_planned_ = false;
  course_.forget();
  policy_.reset();
  state_ = state;
  refusal_ = Refusal::none;
  detail_.clear();
}

void Navigator::reset_times() {
  policy_.reset();
  course_.reset_times();
  pose_.reset();
  things_.clear();
  moved_.clear();
  obstacles_.clear();
  obstacles_time_.reset();
  obstacles_lost_ = false;
  carved_at_.reset();
  if (request_since_) request_since_ = 0.0;
}

bool Navigator::pose_fresh(double time) const {
  return pose_ && time - pose_time_ <= config_.pose_timeout;
}

/// An arrival or a refusal is still true when the map is old.
bool Navigator::map_stale(double time) const {
  return config_.map_timeout > 0.0 && map_time_ && time - *map_time_ > config_.map_timeout &&
         (goal_ || state_ == State::no_goal);
}

bool Navigator::obstacles_fresh(double time) const {
  return obstacles_time_ && time - *obstacles_time_ <= config_.obstacle_timeout;
}

bool Navigator::undecided(double time) const {
  return goal_ && !goal_planned_ && floor_ && pose_fresh(time) &&
         (!request_since_ || time - *request_since_ < config_.plan_timeout);
}

std::optional<PlanRequest> Navigator::update(double time) {
  if (obstacles_time_ && !obstacles_fresh(time)) {
    things_.clear();
    obstacles_.clear();
    obstacles_lost_ = true;
  }
  pace_.update(time, speed_);
  follow_progress(time);
  return request_since_ ? std::nullopt : next_request(time);
}

void Navigator::follow_progress(double time) {
  if (course_.arrives(scene(time, pose(time))))
    drop_goal(State::arrived);
  else
    give_up_late_plan(time);
  course_.watch(scene(time, pose(time)), policy_);
}

void Navigator::give_up_late_plan(double time) {
  if (!course_.following() || !pose_fresh(time)) return;
  const bool must_change = request_reason_ == Reason::path_carved ||
                           request_reason_ == Reason::waypoint_blocked ||
                           request_reason_ == Reason::map_changed;
  if (request_since_ && must_change && time - *request_since_ > config_.plan_timeout) {
    course_.drop();
    state_ = State::no_route;
    detail_ = "no plan came in time";
  }
}

std::optional<PlanRequest> Navigator::next_request(double time) {
  PlanRequest request;
  Reason reason = Reason::none;
  request.obstacles = obstacles_;
  if (new_map_ || new_grid_) {
    request.map = std::exchange(new_map_, nullptr);
    request.grid = std::exchange(new_grid_, nullptr);
    reason = Reason::map_changed;
  } else if (floor_ && goal_ && pose_fresh(time)) {
    ReplanInput input;
    input.time = time;
    input.has_goal = true;
    input.new_goal = !goal_planned_;
    input.map_changed = map_changed_;
    input.speed = speed_;
    input.pace = pace_.value();
    input.robot = *pose_;
    const Guidance& guidance = course_.guidance();
    input.remaining = guidance.remaining(pose_->position);
    if (course_.following()) input.path_offset = guidance.heading(*pose_).path_offset;
    input.obstacles = obstacles_;
    input.closed = course_.closed();
    if (const std::optional<Reason> due = policy_.update(input)) {
      request.goal = goal_;
      request.predicted = policy_.foreseen(input.remaining, obstacles_, input.pace);
      request.swept_area = course_.ground_to_leave(things_);
      request.start = pose_->position;
      reason = *due;
      map_changed_ = false;
    }
  }
  const bool carve = floor_ && (!carved_at_ || time - *carved_at_ >= config_.carve_period);
  if (!request.brings_map() && !request.goal && !carve) return std::nullopt;
  carved_at_ = time;
  request_since_ = time;
  request_reason_ = reason;
  request_goal_ = goal_number_;
  return request;
}

void Navigator::deliver(const PlanAnswer& answer, double time) {
  const std::optional<double> as_of = std::exchange(request_since_, std::nullopt);
  if (answer.map_taken) {
    map_changed_ = goal_planned_;
    map_time_ = as_of;
  }
  if (answer.floor && !answer.floor->empty()) {
    floor_ = answer.floor;
    mesh_time_ = as_of;
  }
  if (!answer.plan || request_goal_ != goal_number_) return;
  ++plans_;
  plan_time_ = answer.seconds;
  nodes_expanded_ = answer.plan->nodes_expanded;
  reason_ = request_reason_;
  goal_planned_ = true;
  take_plan(*answer.plan, request_reason_, time);
}

void Navigator::take_plan(const Plan& plan, Reason reason, double time) {
  switch (plan.status) {
    case PlanStatus::found:
    case PlanStatus::closed:
    case PlanStatus::retreat:
      course_.take(plan, reason, scene(time, pose_), policy_);
      state_ = State::following;
      detail_ = plan.detail;
      follow_progress(time);
      return;
    case PlanStatus::refused:
      // A goal that was accepted is not refused later on because of where the robot strayed.
      if (reason == Reason::new_goal || reason == Reason::map_changed) {
        refuse_goal(plan.refusal, plan.detail);
        return;
      }
      state_ = State::no_route;
      break;
    case PlanStatus::no_map:
    case PlanStatus::no_route:
      if (course_.keeps(plan, reason, scene(time, pose_), policy_)) return;
      state_ = State::no_route;
      break;
    case PlanStatus::off_mesh:
      state_ = State::off_mesh;
      break;
  }
  course_.drop();
  detail_ = plan.detail;
}

Status Navigator::status(double time) const {
  Status out;
  out.state = state_;
  out.refusal = refusal_;
  out.reason = reason_;
  out.plans = plans_;
  out.plan_time = plan_time_;
  out.nodes_expanded = nodes_expanded_;
  course_.tell_unrest(out, time);
  out.mesh_age = age_of(mesh_time_, time);
  out.map_age = age_of(map_time_, time);
  out.goal = last_goal_;
  out.detail = detail_;
  if (!floor_) {
    out.state = State::no_map;
    out.detail = "no usable map came yet";
  } else if (map_stale(time)) {
    out.state = State::map_stale;
    out.detail = "no fresh map came";
  } else if (goal_ && !pose_fresh(time)) {
    out.state = State::pose_stale;
    out.detail = "no fresh pose of the robot";
  } else if (state_ == State::following) {
    if (course_.following() && pose_)
      course_.tell(out, scene(time, pose_), policy_);
    else
      out.state = State::no_route;
  }
  if (floor_ && goal_ && !obstacles_fresh(time)) {
    if (!out.detail.empty()) out.detail += "; ";
    out.detail += "no fresh obstacles: moving things are not in the path";
  }
  return out;
}

}  // namespace navvi_nav
