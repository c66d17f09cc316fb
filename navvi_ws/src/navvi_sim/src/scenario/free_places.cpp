#include "scenario/free_places.hpp"

#include <array>
#include <map>
#include <set>

#include "description/floor_height.hpp"
#include "description/sentence.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr double kStands = 0.1;  // m above the floor, that things rise at least
constexpr int kWallsOfRoom =
    7;  // of 8 directions, in which something stands around a place in a room
constexpr int kAllAround = 8;
constexpr double kFew = 0.1;   // of all places: too few to be rooms
constexpr double kWide = 6.5;  // m, between some of the places, if some of all are so far apart

/// Of the 8 directions, in how many something stands: for each cell. In a room it is in all but
/// those that lead out through a door.
std::vector<std::uint8_t> walls_around(const FloorWays& ways) {
  const std::vector<std::uint8_t> blocked = ways.blocked();
  const std::size_t size = ways.size(), width = ways.width(), height = size / width;
  std::vector<std::uint8_t> count(size, 0), here(width, 0), ahead(width, 0);
  // Along a row: from the first that stands on, and up to the last.
  for (std::size_t row = 0; row < size; row += width) {
    const std::uint8_t* const stands = &blocked[row];
    std::size_t first = 0, end = width;
    while (first < width && stands[first] == 0) ++first;
    if (first == width) continue;
    while (stands[end - 1] == 0) --end;
    std::uint8_t* const here = &count[row];
    for (std::size_t x = first; x < width; ++x) ++here[x];
    for (std::size_t x = 0; x < end; ++x) ++here[x];
  }
  // From row to row, up and down, each straight and to both sides.
  for (const bool up : {true, false}) {
    for (std::size_t side = 0; side < 3; ++side) {
      std::fill(ahead.begin(), ahead.end(), std::uint8_t{0});
      for (std::size_t j = 1; j + 1 < height; ++j) {
        const std::size_t row = (up ? height - 1 - j : j) * width;
        const std::uint8_t* const stands = &blocked[row + 1];
        const std::uint8_t* const before = &ahead[side];
        std::uint8_t* const now = &here[1];
        std::uint8_t* const sum = &count[row + 1];
        const std::size_t inner = width - 2;
        for (std::size_t x = 0; x < inner; ++x) {
          const auto either = static_cast<std::uint8_t>(stands[x] | before[x]);
          now[x] = either;
          sum[x] = static_cast<std::uint8_t>(sum[x] + either);
        }
        std::swap(here, ahead);
      }
    }
  }
  return count;
}

/// Sets `marks` where the polygon, grown by `gap` m, holds the cell's centre.
void mark(const FloorWays& ways, const Polygon& polygon, double gap,
          std::vector<std::uint8_t>& marks) {
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& corner : polygon) bounds.extend(corner);
  const Ground ground(polygon);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(gap);
  const double step = ways.floor().cell_size();
  ways.for_each_row_in({bounds.min() - reach, bounds.max() + reach}, [&](std::size_t begin,
                                                                         std::size_t end) {
    const Eigen::Vector2d first = ways.centre(begin);
    const auto count = static_cast<double>(end - begin);
    const auto [low, high] = ground.along_x(first.y(), gap);
    const auto cells = [&](double x) { return std::clamp((x - first.x()) / step, 0.0, count); };
    end = std::min(end, begin + static_cast<std::size_t>(cells(high)) + 2);
    begin += static_cast<std::size_t>(cells(low));
    // It is convex: what it holds of a row hangs together.
    const auto holds = [&](std::size_t cell) { return ground.holds(ways.centre(cell), gap); };
    while (begin < end && !holds(begin)) ++begin;
    while (begin < end && !holds(end - 1)) --end;
    if (begin >= end) return;
    std::fill_n(marks.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, std::uint8_t{1});
  });
}

}  // namespace

template <typename Condition>
void FreePlaces::keep(const Condition& condition, double share) {
  Places kept = those(all_, condition);
  const double side = side_of(kept);
  if (static_cast<double>(kept.size()) > share * static_cast<double>(all_.size()) &&
      (side >= kWide || side >= side_of(all_)))
    all_ = std::move(kept);
}

