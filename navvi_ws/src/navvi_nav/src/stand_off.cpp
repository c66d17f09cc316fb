#include "navvi_nav/stand_off.hpp"

namespace navvi_nav {
namespace {

constexpr double kAhead = 8.0;                // m, of its way that a thing is given
constexpr double kTurn = 1.2;                 // m, about its front
constexpr double kBeside = 0.2;               // m
constexpr double kFaces = 60.0 / 180 * M_PI;  // rad, from its heading to the robot
constexpr int kOften = 2;  // who stays although room was made is not waiting for the robot

bool faces(const MovingThing& thing, Point robot) {
  const Point heading{std::cos(thing.yaw), std::sin(thing.yaw)};
  const Point away = robot - thing.cylinder.center;
  return std::abs(std::atan2(cross(heading, away), dot(heading, away))) <= kFaces;
}

}  // namespace

void StandOffConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"make_room_after", Range{0.0, 600.0}, "s",
         "what closes the only way and faces the robot for so long is made room for; 0: never"},
        make_room_after);
  visit({"wait_aside", Range{0.0, 600.0}, "s", "how long it is then given to pass"}, wait_aside);
}

std::vector<Cylinder> ground_needed(const MovingThing& thing) {
  Cylinder one = thing.cylinder;
  const double front = thing.length > 0.0 ? thing.length / 2.0 : one.radius;
  const double half = thing.width > 0.0 ? thing.width / 2.0 : one.radius;
  const Pose place{thing.cylinder.center, thing.yaw};
  std::vector<Cylinder> out;
  one.center = to_parent(place, {front, 0.0});
  one.radius = half + kTurn;
  out.push_back(one);
  one.radius = half + kBeside;
  for (double ahead = front; ahead <= front + kAhead; ahead += one.radius) {
    one.center = to_parent(place, {ahead, 0.0});
    out.push_back(one);
  }
  return out;
}

void StandOff::update(double time, Point robot, const std::optional<MovingThing>& blocker) {
  const std::optional<std::uint32_t> by =
      blocker && faces(*blocker, robot) ? std::optional(blocker->cylinder.id) : std::nullopt;
  if (by != blocker_) since_ = time;
  blocker_ = by;
  const bool long_enough =
      by && config_.make_room_after > 0.0 && time - since_ >= config_.make_room_after;
  const auto before = by ? yielded_.find(*by) : yielded_.end();
  const bool of_use = before == yielded_.end() || before->second < kOften;
  due_ = long_enough && of_use ? by : std::nullopt;
}

void StandOff::went_aside(double time, std::uint32_t thing) {
  ++yielded_[thing];
  aside_for_ = thing;
  aside_since_ = time;
  blocker_.reset();
  due_.reset();
}

std::optional<std::uint32_t> StandOff::aside_for(double time) const {
  return aside_for_ && time - aside_since_ < config_.wait_aside ? aside_for_ : std::nullopt;
}

void StandOff::reset() {
  blocker_.reset();
  due_.reset();
  aside_for_.reset();
}

void StandOff::forget() {
  reset();
  yielded_.clear();
}

}  // namespace navvi_nav
