#include "guide/deadlock.hpp"

#include "plan/escape.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kAhead = 8.0;                         // m, of its way that a thing is given
constexpr double kTurn = 1.2;                          // m, about its front
constexpr double kBeside = 0.2;                        // m
constexpr double kWaitAside = 20.0;                    // s, that the other is given to pass
constexpr double kFaces = navvi_types::radians(60.0);  // rad, from its heading to the robot
constexpr int kOften = 2;      // a thing that stays although the robot yielded does not wait for it
constexpr double kNear = 0.4;  // m, from the end of a retreat: near enough out of the swept area
constexpr double kThere = 0.15;  // m, likewise: near enough anywhere

bool faces(const MovingThing& thing, Point robot) {
  const Point heading{std::cos(thing.pose.yaw), std::sin(thing.pose.yaw)};
  const Point away = robot - to_point(thing.pose.position);
  return std::abs(std::atan2(cross(heading, away), dot(heading, away))) <= kFaces;
}

}  // namespace

void DeadlockConfig::describe(navvi_config::Visitor& visit) {
  visit(make_room_after, "make_room_after", navvi_config::Range{0.0, 600.0}, "s",
        "time a thing blocks the only way, facing the robot, until the robot yields; 0: never");
}

std::vector<Cylinder> area_swept_by(const MovingThing& thing) {
  const double front = thing.length > 0.0 ? thing.length / 2.0 : thing.radius;
  const double half = thing.width > 0.0 ? thing.width / 2.0 : thing.radius;
  const auto before = [&thing](double ahead, double radius) {
    return Cylinder{thing.id, to_point(thing.pose.to_parent({ahead, 0.0})), radius, {}};
  };
  std::vector<Cylinder> out{before(front, half + kTurn)};
  const double radius = half + kBeside;
  for (double ahead = front; ahead <= front + kAhead; ahead += radius)
    out.push_back(before(ahead, radius));
  return out;
}

void Deadlock::update(double time, Point robot, const std::optional<MovingThing>& blocker) {
  const std::optional<std::uint32_t> by =
      blocker && faces(*blocker, robot) ? std::optional(blocker->id) : std::nullopt;
  if (by != blocker_) since_ = time;
  blocker_ = by;
  const bool long_enough =
      by && config_.make_room_after > 0.0 && time - since_ >= config_.make_room_after;
  const auto before = by ? yielded_.find(*by) : yielded_.end();
  const bool of_use = before == yielded_.end() || before->second < kOften;
  due_ = long_enough && of_use ? by : std::nullopt;
}

void Deadlock::yield_to(const MovingThing& thing) {
  yields_to_ = thing.id;
  swept_area_ = area_swept_by(thing);
}

bool Deadlock::has_retreated(Point robot, Point end) const {
  const double left = distance(robot, end);
  return left <= kThere ||
         (left <= kNear && !plan::in_a_hole(robot, {nullptr, &swept_area_}, config_.robot_radius));
}

void Deadlock::retreated(double time) {
  ++yielded_[*yields_to_];
  retreated_at_ = time;
  blocker_.reset();
  due_.reset();
}

bool Deadlock::waits(double time) const {
  return retreated_at_ && time - *retreated_at_ < kWaitAside;
}

void Deadlock::reset_times() {
  blocker_.reset();
  due_.reset();
  retreated_at_.reset();
}

void Deadlock::reset() {
  reset_times();
  yields_to_.reset();
  yielded_.clear();
}

}  // namespace navvi_nav::guide
