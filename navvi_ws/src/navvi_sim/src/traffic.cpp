#include "navvi_sim/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace navvi_sim {
namespace {

constexpr double kForesight = 0.5;  // s, that a mover asks before it would have to brake
constexpr double kGiveBack = 3.0;   // s, after which who is kept by the robot gives back ground
constexpr double kRoom = 3.0;       // m, that who backs out leaves the robot more than before
constexpr double kLeastRoom = 0.5;  // m, for less it does not back out
constexpr double kFarthest = 25.0;  // m, that it backs out in all
constexpr double kGone = 3.0;       // s that the robot is gone before it goes on
constexpr double kAtFirst = 0.1;    // m, nearer to its first way-point a round begins
constexpr double kThere = 1e-9;     // m, nearer is there
constexpr std::uint64_t kServeEach = 5;  // steps

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  return (hash ^ word) * 0x100000001B3ull;
}

std::uint64_t mix(std::uint64_t hash, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return mix(hash, bits);
}

/// m from `from` to `to` along a track of `length` that comes round.
double onwards(double from, double to, double length) {
  return to >= from ? to - from : to - from + length;
}

/// True if a way on a track of `count` blocks holds one of the crossing's.
template <typename Way>
bool meets(const Way& way, const Crossing& crossing, int count) {
  for (const int round : {0, count})
    if (way.first <= crossing.last + round && crossing.first + round <= way.last) return true;
  return false;
}

}  // namespace

Traffic::Traffic(const WorldDescription& world, const MoversConfig& config, std::uint64_t seed)
    : config_(config), lanes_(lay_lanes(world, config)) {
  drivers_.reserve(lanes_.users.size());
  for (std::size_t user = 0; user < lanes_.users.size(); ++user) {
    const LaneUser& entry = lanes_.users[user];
    const Lane& lane = lanes_.lanes[entry.lane];
    Driver driver{Mover(lane, entry.start, config, (seed << 32) ^ entry.thing), &lane, entry.start};
    driver.yields = config.yield && world.things[entry.thing].route->yields;
    double fastest = 0.0;
    for (const Track::Element& element : lane.track.elements())
      if (element.spin == 0.0) fastest = std::max(fastest, element.speed);
    driver.ask_at = fastest * fastest / (2.0 * config.acceleration) + kForesight * fastest;
    const auto place = std::find(lane.users.begin(), lane.users.end(), user) - lane.users.begin();
    driver.ahead = lane.users[static_cast<std::size_t>(place + 1) % lane.users.size()];
    driver.behind =
        lane.users[(static_cast<std::size_t>(place) + lane.users.size() - 1) % lane.users.size()];

    const int block = lane.block_at(entry.start);
    const auto leg = std::find_if(lane.legs.begin(), lane.legs.end(), [&](const Leg& candidate) {
      return lane.users.size() > 1 ? candidate.end > block : candidate.end >= block;
    });
    driver.next = leg == lane.legs.end() ? 0 : static_cast<std::size_t>(leg - lane.legs.begin());
    if (lane.legs.empty()) {
      driver.mover.allow(lane.track.closed() ? Mover::kFree : lane.track.length());
    } else if (!lane.is_private[static_cast<std::size_t>(block)]) {
      driver.stranded = true;
    } else if (lane.users.size() == 1) {
      // On private ground it may go to the end of it.
      double refuge = lane.refuge(lane.legs[driver.next].end);
      if (leg == lane.legs.end()) refuge += lane.track.length();
      driver.mover.allow(std::max(entry.start, refuge));
      driver.next = (driver.next + 1) % lane.legs.size();
    }
    const Route& route = *world.things[entry.thing].route;
    const Eigen::Vector2d& first = route.waypoints[0].at;
    if (route.delay > 0.0 && (lane.track.place(entry.start).at - first).norm() < kAtFirst)
      driver.mover.wait(route.delay);
    drivers_.push_back(std::move(driver));
  }
}

