#include "map/occupancy_grid.hpp"

#include <cmath>

#include "map/octomap_reader.hpp"
#include "map/resample.hpp"

namespace navvi_nav::map {
namespace {

constexpr double kStraight = 1e-6;  // rad

std::string refusal_of(const OccupancyGrid& grid) {
  if (grid.width <= 0 || grid.height <= 0) return "the occupancy grid has no cells";
  if (!std::isfinite(grid.resolution) || grid.resolution < kMinResolution ||
      grid.resolution > kMaxResolution)
    return "the occupancy grid's resolution is not within 0.01 and 1 m";
  if (static_cast<double>(grid.width) * grid.height > kMaxCells)
    return "the occupancy grid has more than " + millions(kMaxCells) + " cells";
  if (grid.cells.size() !=
      static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height))
    return "the occupancy grid holds " + std::to_string(grid.cells.size()) + " cells where " +
           std::to_string(grid.width) + " x " + std::to_string(grid.height) + " are announced";
  if (!finite(grid.origin)) return "the occupancy grid's origin is not finite";
  if (!(std::abs(grid.yaw) < kStraight))
    return "the occupancy grid is turned by " + std::to_string(grid.yaw) +
           " rad; only grids along the axes of map (yaw 0) can be read";
  for (const std::int8_t cell : grid.cells) {
    if (cell < -1 || cell > 100)
      return "the occupancy grid holds the value " + std::to_string(cell) +
             "; -1 and 0 to 100 are allowed";
  }
  return {};
}

Ground ground_of(std::int8_t cell) {
  if (cell < 0) return Ground::none;
  if (cell > 100.0 * kOccupiedAbove) return Ground::obstacle;
  return cell < 100.0 * kFreeBelow ? Ground::floor : Ground::none;
}

}  // namespace

MapSurvey read_grid(const OccupancyGrid& grid, const SurveyConfig& config) {
  MapSurvey refused;
  refused.error = refusal_of(grid);
  if (!refused.error.empty()) return refused;
  GroundGrid ground{grid.resolution, grid.origin, grid.width, grid.height, {}};
  ground.ground.reserve(grid.cells.size());
  for (const std::int8_t cell : grid.cells) ground.ground.push_back(ground_of(cell));
  return resample(std::move(ground), config);
}

}  // namespace navvi_nav::map
