#include "scenario/free_places.hpp"

#include <algorithm>
#include <functional>

#include "description/sentence.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr double kStands = 0.1;  // m above the floor, that things rise at least
constexpr int kWallsOfRoom =
    7;  // of 8 directions, in which something stands around a place in a room
constexpr std::size_t kFew = 10;  // one in so many places: too few to be rooms

/// Keeps only those that meet the condition, if they are more than `few`.
template <typename Condition>
void keep(FreePlaces::Places& places, std::size_t few, const Condition& condition) {
  const auto count = std::count_if(places.begin(), places.end(), condition);
  if (static_cast<std::size_t>(count) > few)
    places.erase(std::remove_if(places.begin(), places.end(), std::not_fn(condition)),
                 places.end());
}

/// Sets `marks` where the polygon, grown by `gap` m, holds the cell's centre.
void mark(const FloorGrid& grid, const Polygon& polygon, double gap,
          std::vector<std::uint8_t>& marks) {
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& corner : polygon) bounds.extend(corner);
  const Ground ground(polygon);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(gap);
  grid.for_each_row_in({bounds.min() - reach, bounds.max() + reach}, [&](std::size_t begin,
                                                                         std::size_t end) {
    // It is convex: what it holds of a row hangs together.
    const auto holds = [&](std::size_t cell) { return ground.holds(grid.centre(cell), gap); };
    while (begin < end && !holds(begin)) ++begin;
    while (begin < end && !holds(end - 1)) --end;
    std::fill_n(marks.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, std::uint8_t{1});
  });
}

}  // namespace

FreePlaces::FreePlaces(const WorldDescription& world, const FloorGrid& grid,
                       const ScenarioConfig& config)
    : world_(world),
      grid_(grid),
      config_(config),
      hull_(hull_of_what_stands(world)),
      blocks_(world, grid, config.robot_radius + config.clearance) {
  all_ = grid.cells_clear_by(config.robot_radius + config.clearance);
  keep(all_, 0, [&](std::size_t cell) { return !blocks_.holds(cell); });
  std::vector<std::uint8_t> in_hull(grid.size(), 0);
  if (hull_.size() > 2) mark(grid, hull_, 0.0, in_hull);
  keep(all_, 0, [&](std::size_t cell) { return in_hull[cell] != 0; });
  const std::vector<std::uint8_t> walls = grid.walls_around();
  keep(all_, all_.size() / kFew, [&](std::size_t cell) { return walls[cell] >= kWallsOfRoom; });
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
  std::vector<std::uint8_t> swept(grid_.size(), 0);
  for (const Polygon& ground : traffic::swept_ground(world_, config_.movers))
    mark(grid_, ground, config_.robot_radius + config_.off_lanes, swept);
  quiet_ = those(all_, [&](std::size_t cell) { return swept[cell] == 0; });
}

FreePlaces::Places FreePlaces::away_from_movers(const Places& all) const {
  std::vector<std::uint8_t> near(grid_.size(), 0);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(config_.mover_distance);
  for (const Thing& thing : world_.things) {
    if (!thing.route) continue;
    const Eigen::Vector2d at = thing.pose.translation().head<2>();
    grid_.for_each_row_in({at - reach, at + reach}, [&](std::size_t cell, std::size_t end) {
      for (; cell < end; ++cell)
        if ((at - grid_.centre(cell)).norm() < config_.mover_distance) near[cell] = 1;
    });
  }
  Places places = those(all, [&](std::size_t cell) { return near[cell] == 0; });
  return places.empty() ? all : places;
}

}  // namespace navvi_sim::scenario
