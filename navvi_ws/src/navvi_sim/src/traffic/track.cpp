#include "traffic/track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_sim::traffic {
namespace {

constexpr double kStraight = 1e-3;     // rad, a smaller turn is none
constexpr double kSharp = 2.0;         // rad, a larger turn is not rounded
constexpr double kLeastRadius = 0.1;   // m, smaller is a turn on the spot
constexpr double kLeastLength = 1e-6;  // m
constexpr double kTurned = 0.3;        // m a rad, that a heading counts
constexpr double kNearestStep = 0.05;  // m

Eigen::Vector2d direction(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }
double heading(const Eigen::Vector2d& along) { return std::atan2(along.y(), along.x()); }

}  // namespace

Pose2 Track::Element::place(double s) const {
  const double distance = s - begin;
  if (spin != 0.0) return {from, navvi_types::wrap(yaw + spin * distance)};
  if (curvature == 0.0) return {from + distance * along, yaw};
  const double turned = curvature * distance;
  const Eigen::Vector2d centre = from + Eigen::Vector2d(-std::sin(yaw), std::cos(yaw)) / curvature;
  return {centre + Eigen::Vector2d(std::sin(yaw + turned), -std::cos(yaw + turned)) / curvature,
          navvi_types::wrap(yaw + turned)};
}

Track::Track(const Route& route, const TrackLimits& limits, const std::vector<double>& radii)
    : closed_(route.loop) {
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < route.waypoints.size(); ++i) {
    const Waypoint& waypoint = route.waypoints[i];
    const double speed = waypoint.speed > 0.0 ? waypoint.speed : route.speed;
    const double pause = waypoint.pause + (i == 0 ? route.delay : 0.0);
    if (!corners.empty() && (corners.back().at - waypoint.at).norm() < kLeastLength)
      corners.back().pause += pause;
    else
      corners.push_back({waypoint.at, radii[i], pause, speed, i});
  }
  if (closed_ && corners.size() > 1 &&
      (corners.back().at - corners.front().at).norm() < kLeastLength) {
    corners.front().pause += corners.back().pause;
    corners.front().speed = corners.back().speed;
    corners.pop_back();
  }
  lay(corners, limits);
  limit_speeds(limits.acceleration);
}

/// One a leg. Each arc takes half a leg at most.
std::vector<Track::Rounding> Track::roundings_of(const std::vector<Corner>& corners) const {
  const std::size_t count = corners.size();
  const std::size_t legs = closed_ ? count : count - 1;
  std::vector<Rounding> roundings(legs);
  for (std::size_t i = 0; i < legs; ++i) {
    if (!closed_ && i + 1 == legs) break;
    const Corner& corner = corners[(i + 1) % count];
    const Eigen::Vector2d in = corner.at - corners[i].at;
    const Eigen::Vector2d out = corners[(i + 2) % count].at - corner.at;
    Rounding& rounding = roundings[i];
    rounding.turn = navvi_types::wrap(heading(out) - heading(in));
    const double size = std::abs(rounding.turn);
    if (corner.pause > 0.0 || size < kStraight || size > kSharp) continue;
    const double room = 0.5 * std::min(in.norm(), out.norm());
    rounding.radius = std::min(corner.radius, room / std::tan(0.5 * size));
    if (rounding.radius < kLeastRadius) rounding.radius = 0.0;
    rounding.tangent = rounding.radius * std::tan(0.5 * size);
  }
  return roundings;
}