void Traffic::step(const Disc& robot, const std::vector<std::size_t>& pressing, double dt) {
  for (std::size_t user = 0; user < drivers_.size(); ++user) {
    Driver& driver = drivers_[user];
    const bool presses = !pressing.empty() && std::binary_search(pressing.begin(), pressing.end(),
                                                                 lanes_.users[user].thing);
    // Who presses the robot and backs out from it may go on doing so.
    if (presses && !(driver.mover.backs_out() && driver.mover.room_behind(robot, 0.0) > 0.0)) {
      driver.mover.stop_dead();
      driver.robot_ahead = true;
      driver.kept += dt;
    } else {
      drive(driver, robot, dt);
    }
    if (driver.kept > kGiveBack) strand(driver, user);
    if (driver.kept > config_.patience && !driver.back_to && steps_ % kServeEach == 0) {
      driver.back_to = place_behind(user, robot);
      if (driver.back_to && driver.lane->legs.empty()) give_back(user);
    }
    if (!driver.asking && !driver.mover.backs_out() &&
        driver.mover.allowed() - driver.mover.s() <= driver.ask_at)
      ask(user);
  }
  if (!line_.empty() && steps_ % kServeEach == 0) serve_line();
  ++steps_;
}

void Traffic::drive(Driver& driver, const Disc& robot, double dt) {
  const bool backing = driver.mover.backs_out();
  const double free = room(driver, robot, dt);
  driver.mover.step(free, dt);
  const bool is_kept = (backing ? driver.robot_behind : driver.robot_ahead) &&
                       driver.mover.speed() == 0.0 && driver.mover.pause_left() <= 0.0;
  driver.kept = is_kept ? driver.kept + dt : 0.0;
  if (driver.goes_back ? !driver.mover.backs_out() && !driver.stranded : !is_kept) {
    driver.back_to.reset();
    driver.goes_back = false;
  }
}

/// m it can go, the way it goes. Who backed out goes on when the robot has been gone for a while
/// from all the ground that it gave up.
double Traffic::room(Driver& driver, const Disc& robot, double dt) {
  driver.robot_ahead = driver.robot_behind = false;
  if (driver.back_to && driver.yields) {
    const double behind = driver.mover.room_behind(robot, config_.clearance);
    driver.robot_behind = behind <= 0.0;
    if (driver.mover.backs_out()) return behind;
  }
  if (driver.mover.backs_out()) return Mover::kFree;
  const double length = driver.lane->track.length();
  const double further = driver.gave_up ? onwards(driver.mover.s(), *driver.gave_up, length) : 0.0;
  const double ahead =
      driver.yields ? driver.mover.room_before(robot, config_.clearance, further) : Mover::kFree;
  if (!driver.gave_up) {
    driver.robot_ahead = ahead <= 0.0;
    return ahead;
  }
  driver.robot_ahead = ahead < Mover::kFree;
  driver.free_since = driver.robot_ahead ? 0.0 : driver.free_since + dt;
  if (driver.free_since < kGone) return 0.0;
  driver.gave_up.reset();
  if (driver.lane->legs.empty())
    driver.mover.allow(driver.lane->track.closed() ? Mover::kFree : length);
  return ahead;
}

/// Keeps only the block it stands in.
void Traffic::strand(Driver& driver, std::size_t user) {
  const Lane& lane = *driver.lane;
  if (driver.mover.backs_out()) {
    driver.mover.halt();
    driver.kept = 0.0;
    if (lane.legs.empty()) {
      driver.back_to.reset();
      driver.goes_back = false;
    }
  } else {
    if (lane.legs.empty() || driver.stranded) return;
    const int block = lane.block_at(driver.mover.s());
    if (lane.block_at(std::min(driver.mover.allowed(), lane.track.length())) == block &&
        driver.mover.allowed() <= lane.track.length())
      return;
    driver.mover.halt();
  }
  driver.next = lane.leg_after(driver.mover.s());
  driver.stranded = !lane.legs.empty();
  leave_line(user);
}

void Traffic::ask(std::size_t user) {
  Driver& driver = drivers_[user];
  const bool at_last_end =
      !driver.lane->track.closed() && driver.mover.allowed() >= driver.lane->track.length();
  if (driver.lane->legs.empty() || at_last_end) return;
  driver.asking = true;
  line_.push_back(user);
}

