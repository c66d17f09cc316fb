#include "navvi_sim/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace navvi_sim {
namespace {

constexpr double kForesight = 0.5;  // s, that a mover asks before it would have to brake
constexpr double kGiveBack = 3.0;   // s, after which who is kept by the robot gives back ground
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

/// True if the blocks from `first` to `last`, which may run on past the end of a track of `count`
/// blocks, hold one of the crossing's.
bool meets(int first, int last, const Crossing& crossing, int count) {
  for (const int round : {0, count})
    if (first <= crossing.last + round && crossing.first + round <= last) return true;
  return false;
}

}  // namespace

Traffic::Traffic(const WorldDescription& world, const MoversConfig& config, std::uint64_t seed)
    : config_(config), lanes_(lay_lanes(world, config)) {
  drivers_.reserve(lanes_.users.size());
  for (std::size_t user = 0; user < lanes_.users.size(); ++user) {
    const LaneUser& entry = lanes_.users[user];
    const Lane& lane = lanes_.lanes[entry.lane];
    Driver driver{Mover(lane, entry.start, config, (seed << 32) ^ entry.thing), &lane, user};
    driver.yields = config.yield && world.things[entry.thing].route->yields;
    double fastest = 0.0;
    for (const Track::Element& element : lane.track.elements())
      if (element.spin == 0.0) fastest = std::max(fastest, element.speed);
    driver.ask_at = fastest * fastest / (2.0 * config.acceleration) + kForesight * fastest;
    const auto place = std::find(lane.users.begin(), lane.users.end(), user) - lane.users.begin();
    driver.ahead = lane.users[static_cast<std::size_t>(place + 1) % lane.users.size()];

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
    if (!pressing.empty() &&
        std::binary_search(pressing.begin(), pressing.end(), lanes_.users[user].thing))
      driver.mover.stop_dead();
    else
      drive(driver, robot, dt);
    if (driver.kept > kGiveBack) strand(driver, user);
    if (!driver.asking && driver.mover.allowed() - driver.mover.s() <= driver.ask_at) ask(user);
  }
  if (!line_.empty() && steps_ % kServeEach == 0) serve_line();
  ++steps_;
}

void Traffic::drive(Driver& driver, const Disc& robot, double dt) {
  const double room =
      driver.yields ? driver.mover.room_before(robot, config_.clearance) : Mover::kFree;
  driver.in_robots_way = room <= 0.0;
  driver.mover.step(room, dt);
  driver.kept = driver.in_robots_way && driver.mover.speed() == 0.0 ? driver.kept + dt : 0.0;
}

/// Keeps only the block it stands in.
void Traffic::strand(Driver& driver, std::size_t user) {
  const Lane& lane = *driver.lane;
  driver.kept = 0.0;
  if (lane.legs.empty() || driver.stranded) return;
  const int block = lane.block_at(driver.mover.s());
  if (lane.block_at(std::min(driver.mover.allowed(), lane.track.length())) == block &&
      driver.mover.allowed() <= lane.track.length())
    return;
  driver.mover.allow(driver.mover.s());
  const auto leg = std::find_if(lane.legs.begin(), lane.legs.end(), [&](const Leg& candidate) {
    return lane.refuge(candidate.end) > driver.mover.s() + kThere;
  });
  driver.next = leg == lane.legs.end() ? 0 : static_cast<std::size_t>(leg - lane.legs.begin());
  driver.stranded = true;
  line_.erase(std::remove(line_.begin(), line_.end(), user), line_.end());
  driver.asking = driver.claims = false;
}

void Traffic::ask(std::size_t user) {
  Driver& driver = drivers_[user];
  const bool at_last_end =
      !driver.lane->track.closed() && driver.mover.allowed() >= driver.lane->track.length();
  if (driver.lane->legs.empty() || at_last_end) return;
  driver.asking = true;
  line_.push_back(user);
}

void Traffic::serve_line() {
  for (const std::size_t user : line_) drivers_[user].claims = false;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < line_.size(); ++i) {
    const std::size_t user = line_[i];
    Driver& driver = drivers_[user];
    const Obstacle in_way =
        driver.in_robots_way && driver.stranded ? Obstacle::waiting : obstacle(user);
    driver.claims = in_way == Obstacle::driving;
    if (in_way == Obstacle::none)
      give(user);
    else
      line_[kept++] = user;
  }
  line_.resize(kept);
}

void Traffic::give(std::size_t user) {
  Driver& driver = drivers_[user];
  const Lane& lane = *driver.lane;
  double refuge = lane.refuge(lane.legs[driver.next].end);
  while (refuge <= driver.mover.allowed() + kThere) refuge += lane.track.length();
  driver.mover.allow(refuge);
  driver.next = (driver.next + 1) % lane.legs.size();
  driver.asking = driver.claims = driver.stranded = false;
}

Traffic::Obstacle Traffic::obstacle(std::size_t user) const {
  const Driver& driver = drivers_[user];
  if (!clear_of_one_ahead(user)) return Obstacle::waiting;
  Obstacle found = Obstacle::none;
  for (const Crossing& crossing : driver.lane->legs[driver.next].crossings) {
    const Lane& other_lane = lanes_.lanes[crossing.lane];
    for (const std::size_t other : other_lane.users) {
      if (other == user) continue;
      const Driver& rival = drivers_[other];
      if (holds(rival, crossing)) {
        if (rival.stranded) return Obstacle::waiting;
        found = Obstacle::driving;
      } else if (wants(rival, crossing)) {
        found = Obstacle::driving;
      }
    }
  }
  return found;
}

bool Traffic::clear_of_one_ahead(std::size_t user) const {
  const Driver& driver = drivers_[user];
  if (driver.ahead == user) return true;
  const Lane& lane = *driver.lane;
  const int here = lane.block_at(driver.mover.s());
  const int there = lane.block_at(drivers_[driver.ahead].mover.s());
  const int target = lane.legs[driver.next].end;
  const auto from_here = [&](int block) { return (block - here + lane.blocks) % lane.blocks; };
  return from_here(there) >= from_here(target) + lane.spacing;
}

bool Traffic::holds(const Driver& driver, const Crossing& crossing) const {
  const Lane& lane = *driver.lane;
  const double allowed = driver.mover.allowed();
  if (allowed == Mover::kFree) return false;  // it touches nobody
  const int first = lane.block_at(driver.mover.s());
  const double length = lane.track.length();
  const int last =
      allowed > length ? lane.blocks + lane.block_at(allowed - length) : lane.block_at(allowed);
  return meets(first, last, crossing, lane.blocks);
}

/// True if somebody further ahead in the line wants the ground: whoever claims now was looked at
/// before.
bool Traffic::wants(const Driver& driver, const Crossing& crossing) const {
  if (!driver.claims) return false;
  const Leg& leg = driver.lane->legs[driver.next];
  const int count = driver.lane->blocks;
  return meets(leg.begin, leg.end >= leg.begin ? leg.end : leg.end + count, crossing, count);
}

std::uint64_t Traffic::hash(std::uint64_t hash) const {
  for (const Driver& driver : drivers_) {
    hash = mix(hash, driver.mover.s());
    hash = mix(hash, driver.mover.speed());
    hash = mix(hash, driver.mover.pause_left());
    hash = mix(hash, driver.mover.allowed());
    hash = mix(hash, driver.kept);
  }
  for (const std::size_t user : line_) hash = mix(hash, static_cast<std::uint64_t>(user));
  return hash;
}

}  // namespace navvi_sim