/// Each leg is straight from where the last corner's arc ends to where the next one's begins.
void Track::lay(const std::vector<Corner>& corners, const TrackLimits& limits) {
  const std::vector<Rounding> roundings = roundings_of(corners);
  const std::size_t count = corners.size();
  const std::size_t legs = roundings.size();
  for (std::size_t i = 0; i < legs; ++i) {
    const Corner& corner = corners[(i + 1) % count];
    const Rounding& rounding = roundings[i];
    const double before = i > 0 || closed_ ? roundings[(i + legs - 1) % legs].tangent : 0.0;
    const Eigen::Vector2d leg = corner.at - corners[i].at;
    const double yaw = heading(leg);
    const std::size_t waypoint = corner.waypoint;
    Element line{0.0, leg.norm() - before - rounding.tangent,
                 corners[i].at + before * direction(yaw), yaw};
    line.speed = corner.speed;
    line.corner = waypoint;
    const double size = std::abs(rounding.turn);
    const double side = rounding.turn > 0.0 ? 1.0 : -1.0;
    const bool spins = rounding.radius == 0.0 && size >= kStraight;
    line.pause = corner.pause;
    const bool stands = spins || corner.pause > 0.0;
    line.end_speed = stands ? 0.0 : std::numeric_limits<double>::max();
    add(line);
    if (rounding.radius > 0.0) {
      Element arc{0.0, rounding.radius * size, corner.at - rounding.tangent * direction(yaw), yaw,
                  side / rounding.radius};
      arc.speed = std::min({corner.speed, std::sqrt(limits.acceleration * rounding.radius),
                            limits.turn_rate * rounding.radius});
      arc.corner = waypoint;
      arc.end_speed = std::numeric_limits<double>::max();
      add(arc);
    } else if (spins) {
      Element turn{0.0, kSpinArm * size, corner.at, yaw, 0.0, side / kSpinArm};
      turn.speed = limits.turn_rate * kSpinArm;
      turn.corner = waypoint;  // it ends standing: end_speed is 0
      add(turn);
    }
  }
}

void Track::add(Element element) {
  if (element.length < kLeastLength && elements_.empty()) element.length = kLeastLength;
  if (element.length < kLeastLength) {
    elements_.back().pause += element.pause;
    elements_.back().end_speed = std::min(elements_.back().end_speed, element.end_speed);
    return;
  }
  element.begin = length_;
  element.along = direction(element.yaw);
  length_ += element.length;
  elements_.push_back(element);
}

/// Backwards, so that who drives at the most at an element's end can brake for all that follows;
/// twice round, for a closed track has no last element to begin with.
void Track::limit_speeds(double acceleration) {
  const std::size_t count = elements_.size();
  if (!closed_) elements_.back().end_speed = 0.0;
  for (std::size_t i = 2 * count; i-- > 0;) {
    Element& element = elements_[i % count];
    if (!closed_ && i % count + 1 == count) continue;
    const Element& next = elements_[(i + 1) % count];
    const double braking = std::sqrt(next.end_speed < 1e6 ? next.end_speed * next.end_speed +
                                                                2.0 * acceleration * next.length
                                                          : 1e12);
    element.end_speed = std::min({element.end_speed, element.speed, next.speed, braking});
  }
}

std::size_t Track::element_at(double s) const {
  const auto after =
      std::upper_bound(elements_.begin(), elements_.end(), s,
                       [](double value, const Element& element) { return value < element.begin; });
  return after == elements_.begin() ? 0 : static_cast<std::size_t>(after - elements_.begin()) - 1;
}

double Track::nearest(const Pose2& pose) const {
  double best = std::numeric_limits<double>::max();
  double found = 0.0;
  const auto consider = [&](const Element& element, double s) {
    const Pose2 place = element.place(s);
    const double cost = (place.position - pose.position).norm() +
                        kTurned * std::abs(navvi_types::wrap(place.yaw - pose.yaw));
    if (cost < best - 1e-9) {
      best = cost;
      found = s;
    }
  };
  for (const Element& element : elements_) {
    if (element.curvature == 0.0 && element.spin == 0.0) {
      // On a line the heading is the same everywhere: the foot of the perpendicular is nearest.
      const double foot = direction(element.yaw).dot(pose.position - element.from);
      consider(element, element.begin + std::clamp(foot, 0.0, element.length * (1.0 - 1e-9)));
      continue;
    }
    const int steps = std::max(2, static_cast<int>(std::ceil(element.length / kNearestStep)));
    for (int i = 0; i < steps; ++i) consider(element, element.begin + element.length * i / steps);
  }
  return found;
}

}  // namespace navvi_sim::traffic
