#include "scenario/free_places.hpp"

#include <algorithm>
#include <iterator>

#include "description/sentence.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::scenario {

FreePlaces::FreePlaces(const WorldDescription& world, const FloorGrid& grid,
                       const ScenarioConfig& config)
    : world_(world), grid_(grid), config_(config) {
  const double clear = config.robot_radius + config.clearance;
  for (std::size_t cell = 0; cell < grid.size(); ++cell)
    if (grid.clearance(cell) >= clear) all_.push_back(cell);
  if (all_.empty())
    throw WorldError("world '" + world.name + "' has no place where a robot of radius " +
                     text(config.robot_radius) + " m stands " + text(config.clearance) +
                     " m clear of things; a start needs one");
  find_quiet();
}

void FreePlaces::find_quiet() {
  const double gap = config_.robot_radius + config_.off_lanes;
  std::vector<bool> swept(grid_.size(), false);
  Polygon place(1);
  for (const Polygon& ground : traffic::swept_ground(world_, config_.movers)) {
    Eigen::AlignedBox2d bounds;
    for (const Eigen::Vector2d& corner : ground) bounds.extend(corner);
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(gap);
    grid_.for_each_in({bounds.min() - reach, bounds.max() + reach}, [&](std::size_t cell) {
      if (swept[cell]) return;
      place[0] = grid_.centre(cell);
      swept[cell] = overlap(ground, place, gap);
    });
  }
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(quiet_),
               [&](std::size_t cell) { return !swept[cell]; });
}

FreePlaces::Places FreePlaces::away_from_movers(const Places& all) const {
  std::vector<Eigen::Vector2d> movers;
  for (const Thing& thing : world_.things)
    if (thing.route) movers.emplace_back(thing.pose.translation().head<2>());
  Places places;
  for (const std::size_t cell : all) {
    const Eigen::Vector2d place = grid_.centre(cell);
    const bool near = std::any_of(movers.begin(), movers.end(), [&](const Eigen::Vector2d& at) {
      return (at - place).norm() < config_.mover_distance;
    });
    if (!near) places.push_back(cell);
  }
  return places.empty() ? all : places;
}

}  // namespace navvi_sim::scenario
