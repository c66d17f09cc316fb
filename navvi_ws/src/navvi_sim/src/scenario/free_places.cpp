#include "scenario/free_places.hpp"

#include <algorithm>
#include <iterator>

#include "description/sentence.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr double kStands = 0.1;  // m above the floor, that things rise at least
constexpr int kWallsOfRoom =
    7;  // of 8 directions, in which something stands around a place in a room
constexpr std::size_t kFew = 10;  // one in so many places: too few to be rooms

}  // namespace

FreePlaces::FreePlaces(const WorldDescription& world, const FloorGrid& grid,
                       const ScenarioConfig& config)
    : world_(world), grid_(grid), config_(config) {
  const double clear = config.robot_radius + config.clearance;
  for (std::size_t cell = 0; cell < grid.size(); ++cell)
    if (grid.clearance(cell) >= clear) all_.push_back(cell);
  Places inside;
  const Ground hull(hull_of_what_stands(world));
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(inside),
               [&](std::size_t cell) { return hull.holds(grid.centre(cell), 0.0); });
  if (!inside.empty()) all_ = std::move(inside);
  Places enclosed;
  const std::vector<std::uint8_t> walls = grid.walls_around();
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(enclosed),
               [&](std::size_t cell) { return walls[cell] >= kWallsOfRoom; });
  if (enclosed.size() > all_.size() / kFew) all_ = std::move(enclosed);
  if (all_.empty())
    throw WorldError("world '" + world.name + "' has no place where a robot of radius " +
                     text(config.robot_radius) + " m stands " + text(config.clearance) +
                     " m clear of things; a start needs one");
  find_quiet();
}

bool lies_in(const Polygon& hull, const Eigen::Vector2d& place) {
  return hull.size() > 2 && overlap(hull, {place}, 0.0);
}

Polygon hull_of_what_stands(const WorldDescription& world) {
  std::vector<Eigen::Vector2d> points;
  for (const Thing& thing : world.things) {
    if (thing.route) continue;
    for (const Shape& shape : thing.shapes)
      for (const Eigen::Vector3d& local : hull_points(shape.geometry)) {
        const Eigen::Vector3d point = thing.pose * (shape.pose * local);
        if (point.z() > world.floor_height + kStands) points.emplace_back(point.head<2>());
      }
  }
  return convex_hull(std::move(points));
}

void FreePlaces::find_quiet() {
  const double gap = config_.robot_radius + config_.off_lanes;
  std::vector<bool> swept(grid_.size(), false);
  for (const Polygon& ground : traffic::swept_ground(world_, config_.movers)) {
    Eigen::AlignedBox2d bounds;
    for (const Eigen::Vector2d& corner : ground) bounds.extend(corner);
    const Ground edges(ground);
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(gap);
    grid_.for_each_in({bounds.min() - reach, bounds.max() + reach}, [&](std::size_t cell) {
      if (!swept[cell]) swept[cell] = edges.holds(grid_.centre(cell), gap);
    });
  }
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(quiet_),
               [&](std::size_t cell) { return !swept[cell]; });
}

FreePlaces::Places FreePlaces::away_from_movers(const Places& all) const {
  std::vector<bool> near(grid_.size(), false);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(config_.mover_distance);
  for (const Thing& thing : world_.things) {
    if (!thing.route) continue;
    const Eigen::Vector2d at = thing.pose.translation().head<2>();
    grid_.for_each_in({at - reach, at + reach}, [&](std::size_t cell) {
      if (!near[cell]) near[cell] = (at - grid_.centre(cell)).norm() < config_.mover_distance;
    });
  }
  Places places;
  std::copy_if(all.begin(), all.end(), std::back_inserter(places),
               [&](std::size_t cell) { return !near[cell]; });
  return places.empty() ? all : places;
}

}  // namespace navvi_sim::scenario
