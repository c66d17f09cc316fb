#include "navvi_sim/mover.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_sim {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSideMargin = 0.10;  // m, left beside what is passed
constexpr double kRightOfWay = 1.0;   // m, added to the look-ahead for who goes first
constexpr double kOnWaypoint = 0.05;  // m, nearer counts as being there
constexpr double kSameCourse = 1e-3;  // rad, a smaller turn is taken while driving
constexpr int kRimPoints = 64;

double wrap(double angle) { return std::remainder(angle, 2.0 * kPi); }

/// Points whose hull contains the geometry, tight within 0.2 % of a radius.
std::vector<Eigen::Vector3d> hull_points(const Geometry& geometry) {
  std::vector<Eigen::Vector3d> points;
  const auto rim = [&](double radius, double z) {
    const double outer = radius / std::cos(kPi / kRimPoints);
    for (int i = 0; i < kRimPoints; ++i) {
      const double angle = 2.0 * kPi * i / kRimPoints;
      points.emplace_back(outer * std::cos(angle), outer * std::sin(angle), z);
    }
  };
  if (const auto* box = std::get_if<Box>(&geometry)) {
    for (int corner = 0; corner < 8; ++corner)
      points.push_back(0.5 *
                       box->size.cwiseProduct(Eigen::Vector3d(
                           (corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1)));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    rim(cylinder->radius, 0.5 * cylinder->length);
    rim(cylinder->radius, -0.5 * cylinder->length);
  } else if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&geometry)) {
    for (const Eigen::Vector3f& vertex : (*mesh)->vertices) points.push_back(vertex.cast<double>());
  }
  return points;
}

/// The way-point that a mover at `position` goes to first: the one after the way-point it stands
/// on, the end of the segment it stands on, or else the first.
std::size_t first_target(const std::vector<Waypoint>& waypoints, const Eigen::Vector2d& position) {
  const std::size_t count = waypoints.size();
  for (std::size_t i = 0; i < count; ++i)
    if ((waypoints[i].at - position).norm() < kOnWaypoint) return (i + 1) % count;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& from = waypoints[i].at;
    const Eigen::Vector2d along = waypoints[(i + 1) % count].at - from;
    const double share = along.dot(position - from) / along.squaredNorm();
    if (share > 0.0 && share < 1.0 && (from + share * along - position).norm() < kOnWaypoint)
      return (i + 1) % count;
  }
  return 0;
}

}  // namespace

void MoversConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Any;
  using navvi_config::Range;
  visit({"yield", Any{}, "", "movers stop for the robot; otherwise they push on"}, yield);
  visit({"acceleration", Range{0.1, 5.0}, "m/s^2", "of movers, to faster and to slower"},
        acceleration);
  visit({"turn_rate", Range{0.1, 6.0}, "rad/s", "of movers, on the spot"}, turn_rate);
  visit(
      {"clearance", Range{0.05, 3.0}, "m", "gap at which movers stop before what is in their way"},
      clearance);
  visit({"patience", Range{1.0, 600.0}, "s",
         "how long movers block each other before one turns back"},
        patience);
  visit({"pause_spread", Range{0.0, 1.0}, "",
         "share by which pauses at way-points vary either way, drawn from the seed"},
        pause_spread);
}

double yaw_of(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d x = pose.linear().col(0);
  return std::hypot(x.x(), x.y()) > 1e-9 ? std::atan2(x.y(), x.x()) : 0.0;
}

Footprint footprint_of(const Thing& thing, const Eigen::Quaterniond& tilt) {
  Footprint print;
  bool any = false;
  const auto add = [&](const Eigen::Vector3d& p, double r) {
    print.front = std::max(print.front, p.x() + r);
    print.back = std::max(print.back, -p.x() + r);
    print.side = std::max(print.side, std::abs(p.y()) + r);
    print.radius = std::max(print.radius, std::hypot(p.x(), p.y()) + r);
    print.bottom = any ? std::min(print.bottom, p.z() - r) : p.z() - r;
    print.top = any ? std::max(print.top, p.z() + r) : p.z() + r;
    any = true;
  };
  for (const Shape& shape : thing.shapes) {
    const Eigen::Isometry3d pose = tilt * shape.pose;
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry))
      add(pose.translation(), sphere->radius);
    for (const Eigen::Vector3d& point : hull_points(shape.geometry)) add(pose * point, 0.0);
  }
  return print;
}

Mover::Mover(std::size_t id, const Thing& thing, const MoversConfig& config, std::uint64_t seed)
    : id_(id),
      config_(config),
      route_(thing.route.value()),
      z_(thing.pose.translation().z()),
      random_(seed * 0x9E3779B97F4A7C15ull + id),
      position_(thing.pose.translation().head<2>()),
      yaw_(yaw_of(thing.pose)) {
  tilt_ =
      Eigen::AngleAxisd(-yaw_, Eigen::Vector3d::UnitZ()) * Eigen::Quaterniond(thing.pose.linear());
  footprint_ = footprint_of(thing, tilt_);
  target_ = first_target(route_.waypoints, position_);
  pause_left_ = route_.delay;
}

