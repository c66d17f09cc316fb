#include "traffic/traffic.hpp"

#include <algorithm>

#include "description/hash.hpp"

namespace navvi_sim::traffic {
namespace {

constexpr std::uint64_t kServeEach = 5;  // steps

}  // namespace

Traffic::Traffic(const WorldDescription& world, const MoversConfig& config, std::uint64_t seed)
    : patience_(config.patience), lanes_(lay_lanes(world, config)) {
  users_.reserve(lanes_.users.size());
  for (std::size_t user = 0; user < lanes_.users.size(); ++user) {
    const LaneUser& entry = lanes_.users[user];
    const Lane& lane = lanes_.lanes[entry.lane];
    const std::size_t count = lane.users.size();
    const auto place = static_cast<std::size_t>(
        std::find(lane.users.begin(), lane.users.end(), user) - lane.users.begin());
    users_.push_back(
        {Driver(lane, entry, *world.things[entry.thing].route, config, (seed << 32) ^ entry.thing),
         lane.users[(place + 1) % count], lane.users[(place + count - 1) % count]});
  }
}

void Traffic::step(const Disc& robot, const std::vector<std::size_t>& pressing, double dt) {
  for (std::size_t user = 0; user < users_.size(); ++user) {
    const bool presses = !pressing.empty() && std::binary_search(pressing.begin(), pressing.end(),
                                                                 lanes_.users[user].thing);
    step(user, robot, presses, dt);
  }
  if (!line_.empty() && steps_ % kServeEach == 0) serve_line();
  ++steps_;
}

void Traffic::step(std::size_t user, const Disc& robot, bool presses, double dt) {
  Driver& driver = users_[user].driver;
  if (presses)
    driver.press(robot, dt);
  else
    driver.drive(robot, dt);
  if (driver.has_waited() && driver.strand()) leave_line(user);
  if (driver.kept > patience_ && !driver.back_to && steps_ % kServeEach == 0) {
    driver.back_to =
        driver.place_behind(robot, [&](int block) { return clear_of_one_behind(user, block); });
    // Who meets nobody need not ask.
    if (driver.back_to && driver.lane->legs.empty()) driver.go_back();
  }
  if (!users_[user].asking && driver.wants_more()) {
    users_[user].asking = true;
    line_.push_back(user);
  }
}

void Traffic::leave_line(std::size_t user) {
  line_.erase(std::remove(line_.begin(), line_.end(), user), line_.end());
  users_[user].asking = false;
  users_[user].claim.reset();
}

void Traffic::serve_line() {
  for (const std::size_t user : line_) users_[user].claim.reset();
  for (std::size_t i = 0; i < line_.size();)
    if (serve(line_[i]))
      leave_line(line_[i]);
    else
      ++i;
}

/// Gives a user that is in the line the way on or the way back. False if neither is free.
bool Traffic::serve(std::size_t user) {
  Driver& driver = users_[user].driver;
  std::optional<Way>& claim = users_[user].claim;
  const Lane& lane = *driver.lane;
  const bool is_kept = driver.robot_ahead && (driver.stranded || driver.gave_up);
  const Obstacle ahead = is_kept || !clear_of_one_ahead(user)
                             ? Obstacle::waiting
                             : obstacle(user, lane.legs[driver.next].crossings);
  if (ahead == Obstacle::none) {
    driver.go_on();
    return true;
  }
  if (ahead == Obstacle::driving) claim = driver.way_on();
  if (!driver.back_to || driver.robot_behind) return false;
  const Way back = driver.way_back();
  const Obstacle behind = obstacle(user, lane.crossings(back.first, back.last % lane.blocks));
  if (behind == Obstacle::none) {
    driver.go_back();
    return true;
  }
  if (behind == Obstacle::driving && !claim) claim = back;
  return false;
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
      const User& rival = users_[other];
      // Who is free to go anywhere touches nobody.
      const bool holds = rival.driver.mover.allowed() != Mover::kFree &&
                         rival.driver.held().meets(crossing, lane.blocks);
      if (holds && rival.driver.stranded) return Obstacle::waiting;
      if (holds || (rival.claim && rival.claim->meets(crossing, lane.blocks)))
        found = Obstacle::driving;
    }
  }
  return found;
}

/// Also of the ground that it means to back out over.
bool Traffic::clear_of_one_ahead(std::size_t user) const {
  if (users_[user].ahead == user) return true;
  const Driver& driver = users_[user].driver;
  const Driver& ahead = users_[users_[user].ahead].driver;
  const Lane& lane = *driver.lane;
  const auto from_here = [&, here = lane.block_at(driver.mover.s())](int block) {
    return (block - here + lane.blocks) % lane.blocks;
  };
  const int there = lane.block_at(ahead.back_to ? *ahead.back_to : ahead.mover.s());
  return from_here(there) >= from_here(lane.legs[driver.next].end) + lane.spacing;
}

/// Whether the one behind on a shared track was given nothing that is too near to `block`, and
/// needs nothing there to leave shared ground.
bool Traffic::clear_of_one_behind(std::size_t user, int block) const {
  if (users_[user].behind == user) return true;
  const Driver& driver = users_[user].driver;
  const Driver& behind = users_[users_[user].behind].driver;
  const Lane& lane = *driver.lane;
  const auto from_there = [&, there = lane.block_at(behind.mover.s())](int other) {
    return (other - there + lane.blocks) % lane.blocks;
  };
  int reach = from_there(behind.held().last % lane.blocks);
  if (behind.stranded) reach = std::max(reach, from_there(lane.legs[behind.next].end));
  return from_there(block) >= reach + lane.spacing &&
         from_there(block) < from_there(lane.block_at(driver.mover.s()));
}

std::uint64_t Traffic::hash(std::uint64_t hash) const {
  for (const User& user : users_) {
    hash = user.driver.hash(hash);
    const Way claim = user.claim.value_or(Way{-1, -1});
    hash = mix(hash, std::uint64_t{static_cast<std::uint32_t>(claim.first)} << 32 |
                         static_cast<std::uint32_t>(claim.last));
  }
  for (const std::size_t user : line_) hash = mix(hash, user);  // these are asking
  return mix(hash, steps_);
}

}  // namespace navvi_sim::traffic
