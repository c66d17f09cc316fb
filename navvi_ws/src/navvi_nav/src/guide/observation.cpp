#include "guide/observation.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_nav::guide {

constexpr double kMoving = 0.1;     // m/s
constexpr double kMemory = 10.0;    // s, time constant of the pace

void ObservationConfig::describe(navvi_config::Visitor& visit) {
  visit(most_cylinders, "most_cylinders", navvi_config::Range{1.0, 4.0}, "",
        "as which a long thing is taken, in a row; 1: the one about it (R-NAV-4)");
}

void Observation::set_obstacles(std::vector<MovingThing> things, double time) {
  std::vector<Moved> moved;
  moved.reserve(things.size());
  obstacles_.clear();
  for (const MovingThing& thing : things) {
    const Moved now{thing.id, time};
    const auto before = std::lower_bound(moved_.begin(), moved_.end(), now, by_id);
    const bool moves = norm(to_point(thing.velocity)) > kStandingSpeed;
    const bool moved_before = before != moved_.end() && before->id == thing.id;
    if (moves || moved_before) moved.push_back(moves ? now : *before);
    for (Cylinder part : cylinders_of(thing, config_.most_cylinders)) {
      if (moves || moved_before) part.stood = time - moved.back().time;
      obstacles_.push_back(part);
    }
  }
  if (!std::is_sorted(moved.begin(), moved.end(), by_id))
    std::sort(moved.begin(), moved.end(), by_id);
  things_ = std::move(things);
  moved_ = std::move(moved);
  obstacles_time_ = time;
  obstacles_rejected_ = false;
}

void Observation::set_pose(const Pose2& pose, double stamp) {
  pose_ = pose;
  pose_time_ = stamp;
}

std::optional<Pose2> Observation::foreseen() const {
  if (!pose_ || foresight_ == 0.0) return pose_;
  const double turn = velocity_.angular * foresight_;
  const double course = pose_->yaw + 0.5 * turn;
  return Pose2{pose_->position +
                   velocity_.linear * foresight_ * Eigen::Vector2d(std::cos(course), std::sin(course)),
               pose_->yaw + turn};
}

void Observation::update(double time) {
  if (!velocity_time_) velocity_time_ = time;
  if (!velocity_fresh(time)) velocity_ = {};
  const double elapsed = updated_ ? std::clamp(time - *updated_, 0.0, 1.0) : 0.0;
  updated_ = time;
  if (obstacles_lost()) obstacles_.clear();
  if (speed() > kMoving) pace_ += (speed() - pace_) * (1.0 - std::exp(-elapsed / kMemory));
}

void Observation::reset_times() {
  pose_.reset();
  velocity_time_.reset();
  things_.clear();
  moved_.clear();
  obstacles_.clear();
  obstacles_time_.reset();
  updated_.reset();
  obstacles_rejected_ = false;
}

std::optional<Pose2> Observation::pose(double time) const {
  return time - pose_time_ <= config_.kPoseTimeout ? pose_ : std::nullopt;
}

std::optional<MovingThing> Observation::thing(std::optional<std::uint32_t> id) const {
  for (const MovingThing& one : things_) {
    if (id && one.id == *id) return one;
  }
  return std::nullopt;
}

}  // namespace navvi_nav::guide