FreePlaces::FreePlaces(const WorldDescription& world, const FloorWays& ways,
                       const ScenarioConfig& config)
    : world_(world), ways_(ways), config_(config), hull_(hull_of_what_stands(world)) {
  const double clear = config.robot_radius + config.clearance;
  all_ = ways.cells_clear_by(clear);
  const std::vector<std::uint32_t> part = ways.parts(clear);
  std::vector<std::uint8_t> in_hull(ways.size(), 0);
  if (hull_.size() > 2) mark(ways, hull_, 0.0, in_hull);
  const std::vector<std::uint8_t> walls = walls_around(ways);
  std::vector<std::uint8_t> indoors = in_hull;
  for (std::size_t cell = 0; cell < ways.size(); ++cell)
    if (walls[cell] < kAllAround) indoors[cell] = 0;
  const std::uint32_t main = main_part(part, indoors);
  keep([&](std::size_t cell) { return part[cell] == main; }, 0.0);
  keep([&](std::size_t cell) { return in_hull[cell] != 0; }, 0.0);
  keep([&](std::size_t cell) { return walls[cell] >= kWallsOfRoom; }, kFew);
  if (all_.empty())
    throw WorldError("world '" + world.name + "' has no place where a robot of radius " +
                     text(config.robot_radius) + " m stands " + text(config.clearance) +
                     " m clear of things; a start needs one");
  find_quiet();
}

/// The part of the floor beside which most things stand: not the hollow of a block, nor the yard
/// around a house. Of equal ones, that with the most floor indoors, among several things, or of
/// all.
std::uint32_t FreePlaces::main_part(const std::vector<std::uint32_t>& part,
                                    const std::vector<std::uint8_t>& indoors) const {
  using Rank = std::array<std::size_t, 3>;
  std::map<std::uint32_t, Rank> ranks;
  std::size_t standing = 0;
  const double reach = config_.robot_radius + config_.clearance + 2.0 * ways_.floor().cell_size();
  const Eigen::Vector2d out = Eigen::Vector2d::Constant(reach);
  for (const Thing& thing : world_.things) {
    const Eigen::AlignedBox3d bounds = bounds_of({thing});
    if (thing.route || bounds.isEmpty() || bounds.max().z() < world_.floor_height + kStands)
      continue;
    ++standing;
    std::set<std::uint32_t> beside;
    std::uint32_t last = 0;
    ways_.for_each_row_in({bounds.min().head<2>() - out, bounds.max().head<2>() + out},
                          [&](std::size_t cell, std::size_t end) {
                            for (; cell < end; ++cell)
                              if (part[cell] != last && (last = part[cell]) != 0)
                                beside.insert(last);
                          });
    for (const std::uint32_t one : beside) ++ranks[one][0];
  }
  std::uint32_t last = 0;
  Rank* rank = nullptr;
  for (const std::size_t cell : all_) {
    if (rank == nullptr || part[cell] != last) rank = &ranks[last = part[cell]];
    (*rank)[1] += standing > 1 ? indoors[cell] : 0U;
    ++(*rank)[2];
  }
  const auto best = std::max_element(
      ranks.begin(), ranks.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == ranks.end() ? 0 : best->first;
}

double FreePlaces::side_of(const Places& places) const {
  if (places.empty()) return 0.0;
  const std::size_t width = ways_.width();
  const double tall = ways_.centre(places.back()).y() - ways_.centre(places.front()).y();
  if (tall >= kWide) return tall;
  std::size_t row = 0, low = width, high = 0;
  for (const std::size_t cell : places) {
    while (cell - row >= width) row += width;
    low = std::min(low, cell - row);
    high = std::max(high, cell - row);
  }
  const std::size_t first = places.front() - places.front() % width;
  return (ways_.centre(row + high) - ways_.centre(first + low)).maxCoeff();
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
  std::vector<std::uint8_t> swept(ways_.size(), 0);
  for (const Polygon& ground : traffic::swept_ground(world_, config_.movers))
    mark(ways_, ground, config_.robot_radius + config_.off_lanes, swept);
  quiet_ = those(all_, [&](std::size_t cell) { return swept[cell] == 0; });
}

FreePlaces::Places FreePlaces::away_from_movers(const Places& all) const {
  std::vector<std::uint8_t> near(ways_.size(), 0);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(config_.mover_distance);
  for (const Thing& thing : world_.things) {
    if (!thing.route) continue;
    const Eigen::Vector2d at = thing.pose.translation().head<2>();
    ways_.for_each_row_in({at - reach, at + reach}, [&](std::size_t cell, std::size_t end) {
      for (; cell < end; ++cell)
        if ((at - ways_.centre(cell)).norm() < config_.mover_distance) near[cell] = 1;
    });
  }
  Places places = those(all, [&](std::size_t cell) { return near[cell] == 0; });
  return places.empty() ? all : places;
}

}  // namespace navvi_sim::scenario