Eigen::Isometry3d Mover::pose() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(position_.x(), position_.y(), z_));
  pose.rotate(Eigen::AngleAxisd(yaw_, Eigen::Vector3d::UnitZ()) * tilt_);
  return pose;
}

Eigen::Vector2d Mover::velocity() const {
  return speed_ * Eigen::Vector2d(std::cos(yaw_), std::sin(yaw_));
}

void Mover::step(const Surroundings& around, double dt) {
  turn_rate_ = 0.0;
  if (around.pushing_back || ended_) {
    speed_ = 0.0;
    return;
  }
  if (pause_left_ > 0.0) {
    pause_left_ -= dt;
    return;
  }
  if (turning_ && std::abs(course_error()) < kSameCourse) {
    yaw_ = wrap(yaw_ + course_error());
    turning_ = false;
  }
  const Blocked by = blocked(around);
  if (turning_) {
    if (by == Blocked::no) turn(dt);
    return;
  }
  waited_ = by == Blocked::by_mover && speed_ == 0.0 ? waited_ + dt : 0.0;
  if (waited_ > (around.first.empty() ? 2.0 : 1.0) * config_.patience) {
    backwards_ = !backwards_;
    waited_ = 0.0;
    advance_target();
    return;
  }
  const Waypoint& goal = route_.waypoints[target_];
  const double cruise = goal.speed > 0.0 ? goal.speed : route_.speed;
  const double distance = (goal.at - position_).norm();
  const double limit =
      by == Blocked::no ? std::min(cruise, std::sqrt(2.0 * config_.acceleration * distance)) : 0.0;
  speed_ = std::clamp(limit, by == Blocked::no ? 0.0 : speed_ - 2.0 * config_.acceleration * dt,
                      speed_ + config_.acceleration * dt);
  speed_ = std::max(speed_, 0.0);
  drive(distance, dt);
}

Mover::Blocked Mover::blocked(const Surroundings& around) const {
  if (turning_) {
    const double reach = footprint_.radius + around.robot.radius + 0.5 * kSideMargin;
    const bool sweeps = footprint_.radius > 1.2 * footprint_.side;
    const bool near = (around.robot.centre - position_).norm() < reach;
    return yields() && sweeps && near ? Blocked::by_robot : Blocked::no;
  }
  const double stopping = speed_ * speed_ / (4.0 * config_.acceleration);
  const double reach = stopping + config_.clearance;
  if (yields() && in_way(around.robot, reach)) return Blocked::by_robot;
  for (const Disc& disc : around.first)
    if (in_way(disc, reach + kRightOfWay)) return Blocked::by_mover;
  for (const Disc& disc : around.rest)
    if (in_way(disc, reach)) return Blocked::by_mover;
  return Blocked::no;
}

bool Mover::in_way(const Disc& disc, double reach) const {
  const Eigen::Vector2d local = Eigen::Rotation2Dd(-yaw_) * (disc.centre - position_);
  return std::abs(local.y()) < footprint_.side + disc.radius + kSideMargin &&
         local.x() + disc.radius > footprint_.front &&
         local.x() - disc.radius - footprint_.front < reach;
}

double Mover::course_error() const {
  const Eigen::Vector2d way = route_.waypoints[target_].at - position_;
  return way.norm() > 1e-9 ? wrap(std::atan2(way.y(), way.x()) - yaw_) : 0.0;
}

void Mover::turn(double dt) {
  const double limit = config_.turn_rate * dt;
  const double turn = std::clamp(course_error(), -limit, limit);
  yaw_ = wrap(yaw_ + turn);
  turn_rate_ = turn / dt;
}

void Mover::drive(double distance, double dt) {
  const double move = std::min(speed_ * dt, distance);
  position_ += move * Eigen::Vector2d(std::cos(yaw_), std::sin(yaw_));
  if (distance - move < 1e-6) arrive();
}

void Mover::arrive() {
  position_ = route_.waypoints[target_].at;
  speed_ = 0.0;
  const double share = static_cast<double>(random_() >> 11) * 0x1p-53;  // [0, 1), the same anywhere
  pause_left_ =
      route_.waypoints[target_].pause * (1.0 + config_.pause_spread * (2.0 * share - 1.0));
  ended_ = !route_.loop && target_ + 1 == route_.waypoints.size();
  if (target_ == 0) pause_left_ += route_.delay;
  if (!ended_) advance_target();
}

void Mover::advance_target() {
  const std::size_t count = route_.waypoints.size();
  target_ = (target_ + (backwards_ ? count - 1 : 1)) % count;
  turning_ = true;
}

}  // namespace navvi_sim
