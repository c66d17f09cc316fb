#include "navvi_floor/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "navvi_floor/octomap_reader.hpp"
#include "navvi_floor/resample.hpp"

namespace navvi_floor {
namespace {

constexpr double kStraight = 1e-6;  // rad, or cells

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
  if (!std::isfinite(grid.yaw)) return "the occupancy grid's yaw is not finite";
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

/// What a cell is that overlaps these: an obstacle if one of them is, floor only if all are.
Ground joined(Ground a, Ground b) {
  if (a == Ground::obstacle || b == Ground::obstacle) return Ground::obstacle;
  return a == Ground::none || b == Ground::none ? Ground::none : Ground::floor;
}

/// A turned grid in cells of the same size along the axes of map. \return nullopt if they are too
/// many
std::optional<GroundGrid> straight(const GroundGrid& turned, double yaw) {
  const Point along{std::cos(yaw), std::sin(yaw)}, across{-along.y, along.x};
  const double side = turned.cell_size;
  const Point right = (side * turned.columns) * along, up = (side * turned.rows) * across;
  const Point size{std::abs(right.x) + std::abs(up.x), std::abs(right.y) + std::abs(up.y)};
  GroundGrid out{side, turned.origin, 0, 0, {}};
  out.origin = turned.origin + Point{std::min(right.x, 0.0) + std::min(up.x, 0.0),
                                     std::min(right.y, 0.0) + std::min(up.y, 0.0)};
  if (size.x / side * (size.y / side) > kMaxCells) return std::nullopt;
  out.columns = static_cast<int>(std::ceil(size.x / side - kStraight));
  out.rows = static_cast<int>(std::ceil(size.y / side - kStraight));
  const double half = 0.5 * (std::abs(along.x) + std::abs(along.y)) - kStraight;  // cells
  for (int row = 0; row < out.rows; ++row)
    for (int column = 0; column < out.columns; ++column) {
      const Point middle = out.origin + Point{side * (column + 0.5), side * (row + 0.5)};
      const Point from = middle - turned.origin;
      const Point at{dot(from, along) / side, dot(from, across) / side};
      Ground ground = Ground::floor;
      for (int y = static_cast<int>(std::floor(at.y - half)); y <= at.y + half; ++y)
        for (int x = static_cast<int>(std::floor(at.x - half)); x <= at.x + half; ++x) {
          const bool inside = x >= 0 && y >= 0 && x < turned.columns && y < turned.rows;
          const auto cell = static_cast<std::size_t>(y) * static_cast<std::size_t>(turned.columns) +
                            static_cast<std::size_t>(x);
          ground = joined(ground, inside ? turned.ground[cell] : Ground::none);
        }
      out.ground.push_back(ground);
    }
  return out;
}

}  // namespace

MapSurvey read_grid(const OccupancyGrid& grid, const SurveyConfig& config) {
  MapSurvey refused;
  refused.error = refusal_of(grid);
  if (!refused.error.empty()) return refused;
  GroundGrid ground{grid.resolution, grid.origin, grid.width, grid.height, {}};
  ground.ground.reserve(grid.cells.size());
  for (const std::int8_t cell : grid.cells) ground.ground.push_back(ground_of(cell));
  if (std::abs(grid.yaw) < kStraight) return resample(ground, config);
  std::optional<GroundGrid> along_map = straight(ground, grid.yaw);
  if (along_map) return resample(*along_map, config);
  refused.error = "the occupancy grid is turned, and has more than " + millions(kMaxCells) +
                  " cells along the axes of map";
  return refused;
}

}  // namespace navvi_floor
