#include "navvi_nav/guide/observation.hpp"

namespace navvi_nav::guide {

void ObservationConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(most_cylinders, "most_cylinders", Range{1.0, 4.0}, "",
        "as which a long thing is taken, in a row; 1: the one about it (R-NAV-4)");
  visit(pose_timeout, "pose_timeout", Range{0.1, 10.0}, "s", "an older pose of the robot is stale");
  visit(obstacle_timeout, "obstacle_timeout", Range{0.1, 10.0}, "s",
        "older obstacles are forgotten");
}

void Observation::set_obstacles(const std::vector<MovingThing>& things, double time) {
  std::map<std::uint32_t, double> moved;
  things_ = things;
  for (MovingThing& thing : things_) {
    Cylinder& one = thing.cylinder;
    const auto before = moved_.find(one.id);
    if (norm(one.velocity) > config_.standing_speed)
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

void Observation::set_pose(const Pose& pose, double time) {
  pose_ = pose;
  pose_time_ = time;
}

void Observation::update(double time) {
  if (obstacles_time_ && !obstacles_fresh(time)) {
    things_.clear();
    obstacles_.clear();
    obstacles_lost_ = true;
  }
  pace_.update(time, speed_);
}

void Observation::reset_times() {
  pose_.reset();
  things_.clear();
  moved_.clear();
  obstacles_.clear();
  obstacles_time_.reset();
  obstacles_lost_ = false;
}

std::optional<Pose> Observation::pose(double time) const {
  return time - pose_time_ <= config_.pose_timeout ? pose_ : std::nullopt;
}

std::optional<MovingThing> Observation::thing(std::optional<std::uint32_t> id) const {
  for (const MovingThing& one : things_) {
    if (id && one.cylinder.id == *id) return one;
  }
  return std::nullopt;
}

bool Observation::obstacles_fresh(double time) const {
  return obstacles_time_ && time - *obstacles_time_ <= config_.obstacle_timeout;
}

}  // namespace navvi_nav::guide