void Traffic::leave_line(std::size_t user) {
  line_.erase(std::remove(line_.begin(), line_.end(), user), line_.end());
  drivers_[user].asking = false;
  drivers_[user].claim.reset();
}

void Traffic::serve_line() {
  for (const std::size_t user : line_) drivers_[user].claim.reset();
  for (std::size_t i = 0; i < line_.size();)
    if (!serve(line_[i])) ++i;
}

/// Gives a user that is in the line the way on or the way back, if one is free. False if it stays.
bool Traffic::serve(std::size_t user) {
  Driver& driver = drivers_[user];
  const bool is_kept = driver.robot_ahead && (driver.stranded || driver.gave_up);
  const Obstacle ahead = is_kept || !clear_of_one_ahead(user)
                             ? Obstacle::waiting
                             : obstacle(user, driver.lane->legs[driver.next].crossings);
  if (ahead == Obstacle::none) {
    give(user);
    return true;
  }
  if (ahead == Obstacle::driving) driver.claim = way_on(driver);
  if (!driver.back_to || driver.robot_behind) return false;
  const Way back = way_back(driver);
  const Obstacle behind =
      obstacle(user, driver.lane->crossings(back.first, back.last % driver.lane->blocks));
  if (behind == Obstacle::none) {
    give_back(user);
    return true;
  }
  if (behind == Obstacle::driving && !driver.claim) driver.claim = back;
  return false;
}

void Traffic::give(std::size_t user) {
  Driver& driver = drivers_[user];
  const Lane& lane = *driver.lane;
  double refuge = lane.refuge(lane.legs[driver.next].end);
  while (refuge <= driver.mover.allowed() + kThere) refuge += lane.track.length();
  driver.mover.allow(refuge);
  driver.next = (driver.next + 1) % lane.legs.size();
  driver.stranded = false;
  driver.back_to.reset();
  driver.goes_back = false;
  leave_line(user);
}

void Traffic::give_back(std::size_t user) {
  Driver& driver = drivers_[user];
  const double s = driver.mover.s();
  const double to = *driver.back_to;
  driver.mover.back_out(to < s ? to : to - driver.lane->track.length());
  driver.goes_back = true;
  driver.next = driver.lane->leg_after(to);
  driver.stranded = false;
  if (!driver.gave_up) driver.gave_up = s;
  driver.free_since = 0.0;
  driver.kept = 0.0;
  leave_line(user);
}

/// m along its track, the nearest place behind where it is in nobody's way and leaves the robot
/// kRoom more than now; if there is none, where it leaves most.
std::optional<double> Traffic::place_behind(std::size_t user, const Disc& robot) const {
  const Driver& driver = drivers_[user];
  const Lane& lane = *driver.lane;
  const double s = driver.mover.s();
  const double length = lane.track.length();
  const double gone = driver.gave_up ? onwards(s, *driver.gave_up, length) : 0.0;
  const double most = std::min(kFarthest, 0.5 * length) - gone;
  const double gap = driver.mover.gap_at(s, robot);
  const int here = lane.block_at(s);
  const int first = lane.track.closed() ? here - lane.blocks : lane.block_at(driver.start);
  double best = kLeastRoom;
  std::optional<double> found;
  for (int i = here - 1; i >= first && (here - i) * lane.block_length <= most; --i) {
    const int block = (i + lane.blocks) % lane.blocks;
    if (!lane.is_private[static_cast<std::size_t>(block)]) continue;
    if (lane.users.size() > 1) {
      if (!clear_of_one_behind(user, block)) break;
      if (std::none_of(lane.legs.begin(), lane.legs.end(),
                       [&](const Leg& leg) { return leg.end == block; }))
        continue;
    }
    const double gain = driver.mover.gap_at(lane.refuge(block), robot) - gap;
    if (gain < best) continue;
    best = gain;
    found = lane.refuge(block);
    if (gain >= kRoom) break;
  }
  return found;
}

