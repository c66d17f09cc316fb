#include "navvi_nav/navigator.hpp"

namespace navvi_nav {
namespace {

constexpr double kElsewhere = 2.0;  // m moved of a path: it leads elsewhere
constexpr double kAside = 0.4;      // m, from where room was to be made

std::optional<double> age_of(std::optional<double> then, double now) {
  if (!then) return std::nullopt;
  return std::max(0.0, now - *then);
}

ReplanPolicyConfig policy_of(const NavigatorConfig& config) {
  ReplanPolicyConfig out = config.replan;
  out.way.robot_radius = config.planner.mesh.robot_radius;
  return out;
}

}  // namespace

void NavigatorConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  planner.describe(visit);
  visit.group("replan", replan);
  visit.group("guidance", guidance);
  visit.group("stand_off", stand_off);
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
  visit({"off_path", Range{0.1, 10.0}, "m",
         "a robot farther off its path gets a new one at the next plan"},
        off_path);
  visit({"map_timeout", Range{0.0, 3600.0}, "s",
         "a map older than this is stale, for a mapper that keeps sending; 0: maps do not age"},
        map_timeout);
}

Navigator::Navigator(const NavigatorConfig& config)
    : config_(config),
      policy_(policy_of(config)),
      guidance_(config.guidance),
      stand_off_(config.stand_off) {}

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
  guidance_.follow({});
  aim_ = Aim::goal;
  stand_off_.forget();
  blocker_.reset();
  makes_room_.reset();
  policy_.reset();
  churn_.reset();
  reroutes_ = 0;
  reroute_reason_ = Reason::none;
  state_ = state;
  refusal_ = Refusal::none;
  detail_.clear();
}

void Navigator::reset_times() {
  policy_.reset();
  stand_off_.reset();
  churn_.reset();
  pose_.reset();
  things_.clear();
  moved_.clear();
  obstacles_.clear();
  obstacles_time_.reset();
  obstacles_lost_ = false;
  carved_at_.reset();
  if (job_since_) job_since_ = 0.0;
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
         (!job_since_ || time - *job_since_ < config_.plan_timeout);
}

std::optional<Job> Navigator::update(double time) {
  if (obstacles_time_ && !obstacles_fresh(time)) {
    things_.clear();
    obstacles_.clear();
    obstacles_lost_ = true;
  }
  pace_.update(time, speed_);
  follow_progress(time);
  watch_blocker(time);
  return job_since_ ? std::nullopt : next_job(time);
}

void Navigator::follow_progress(double time) {
  if (!guidance_.following() || !pose_fresh(time)) return;
  guidance_.advance(*pose_, space());
  if (aim_ == Aim::aside) {
    if (distance(pose_->position, guidance_.path().back()) <= kAside) {
      aim_ = Aim::waits;
      stand_off_.went_aside(time, *makes_room_);
    }
  } else if (aim_ != Aim::waits && guidance_.arrived(*pose_, space())) {
    drop_goal(State::arrived);
    return;
  }
  const bool must_change = job_reason_ == Reason::path_carved ||
                           job_reason_ == Reason::waypoint_blocked ||
                           job_reason_ == Reason::map_changed;
  if (job_since_ && must_change && time - *job_since_ > config_.plan_timeout) {
    guidance_.follow({});
    state_ = State::no_route;
    detail_ = "no plan came in time";
  }
}

const MovingThing* Navigator::thing(std::optional<std::uint32_t> id) const {
  const auto found = std::find_if(things_.begin(), things_.end(), [id](const MovingThing& one) {
    return id && one.cylinder.id == *id;
  });
  return found == things_.end() ? nullptr : &*found;
}

/// What closes the only way, and whether it and the robot wait for each other.
void Navigator::watch_blocker(double time) {
  blocker_.reset();
  if (!guidance_.following() || !pose_fresh(time) || aim_ == Aim::aside) return;
  if (aim_ == Aim::waits && stand_off_.aside_for(time)) return;
  if (aim_ == Aim::waits) aim_ = Aim::closed;
  if (aim_ == Aim::closed)
    blocker_ = policy_.closed_by(guidance_.remaining(pose_->position), obstacles_);
  const MovingThing* const by = blocker_ ? thing(blocker_->by) : nullptr;
  stand_off_.update(time, pose_->position, by ? std::optional(*by) : std::nullopt);
}

std::optional<Job> Navigator::next_job(double time) {
  Job job;
  job.obstacles = obstacles_;
  job.goal_number = goal_number_;
  if (new_map_ || new_grid_) {
    job.map = std::exchange(new_map_, nullptr);
    job.grid = std::exchange(new_grid_, nullptr);
    job.reason = Reason::map_changed;
  } else if (floor_ && goal_ && pose_fresh(time)) {
    ReplanInput input;
    input.time = time;
    input.has_goal = true;
    input.new_goal = !goal_planned_;
    input.map_changed = map_changed_;
    input.speed = speed_;
    input.pace = pace_.value();
    input.robot = *pose_;
    input.remaining = guidance_.remaining(pose_->position);
    if (guidance_.following()) input.path_offset = guidance_.heading(*pose_).path_offset;
    input.obstacles = obstacles_;
    input.closed = aim_ == Aim::closed || aim_ == Aim::waits;
    if (const std::optional<Reason> reason = policy_.update(input)) {
      job.goal = goal_;
      job.foreseen = policy_.foreseen(input.remaining, obstacles_, input.pace);
      const MovingThing* const rival = thing(aim_ == Aim::aside ? makes_room_ : stand_off_.due());
      if (rival) job.ground = ground_needed(*rival);
      if (rival) makes_room_ = rival->cylinder.id;
      job.start = pose_->position;
      job.reason = *reason;
      map_changed_ = false;
    }
  }
  const bool carve = floor_ && (!carved_at_ || time - *carved_at_ >= config_.carve_period);
  if (!job.map && !job.grid && !job.goal && !carve) return std::nullopt;
  carved_at_ = time;
  job_since_ = time;
  job_reason_ = job.reason;
  return job;
}

