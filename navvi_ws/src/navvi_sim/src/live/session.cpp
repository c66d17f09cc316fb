#include "navvi_sim/live/session.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace navvi_sim::live {
namespace {

/// Bit for bit: 0 and -0 are not the same.
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same(const AppliedCommand& last, const navvi_types::Velocity& velocity,
          physics::Braking braking) {
  return same(last.velocity.linear, velocity.linear) &&
         same(last.velocity.angular, velocity.angular) && last.braking == braking;
}

}  // namespace

Session::Session(const WorldDescription& description, const WorldConfig& config, const Pose2& start,
                 std::uint64_t seed)
    : world_(description, config, start, seed),
      step_(config.step),
      hashes_{{0, 0, world_.state_hash()}} {}

World::Status Session::step(const navvi_types::Velocity& command, physics::Braking braking) {
  const World::Status status = world_.step(command, braking);
  if (status != World::Status::running) return status;
  if (commands_.empty() || !same(commands_.back(), command, braking))
    commands_.push_back({steps_, command, braking});
  ++steps_;
  if (due(1.0)) hashes_.push_back({world_.now().stamp(), steps_, world_.state_hash()});
  return status;
}

bool Session::due(double rate) const {
  const auto every = static_cast<std::uint64_t>(std::max(1L, std::lround(1.0 / (rate * step_))));
  return steps_ % every == 0;
}

World::Status replay(Session& session, const std::vector<AppliedCommand>& commands,
                     std::uint64_t steps) {
  AppliedCommand now{0, {}, physics::Braking::emergency};
  auto next = commands.begin();
  World::Status status = World::Status::running;
  while (session.steps() < steps && status == World::Status::running) {
    for (; next != commands.end() && next->step <= session.steps(); ++next) now = *next;
    status = session.step(now.velocity, now.braking);
  }
  return status;
}

}  // namespace navvi_sim::live