Traffic::Way Traffic::way_on(const Driver& driver) const {
  const Leg& leg = driver.lane->legs[driver.next];
  return {leg.begin, leg.end >= leg.begin ? leg.end : leg.end + driver.lane->blocks};
}

Traffic::Way Traffic::way_back(const Driver& driver) const {
  const int first = driver.lane->block_at(*driver.back_to);
  const int last = driver.lane->block_at(driver.mover.s());
  return {first, last >= first ? last : last + driver.lane->blocks};
}

/// The blocks that it is on or may go to.
Traffic::Way Traffic::held(const Driver& driver) const {
  const Lane& lane = *driver.lane;
  const double length = lane.track.length();
  const double round = driver.mover.rear() < 0.0 ? length : 0.0;
  const double allowed = driver.mover.allowed() + round;
  const int last =
      allowed > length ? lane.blocks + lane.block_at(allowed - length) : lane.block_at(allowed);
  return {lane.block_at(driver.mover.rear() + round), last};
}

/// What is in the way of ground that touches the crossings: who holds it, or somebody further ahead
/// in the line who wants it, for whoever claims now was looked at before.
Traffic::Obstacle Traffic::obstacle(std::size_t user,
                                    const std::vector<Crossing>& crossings) const {
  Obstacle found = Obstacle::none;
  for (const Crossing& crossing : crossings) {
    const Lane& lane = lanes_.lanes[crossing.lane];
    for (const std::size_t other : lane.users) {
      if (other == user) continue;
      const Driver& rival = drivers_[other];
      // Who is free to go anywhere touches nobody.
      const bool holds =
          rival.mover.allowed() != Mover::kFree && meets(held(rival), crossing, lane.blocks);
      if (holds && rival.stranded) return Obstacle::waiting;
      if (holds || (rival.claim && meets(*rival.claim, crossing, lane.blocks)))
        found = Obstacle::driving;
    }
  }
  return found;
}

/// Also of the ground that it means to back out over.
bool Traffic::clear_of_one_ahead(std::size_t user) const {
  const Driver& driver = drivers_[user];
  if (driver.ahead == user) return true;
  const Lane& lane = *driver.lane;
  const Driver& ahead = drivers_[driver.ahead];
  const auto from_here = [&, here = lane.block_at(driver.mover.s())](int block) {
    return (block - here + lane.blocks) % lane.blocks;
  };
  const int there = lane.block_at(ahead.back_to ? *ahead.back_to : ahead.mover.s());
  return from_here(there) >= from_here(lane.legs[driver.next].end) + lane.spacing;
}

/// Whether the one behind on a shared track was given nothing that is too near to `block`, and
/// needs nothing there to leave shared ground.
bool Traffic::clear_of_one_behind(std::size_t user, int block) const {
  const Lane& lane = *drivers_[user].lane;
  const Driver& behind = drivers_[drivers_[user].behind];
  const auto from_there = [&, there = lane.block_at(behind.mover.s())](int other) {
    return (other - there + lane.blocks) % lane.blocks;
  };
  int reach = from_there(held(behind).last % lane.blocks);
  if (behind.stranded) reach = std::max(reach, from_there(lane.legs[behind.next].end));
  return from_there(block) >= reach + lane.spacing &&
         from_there(block) < from_there(lane.block_at(drivers_[user].mover.s()));
}

std::uint64_t Traffic::hash(std::uint64_t hash) const {
  for (const Driver& driver : drivers_) {
    hash = mix(hash, driver.mover.s());
    hash = mix(hash, driver.mover.speed());
    hash = mix(hash, driver.mover.pause_left());
    hash = mix(hash, driver.mover.allowed());
    hash = mix(hash, driver.mover.rear());
    hash = mix(hash, driver.kept);
    hash = mix(hash, driver.back_to.value_or(-1.0));
    hash = mix(hash, driver.gave_up.value_or(-1.0));
    hash = mix(hash, driver.free_since);
  }
  for (const std::size_t user : line_) hash = mix(hash, static_cast<std::uint64_t>(user));
  return hash;
}

}  // namespace navvi_sim
