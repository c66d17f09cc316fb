#include "batch/sensing_figures.hpp"

#include <algorithm>
#include <vector>

namespace navvi_study::batch {
namespace {

constexpr int kRays = 3;         // of the lidar, on a mover that is in sight
constexpr double kNear = 5.0;    // m
constexpr double kDrives = 0.3;  // m/s
constexpr double kLost = 0.5;    // s out of sight; a new passage begins
constexpr double kTime = 1.5;    // s
constexpr double kSame = 1.0;    // m, between the surfaces of what is told and what is

}  // namespace

void SensingFigures::watch(const ClosedLoop& loop) {
  const bool senses = loop.senses() != nullptr;
  if (senses && !loop.perceived()) return;
  const navvi_sim::live::Snapshot& now = loop.session().world().now();
  const std::vector<navvi_types::MovingThing> nothing;
  const auto& told = senses ? loop.perceived()->things : nothing;
  const auto matches = [](const navvi_types::MovingThing& one,
                          const navvi_types::MovingThing& mover) {
    return (one.pose.position - mover.pose.position).norm() < kSame + mover.radius;
  };
  std::map<std::uint32_t, int> rays;
  if (senses)
    for (const std::uint32_t mover : loop.senses()->scan().movers) ++rays[mover];
  for (const navvi_sim::MoverState& mover : now.movers) {
    const navvi_types::MovingThing& truth = mover.thing;
    if ((senses && rays[truth.id] < kRays) || truth.velocity.norm() < kDrives ||
        (truth.pose.position - now.robot.position).norm() > kNear)
      continue;
    Passage& passage = passages_[truth.id];
    if (passage.since == 0.0 || loop.time() - passage.seen > kLost)
      passage = {loop.time(), loop.time()};
    passage.seen = loop.time();
    for (const navvi_types::MovingThing& one : told) {
      if (!matches(one, truth)) continue;
      passage.told = true;
      if (one.velocity.norm() == 0.0 || passage.drives) continue;
      passage.drives = true;
      lag_ += loop.time() - passage.since;
      ++lags_;
    }
    if (passage.judged || loop.time() - passage.since < kTime) continue;
    passage.judged = true;
    ++passed_;
    if (senses && !passage.told) ++missed_;
  }
  for (const navvi_types::MovingThing& one : told)
    if (one.velocity.norm() > 0.0 &&
        std::none_of(now.movers.begin(), now.movers.end(),
                     [&](const navvi_sim::MoverState& mover) { return matches(one, mover.thing); }))
      ghosts_.insert(one.id);
}

void SensingFigures::add_to(record::Fields& row) const {
  row.set("passed", passed_).set("missed", missed_).set("ghosts", std::uint64_t{ghosts_.size()});
  row.set("lag", lags_ > 0 ? lag_ / static_cast<double>(lags_) : 0.0, 2);
}

}  // namespace navvi_study::batch
