#include "navvi_safety/assistance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_safety {
namespace {

using namespace navvi_types;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kReacts = 0.1;    // s, from what is seen to the brakes
constexpr double kMargin = 0.06;   // m, left when the robot has come to rest
constexpr double kBrush = 0.03;    // m; a thing that is missed by less is touched
constexpr double kRound = 0.3;     // m, radius of a thing behind its nearest point
constexpr double kStep = 0.05;     // s
constexpr double kForesees = 1.5;  // s
constexpr double kStays = 3.0;     // s; what would hit a robot that stands cannot be avoided
constexpr double kMemory = 0.4;    // s, of a track
constexpr double kShort = 0.2;     // s; a velocity is not known from less
constexpr double kJump = 0.3;      // m; another part of the thing is nearest now
constexpr double kStale = 0.5;     // s; what is near is not known any more
constexpr double kBlind = 0.25;    // share of the speed that is left then
constexpr double kBend = 0.2;      // rad/s, a step of turning away
constexpr double kMostBend = 0.8;  // rad/s
constexpr double kSpeeds[] = {1.0, 0.7, 0.4, 0.2};  // shares of the person's speed
constexpr double kStraight = 0.1;  // rad/s; a slower turn has no side
constexpr double kFelt = 0.9;      // of the person's speed; what leaves more is not told
constexpr double kLasts = 0.4;     // s, that something is told at least

/// A shelf or wall goes on where its nearest point ends.
bool is_long(ThingClass thing) { return thing == ThingClass::shelf || thing == ThingClass::wall; }

/// After it drove so for a time, s, in base_link as it is now.
Pose2 driven(const Velocity& robot, double time) {
  const double course = 0.5 * robot.angular * time;
  const double chord = std::abs(course) > 1e-6 ? std::sin(course) / course : 1.0;
  return {robot.linear * time * chord * Eigen::Vector2d(std::cos(course), std::sin(course)),
          2.0 * course};
}

}  // namespace

Eigen::Vector2d Assistance::Seen::velocity() const {
  const double passed = track.back().first - track.front().first;
  if (!thing.moving || passed < kShort) return Eigen::Vector2d::Zero();
  return (track.back().second - track.front().second) / passed;
}

void Assistance::drive(double time) {
  if (time < time_) {
    seen_.clear();
    seen_at_.reset();
  }
  const Pose2 moved = driven(velocity_, time - time_);
  pose_ = {pose_.to_parent(moved.position), pose_.yaw + moved.yaw};
  time_ = time;
}

void Assistance::see(const std::vector<NearThing>& nearby, double time) {
  drive(time);
  seen_at_ = time;
  std::map<std::uint32_t, Seen> seen;
  for (const NearThing& thing : nearby) {
    auto track = std::move(seen_[thing.id].track);
    const Eigen::Vector2d point = pose_.to_parent(thing.nearest);
    if (!track.empty() && (track.back().second - point).norm() > kJump) track.clear();
    track.emplace_back(time, point);
    while (time - track.front().first > kMemory) track.erase(track.begin());
    seen[thing.id] = {thing, Eigen::Rotation2Dd(pose_.yaw) * thing.nearest.normalized(),
                      std::move(track)};
  }
  seen_ = std::move(seen);
}

double Assistance::until_touched(const Seen& seen, const Velocity& robot, double horizon) const {
  const bool is_plane = is_long(seen.thing.thing_class);
  const double behind = is_plane ? 0.0 : kRound;
  const double reach = seen.thing.nearest.norm() - seen.thing.gap + kBrush + behind;
  const Eigen::Vector2d nearest = pose_.to_local(seen.track.back().second);
  const Eigen::Rotation2Dd turned(-pose_.yaw);
  const Eigen::Vector2d velocity = turned * seen.velocity(), way = turned * seen.way;
  const Eigen::Vector2d point = nearest + behind * way;
  double before = kNever;
  for (double time = 0.0; time <= horizon; time += kStep) {
    const Eigen::Vector2d off = point + velocity * time - driven(robot, time).position;
    const double distance = is_plane ? off.dot(way) : off.norm();
    // What is all but touched may be left.
    if (time > 0.0 && distance < reach && distance < before)
      return time - kStep * std::min(1.0, (reach - distance) / (before - distance));
    before = distance;
  }
  return kNever;
}

double Assistance::allowed(const Velocity& wanted) const {
  const double speed = std::abs(wanted.linear);
  double most = speed;
  for (const auto& [id, seen] : seen_) {
    const double left = until_touched(seen, wanted, kForesees);
    if (left == kNever) continue;
    if (seen.thing.moving && until_touched(seen, {}, kStays) == kNever) return 0.0;
    const double room = std::max(0.0, speed * (left - kReacts) - kMargin);
    most = std::min(most, std::sqrt(2.0 * kBrakes * room));
  }
  return std::copysign(most, wanted.linear);
}

bool Assistance::is_free(const Velocity& wanted) const {
  return std::all_of(seen_.begin(), seen_.end(), [&](const auto& thing) {
    return until_touched(thing.second, wanted, kForesees) == kNever;
  });
}

/// The least turn away from what would be hit, at the most speed at which one is enough.
std::optional<Velocity> Assistance::way_round(const Velocity& wanted) const {
  const double first = does_ == Does::steers_right ? -1.0 : 1.0;
  for (const double share : kSpeeds) {
    for (double bend = 0.0; bend <= kMostBend + 1e-9; bend += kBend) {
      for (const double side : {first, -first}) {
        if (side * wanted.angular < -kStraight) continue;
        const Velocity other{share * wanted.linear, wanted.angular + side * bend};
        if (is_free(other)) return other;
      }
    }
  }
  return std::nullopt;
}

Velocity Assistance::kept_off(const Velocity& wanted) const {
  if (steers_ && wanted.linear > 0.0)
    if (const auto round = way_round(wanted)) return *round;
  return {allowed(wanted), wanted.angular};
}

Velocity Assistance::assist(const Velocity& wanted, double time) {
  if (!on_) return wanted;
  drive(time);
  velocity_ = wanted;
  if (seen_at_ && time - *seen_at_ <= kStale)
    velocity_ = kept_off(wanted);
  else
    velocity_.linear *= kBlind;
  const double turn = velocity_.angular - wanted.angular;
  tell(turn > 0.0   ? Does::steers_left
       : turn < 0.0 ? Does::steers_right
       : std::abs(velocity_.linear) < kFelt * std::abs(wanted.linear) ? Does::slows
                                                                       : Does::nothing,
       time);
  return velocity_;
}

void Assistance::tell(Does does, double time) {
  const bool held = does_ != Does::nothing && time >= told_ && time - told_ < kLasts;
  if (does != does_ && held) return;
  does_ = does;
  told_ = time;
}

}  // namespace navvi_safety