void Navigator::deliver(const Outcome& outcome, double time) {
  const std::optional<double> as_of = std::exchange(job_since_, std::nullopt);
  if (outcome.map_taken) {
    map_changed_ = goal_planned_;
    map_time_ = as_of;
  }
  if (outcome.floor && !outcome.floor->empty()) {
    floor_ = outcome.floor;
    mesh_time_ = as_of;
  }
  if (!outcome.plan || outcome.goal_number != goal_number_) return;
  ++plans_;
  plan_time_ = outcome.seconds;
  nodes_expanded_ = outcome.plan->nodes_expanded;
  reason_ = outcome.reason;
  goal_planned_ = true;
  take_plan(*outcome.plan, outcome.reason, time);
}

void Navigator::take_plan(const Plan& plan, Reason reason, double time) {
  switch (plan.status) {
    case PlanStatus::found:
    case PlanStatus::closed:
    case PlanStatus::aside:
      follow(plan, reason, time);
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
      if (keeps_path(plan, reason, time)) return;
      state_ = State::no_route;
      break;
    case PlanStatus::off_mesh:
      state_ = State::off_mesh;
      break;
  }
  guidance_.follow({});
  detail_ = plan.detail;
}

void Navigator::follow(const Plan& plan, Reason reason, double time) {
  if (!keeps_path(plan, reason, time)) {
    change_path(plan, reason, time);
    const bool waits = aim_ == Aim::waits && plan.status == PlanStatus::closed;
    aim_ = plan.status == PlanStatus::found   ? Aim::goal
           : plan.status == PlanStatus::aside ? Aim::aside
           : waits                            ? Aim::waits
                                              : Aim::closed;
  }
  state_ = State::following;
  detail_ = plan.detail;
  follow_progress(time);
  watch_blocker(time);
}

void Navigator::change_path(const Plan& plan, Reason reason, double time) {
  if (guidance_.following() && pose_) {
    const double moved = Churn::moved(guidance_.remaining(pose_->position), plan.path);
    churn_.add(time, moved);
    if (moved > 0.0 && reason != Reason::new_goal && reason != Reason::map_changed)
      policy_.chose(time);
    if (moved > kElsewhere) {
      ++reroutes_;
      reroute_reason_ = reason;
    }
  }
  guidance_.follow(plan.path);
  shortest_length_ = plan.shortest;
  smoothing_price_ = length_of(plan.path) - plan.shortest;
}

/// Hysteresis: a path that still serves stays, so that a person is not sent here and there. It
/// serves, too, while only something far ahead closes the way, or something that moves on and would
/// make the person turn back or go a long way round: that may have moved off by then.
bool Navigator::keeps_path(const Plan& plan, Reason reason, double time) {
  if (!guidance_.following() || !pose_) return false;
  const Path remaining = guidance_.remaining(pose_->position);
  const bool found = plan.status == PlanStatus::found;
  const bool held = aim_ == Aim::goal && policy_.holds(time, remaining, found ? plan.path : Path{},
                                                       obstacles_, pace_.value());
  if (reason == Reason::new_goal || reason == Reason::map_changed ||
      guidance_.heading(*pose_).path_offset > config_.off_path)
    return false;
  const std::vector<Cylinder> none;
  const bool sees_next = guidance_.sees_next(pose_->position, {floor_.get(), &none});
  if (held) return sees_next;
  if (plan.status == PlanStatus::aside)
    return aim_ == Aim::aside && !policy_.blocked(remaining, obstacles_) && sees_next;
  if (plan.status == PlanStatus::closed)
    return aim_ == Aim::closed && sees_next &&
           !policy_.worth_changing(Reason::period, remaining, plan.path);
  if (aim_ != Aim::goal) return false;
  return !policy_.worth_changing(reason, remaining, found ? plan.path : Path{}) &&
         !policy_.blocked(remaining, obstacles_) && guidance_.sees_next(pose_->position, space());
}

Status Navigator::status(double time) const {
  Status out;
  out.state = state_;
  out.refusal = refusal_;
  out.reason = reason_;
  out.plans = plans_;
  out.plan_time = plan_time_;
  out.nodes_expanded = nodes_expanded_;
  out.reroutes = reroutes_;
  out.reroute_reason = reroute_reason_;
  out.churn = churn_.per_minute(time);
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
    if (guidance_.following() && pose_) {
      out.heading = guidance_.heading(*pose_);
      out.eta = out.heading.goal_distance / pace_.value();
      out.shortest_length = shortest_length_;
      out.smoothing_price = smoothing_price_;
      out.blocked = blocker_ ? blocker_ : aim_ == Aim::goal ? policy_.waits_for() : std::nullopt;
      if (aim_ == Aim::waits) out.blocked = Way::Wait{*makes_room_, 0.0, -1.0};
      if (out.blocked) out.state = State::blocked;
      if (aim_ == Aim::aside) {
        out.state = State::make_room;
        out.blocked = Way::Wait{*makes_room_, 0.0, 0.0};
        out.heading.waypoint_is_goal = false;
      }
    } else {
      out.state = State::no_route;
    }
  }
  if (floor_ && goal_ && !obstacles_fresh(time)) {
    if (!out.detail.empty()) out.detail += "; ";
    out.detail += "no fresh obstacles: moving things are not in the path";
  }
  return out;
}

}  // namespace navvi_nav
