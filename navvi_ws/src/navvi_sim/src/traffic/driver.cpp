#include "traffic/driver.hpp"

#include <algorithm>

#include "description/hash.hpp"

namespace navvi_sim::traffic {
namespace {

constexpr double kForesight = 0.5;  // s, before it would have to brake, it asks
constexpr double kRoom = 3.0;       // m, that a reversing mover leaves the robot more than before
constexpr double kLeastRoom = 0.5;  // m, for less it does not reverse
constexpr double kFarthest = 25.0;  // m, that it reverses in all
constexpr double kGone = 3.0;       // s that the robot is gone before it goes on
constexpr double kAtFirst = 0.1;    // m, nearer to its first way-point a round begins
constexpr double kThere = 1e-9;     // m, nearer is there

/// m from `from` to `to` along a track of `length` that comes round.
double onwards(double from, double to, double length) {
  return to >= from ? to - from : to - from + length;
}

}  // namespace

bool BlockRange::overlaps(const Conflict& conflict, int count) const {
  for (const int round : {0, count})
    if (first <= conflict.last + round && conflict.first + round <= last) return true;
  return false;
}

Driver::Driver(const Lane& track, const LaneUser& entry, const Route& route,
               const MoversConfig& config, std::uint64_t seed)
    : mover(track, entry.start, config, seed),
      lane(&track),
      start_(entry.start),
      clearance_(config.clearance),
      yields_(config.yield && route.yields) {
  double fastest = 0.0;
  for (const Track::Element& element : lane->track.elements())
    if (element.spin == 0.0) fastest = std::max(fastest, element.speed);
  ask_at_ = fastest * fastest / (2.0 * config.acceleration) + kForesight * fastest;
  const int block = lane->block_at(start_);
  const auto segment =
      std::find_if(lane->segments.begin(), lane->segments.end(), [&](const Segment& candidate) {
        return lane->users.size() > 1 ? candidate.end > block : candidate.end >= block;
      });
  next = segment == lane->segments.end()
             ? 0
             : static_cast<std::size_t>(segment - lane->segments.begin());
  if (lane->segments.empty()) {
    mover.allow(lane->track.closed() ? Mover::kFree : lane->track.length());
  } else if (!lane->is_private[static_cast<std::size_t>(block)]) {
    on_shared_ground = true;
  } else if (lane->users.size() == 1) {
    // On private ground it may go to the end of it.
    double zone = lane->waiting_place(lane->segments[next].end);
    if (segment == lane->segments.end()) zone += lane->track.length();
    mover.allow(std::max(start_, zone));
    next = (next + 1) % lane->segments.size();
  }
  const Eigen::Vector2d& first = route.waypoints[0].at;
  if (route.delay > 0.0 && (lane->track.place(start_).position - first).norm() < kAtFirst)
    mover.wait(route.delay);
}

void Driver::drive(const Disc& robot, double dt) {
  const bool backing = mover.backs_out();
  mover.step(room(robot, dt), dt);
  const bool is_kept =
      (backing ? robot_behind : robot_ahead) && mover.speed() == 0.0 && mover.pause_left() <= 0.0;
  kept = is_kept ? kept + dt : 0.0;
  if (goes_back ? !mover.backs_out() && !on_shared_ground : !is_kept) stay();
}

void Driver::press(const Disc& robot, double dt) {
  if (mover.backs_out() && mover.room_behind(robot, 0.0) > 0.0) {
    drive(robot, dt);
    return;
  }
  mover.stop_dead();
  robot_ahead = true;
  kept += dt;
}

/// m it can go in its present direction. Reversing, it stops for the robot even if its route does
/// not yield, because it makes room for the robot. After reversing it drives on when the robot has
/// been gone for a while from all the ground that it gave up.
double Driver::room(const Disc& robot, double dt) {
  robot_ahead = robot_behind = false;
  if (back_to) {
    const double behind = mover.room_behind(robot, clearance_);
    robot_behind = behind <= 0.0;
    if (mover.backs_out()) return behind;
  }
  const double length = lane->track.length();
  const double further = gave_up ? onwards(mover.s(), *gave_up, length) : 0.0;
  const double ahead = yields_ ? mover.room_before(robot, clearance_, further) : Mover::kFree;
  if (!gave_up) {
    robot_ahead = ahead <= 0.0;
    return ahead;
  }
  robot_ahead = ahead < Mover::kFree;
  free_since_ = robot_ahead ? 0.0 : free_since_ + dt;
  if (free_since_ < kGone) return 0.0;
  gave_up.reset();
  if (lane->segments.empty()) mover.allow(lane->track.closed() ? Mover::kFree : length);
  return ahead;
}

/// It no longer wants to reverse.
void Driver::stay() {
  back_to.reset();
  goes_back = false;
}

void Driver::go_on() {
  double zone = lane->waiting_place(lane->segments[next].end);
  while (zone <= mover.allowed() + kThere) zone += lane->track.length();
  mover.allow(zone);
  next = (next + 1) % lane->segments.size();
  on_shared_ground = false;
  stay();
}

void Driver::go_back() {
  const double s = mover.s();
  mover.back_out(*back_to < s ? *back_to : *back_to - lane->track.length());
  goes_back = true;
  next = lane->segment_after(*back_to);
  on_shared_ground = false;
  if (!gave_up) gave_up = s;
  free_since_ = 0.0;
  kept = 0.0;
}

bool Driver::release_ahead() {
  if (mover.backs_out()) {
    kept = 0.0;
    if (lane->segments.empty()) stay();
  } else {
    if (lane->segments.empty() || on_shared_ground) return false;
    const int block = lane->block_at(mover.s());
    if (lane->block_at(std::min(mover.allowed(), lane->track.length())) == block &&
        mover.allowed() <= lane->track.length())
      return false;
  }
  mover.halt();
  next = lane->segment_after(mover.s());
  on_shared_ground = !lane->segments.empty();
  return true;
}

std::optional<double> Driver::place_behind(const Disc& robot,
                                           const std::function<bool(int)>& may_stand) const {
  const double s = mover.s();
  const double length = lane->track.length();
  const double gone = gave_up ? onwards(s, *gave_up, length) : 0.0;
  const double most = std::min(kFarthest, 0.5 * length) - gone;
  const double gap = mover.gap_at(s, robot);
  const int here = lane->block_at(s);
  const int first = lane->track.closed() ? here - lane->blocks : lane->block_at(start_);
  double best = kLeastRoom;
  std::optional<double> found;
  for (int i = here - 1; i >= first && (here - i) * lane->block_length <= most; --i) {
    const int block = (i + lane->blocks) % lane->blocks;
    if (!lane->is_private[static_cast<std::size_t>(block)]) continue;
    if (lane->users.size() > 1) {
      if (!may_stand(block)) break;
      if (std::none_of(lane->segments.begin(), lane->segments.end(),
                       [&](const Segment& segment) { return segment.end == block; }))
        continue;
    }
    const double gain = mover.gap_at(lane->waiting_place(block), robot) - gap;
    if (gain < best) continue;
    best = gain;
    found = lane->waiting_place(block);
    if (gain >= kRoom) break;
  }
  return found;
}

BlockRange Driver::reserved() const {
  const double length = lane->track.length();
  const double round = mover.rear() < 0.0 ? length : 0.0;
  const double allowed = mover.allowed() + round;
  const int last =
      allowed > length ? lane->blocks + lane->block_at(allowed - length) : lane->block_at(allowed);
  return {lane->block_at(mover.rear() + round), last};
}

BlockRange Driver::range_ahead() const {
  const Segment& segment = lane->segments[next];
  return {segment.begin, segment.end >= segment.begin ? segment.end : segment.end + lane->blocks};
}

BlockRange Driver::range_behind() const {
  const int first = lane->block_at(*back_to);
  const int last = lane->block_at(mover.s());
  return {first, last >= first ? last : last + lane->blocks};
}

std::uint64_t Driver::hash(std::uint64_t hash) const {
  hash = mover.hash(hash);
  for (const double value : {kept, back_to.value_or(-1.0), gave_up.value_or(-1.0), free_since_})
    hash = mix(hash, value);
  for (const bool flag : {on_shared_ground, goes_back, robot_ahead, robot_behind})
    hash = mix(hash, std::uint64_t{flag});
  return mix(hash, std::uint64_t{next});
}

}  // namespace navvi_sim::traffic
