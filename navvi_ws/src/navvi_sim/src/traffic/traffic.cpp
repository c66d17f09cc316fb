#include "traffic/traffic.hpp"

#include <algorithm>

#include "description/hash.hpp"

namespace navvi_sim::traffic {

constexpr std::uint64_t kServeEach = 5;  // steps

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
  if (!queue_.empty() && steps_ % kServeEach == 0) serve_queue();
  ++steps_;
}

void Traffic::step(std::size_t user, const Disc& robot, bool presses, double dt) {
  Driver& driver = users_[user].driver;
  if (presses)
    driver.press(robot, dt);
  else
    driver.drive(robot, dt);
  if (driver.has_waited() && driver.release_ahead()) leave_queue(user);
  if (driver.kept > patience_ && !driver.back_to && steps_ % kServeEach == 0) {
    driver.back_to =
        driver.place_behind(robot, [&](int block) { return clear_of_one_behind(user, block); });
    // A mover without conflicts need not ask.
    if (driver.back_to && driver.lane->segments.empty()) driver.go_back();
  }
  if (!users_[user].asking && driver.wants_more()) {
    users_[user].asking = true;
    queue_.push_back(user);
  }
}

void Traffic::leave_queue(std::size_t user) {
  queue_.erase(std::remove(queue_.begin(), queue_.end(), user), queue_.end());
  users_[user].asking = false;
  users_[user].claim.reset();
}

void Traffic::serve_queue() {
  for (const std::size_t user : queue_) users_[user].claim.reset();
  for (std::size_t i = 0; i < queue_.size();)
    if (serve(queue_[i]))
      leave_queue(queue_[i]);
    else
      ++i;
}

/// Grants a user in the queue the range ahead or the range behind. False if neither is free.
bool Traffic::serve(std::size_t user) {
  Driver& driver = users_[user].driver;
  std::optional<BlockRange>& claim = users_[user].claim;
  const Lane& lane = *driver.lane;
  const bool is_kept = driver.robot_ahead && (driver.on_shared_ground || driver.gave_up);
  const Obstacle ahead = is_kept || !clear_of_one_ahead(user)
                             ? Obstacle::waiting
                             : obstacle(user, lane.segments[driver.next].conflicts);
  if (ahead == Obstacle::none) {
    driver.go_on();
    return true;
  }
  if (ahead == Obstacle::driving) claim = driver.range_ahead();
  if (!driver.back_to || driver.robot_behind) return false;
  const BlockRange back = driver.range_behind();
  const Obstacle behind = obstacle(user, lane.conflicts(back.first, back.last % lane.blocks));
  if (behind == Obstacle::none) {
    driver.go_back();
    return true;
  }
  if (behind == Obstacle::driving && !claim) claim = back;
  return false;
}

/// What is in the way of ground that touches the conflicts: a mover that has reserved it, or one
/// further ahead in the queue that wants it; claims of this round are of users served before.
Traffic::Obstacle Traffic::obstacle(std::size_t user,
                                    const std::vector<Conflict>& conflicts) const {
  Obstacle found = Obstacle::none;
  for (const Conflict& conflict : conflicts) {
    const Lane& lane = lanes_.lanes[conflict.lane];
    for (const std::size_t other : lane.users) {
      if (other == user) continue;
      const User& rival = users_[other];
      // A mover that may go anywhere touches none.
      const bool holds = rival.driver.mover.allowed() != Mover::kFree &&
                         rival.driver.reserved().overlaps(conflict, lane.blocks);
      if (holds && rival.driver.on_shared_ground) return Obstacle::waiting;
      if (holds || (rival.claim && rival.claim->overlaps(conflict, lane.blocks)))
        found = Obstacle::driving;
    }
  }
  return found;
}

/// Also of the ground that the mover ahead wants to reverse over.
bool Traffic::clear_of_one_ahead(std::size_t user) const {
  if (users_[user].ahead == user) return true;
  const Driver& driver = users_[user].driver;
  const Driver& ahead = users_[users_[user].ahead].driver;
  const Lane& lane = *driver.lane;
  const auto from_here = [&, here = lane.block_at(driver.mover.s())](int block) {
    return (block - here + lane.blocks) % lane.blocks;
  };
  const int there = lane.block_at(ahead.back_to ? *ahead.back_to : ahead.mover.s());
  return from_here(there) >= from_here(lane.segments[driver.next].end) + lane.spacing;
}

/// Whether the mover behind on a shared track has reserved nothing too near to `block`, and needs
/// nothing there to leave shared ground.
bool Traffic::clear_of_one_behind(std::size_t user, int block) const {
  if (users_[user].behind == user) return true;
  const Driver& driver = users_[user].driver;
  const Driver& behind = users_[users_[user].behind].driver;
  const Lane& lane = *driver.lane;
  const auto from_there = [&, there = lane.block_at(behind.mover.s())](int other) {
    return (other - there + lane.blocks) % lane.blocks;
  };
  int reach = from_there(behind.reserved().last % lane.blocks);
  if (behind.on_shared_ground) reach = std::max(reach, from_there(lane.segments[behind.next].end));
  return from_there(block) >= reach + lane.spacing &&
         from_there(block) < from_there(lane.block_at(driver.mover.s()));
}

std::uint64_t Traffic::hash(std::uint64_t hash) const {
  for (const User& user : users_) {
    hash = user.driver.hash(hash);
    const BlockRange claim = user.claim.value_or(BlockRange{-1, -1});
    hash = mix(hash, std::uint64_t{static_cast<std::uint32_t>(claim.first)} << 32 |
                         static_cast<std::uint32_t>(claim.last));
  }
  for (const std::size_t user : queue_) hash = mix(hash, user);
  return mix(hash, steps_);
}

}  // namespace navvi_sim::traffic
