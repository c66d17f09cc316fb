#include "navvi_nav/course.hpp"

#include "navvi_nav/escape.hpp"

namespace navvi_nav {
namespace {

constexpr double kElsewhere = 2.0;  // m moved of a path: it leads elsewhere
constexpr double kAside = 0.4;   // m, from where room was to be made: near enough if out of the way
constexpr double kThere = 0.15;  // m, likewise: near enough

const MovingThing* find(const std::vector<MovingThing>& things, std::optional<std::uint32_t> id) {
  const auto found = std::find_if(things.begin(), things.end(), [id](const MovingThing& one) {
    return id && one.cylinder.id == *id;
  });
  return found == things.end() ? nullptr : &*found;
}

}  // namespace

void CourseConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit.group("guidance", guidance);
  visit.group("stand_off", stand_off);
  visit({"off_path", Range{0.1, 10.0}, "m",
         "a robot farther off its path gets a new one at the next plan"},
        off_path);
}

void Course::forget() {
  drop();
  aim_ = Aim::goal;
  stand_off_.forget();
  blocker_.reset();
  makes_room_.reset();
  churn_.reset();
  reroutes_ = 0;
  reroute_reason_ = Reason::none;
}

void Course::reset_times() {
  stand_off_.reset();
  churn_.reset();
}

/// Who stops just short of the place may still be in the way.
bool Course::is_aside(const Scene& scene) const {
  const Point robot = scene.robot->position;
  const double left = distance(robot, guidance_.path().back());
  return left <= kThere ||
         (left <= kAside && !in_a_hole(robot, {scene.floor, &ground_}, config_.robot_radius));
}

bool Course::arrives(const Scene& scene) {
  if (!following() || !scene.robot) return false;
  guidance_.advance(*scene.robot, scene.space());
  if (aim_ == Aim::aside) {
    if (is_aside(scene)) {
      aim_ = Aim::waits;
      stand_off_.went_aside(scene.time, *makes_room_);
    }
    return false;
  }
  return aim_ != Aim::waits && guidance_.arrived(*scene.robot, scene.space());
}

void Course::watch(const Scene& scene, const ReplanPolicy& policy) {
  blocker_.reset();
  if (!following() || !scene.robot || aim_ == Aim::aside) return;
  // Not where it is run into while it could go on.
  if (aim_ == Aim::waits && !policy.chases() && stand_off_.aside_for(scene.time)) return;
  if (aim_ == Aim::waits) aim_ = Aim::closed;
  const Point robot = scene.robot->position;
  if (aim_ == Aim::closed) blocker_ = policy.closed_by(guidance_.remaining(robot), scene.obstacles);
  const MovingThing* const by = blocker_ ? find(scene.things, blocker_->by) : nullptr;
  stand_off_.update(scene.time, robot, by ? std::optional(*by) : std::nullopt);
}

std::vector<Cylinder> Course::ground_to_leave(const std::vector<MovingThing>& things) {
  const MovingThing* const rival =
      find(things, aim_ == Aim::aside ? makes_room_ : stand_off_.due());
  if (!rival) return {};
  makes_room_ = rival->cylinder.id;
  ground_ = ground_needed(*rival);
  return ground_;
}

void Course::take(const Plan& plan, Reason reason, const Scene& scene, ReplanPolicy& policy) {
  if (keeps(plan, reason, scene, policy)) return;
  change(plan, reason, scene, policy);
  blocker_.reset();
  const bool waits = aim_ == Aim::waits && plan.status == PlanStatus::closed;
  aim_ = plan.status == PlanStatus::found   ? Aim::goal
         : plan.status == PlanStatus::retreat ? Aim::aside
         : waits                            ? Aim::waits
                                            : Aim::closed;
}

void Course::change(const Plan& plan, Reason reason, const Scene& scene, ReplanPolicy& policy) {
  if (following() && scene.robot) {
    const double moved = Churn::moved(guidance_.remaining(scene.robot->position), plan.path);
    churn_.add(scene.time, moved);
    if (moved > 0.0 && reason != Reason::new_goal && reason != Reason::map_changed)
      policy.chose(scene.time);
    const bool aside = !to_goal_ || plan.status == PlanStatus::retreat;
    if (moved > kElsewhere && !aside) {
      ++reroutes_;
      reroute_reason_ = reason;
    }
  }
  guidance_.follow(plan.path);
  to_goal_ = plan.status != PlanStatus::retreat;
  shortest_length_ = plan.shortest;
  smoothing_price_ = length_of(plan.path) - plan.shortest;
}

bool Course::keeps(const Plan& plan, Reason reason, const Scene& scene, ReplanPolicy& policy) {
  if (!following() || !scene.robot) return false;
  const Pose& robot = *scene.robot;
  const Path remaining = guidance_.remaining(robot.position);
  const Path fresh = plan.status == PlanStatus::found ? plan.path : Path{};
  const bool held =
      aim_ == Aim::goal && policy.holds(scene.time, remaining, fresh, scene.obstacles, scene.pace);
  if (reason == Reason::new_goal || reason == Reason::map_changed ||
      guidance_.heading(robot).path_offset > config_.off_path)
    return false;
  const std::vector<Cylinder> none;
  const bool sees_next = guidance_.sees_next(robot.position, {scene.floor, &none});
  if (held) return sees_next;
  if (plan.status == PlanStatus::retreat)
    return aim_ == Aim::aside && !policy.blocked(remaining, scene.obstacles) && sees_next;
  if (plan.status == PlanStatus::closed)
    return aim_ == Aim::closed && sees_next &&
           !policy.worth_changing(Reason::period, remaining, plan.path);
  if (aim_ != Aim::goal) return false;
  return !policy.worth_changing(reason, remaining, fresh) &&
         !policy.blocked(remaining, scene.obstacles) &&
         guidance_.sees_next(robot.position, scene.space());
}

void Course::tell_unrest(Status& status, double time) const {
  status.reroutes = reroutes_;
  status.reroute_reason = reroute_reason_;
  status.churn = churn_.per_minute(time);
}

void Course::tell(Status& status, const Scene& scene, const ReplanPolicy& policy) const {
  status.state = State::following;
  status.heading = guidance_.heading(*scene.robot);
  status.eta = status.heading.goal_distance / scene.pace;
  status.shortest_length = shortest_length_;
  status.smoothing_price = smoothing_price_;
  if (!to_goal_) status.heading.waypoint_is_goal = false;
  if (aim_ == Aim::aside) {
    status.state = State::make_room;
    status.blocked = Way::Wait{*makes_room_, 0.0, 0.0};
  }
  std::optional<Way::Wait> waits = blocker_ ? blocker_ : policy.waits_for();
  if (aim_ == Aim::waits) waits = Way::Wait{*makes_room_, 0.0, -1.0};
  if (!waits) return;
  status.state = State::blocked;
  status.blocked = waits;
}

}  // namespace navvi_nav
