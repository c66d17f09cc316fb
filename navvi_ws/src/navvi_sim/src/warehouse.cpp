#include "navvi_sim/warehouse.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "furniture.hpp"
#include "random.hpp"

namespace navvi_sim {
namespace {

// The ground plan, m. Shelves stand in 6 rows (along x) and 4 columns; between rows run aisles,
// between columns cross aisles, and a wider lane runs round all of them along the walls.
constexpr double kLength = 50.0;
constexpr double kWidth = 30.0;
constexpr std::array<double, 6> kRows{-10.0, -6.0, -2.0, 2.0, 6.0, 10.0};
constexpr std::array<double, 4> kColumns{-16.5, -5.5, 5.5, 16.5};
constexpr int kBays = 4;
constexpr double kAisle = 3.0;
constexpr double kPedestalHeight = 0.10;

/// A stretch of an aisle between two shelves, 8 x 3 m, by its centre.
using Stretch = Eigen::Vector2d;

Stretch stretch(std::size_t aisle, std::size_t column) {
  return {kColumns[column], (kRows[aisle] + kRows[aisle + 1]) / 2.0};
}

Thing floor() {
  const double margin = 2.0 * kWallThickness;
  return {"floor",
          ThingClass::floor,
          at(0.0, 0.0, 0.0),
          {box_on(0.0, 0.0, -0.1, kLength + margin, kWidth + margin, 0.1)},
          std::nullopt};
}

void add_walls(std::vector<Thing>& things) {
  const double x = (kLength + kWallThickness) / 2.0;
  const double y = (kWidth + kWallThickness) / 2.0;
  const double length = kLength + 2.0 * kWallThickness;
  const auto add = [&](const char* name, double cx, double cy, double sx, double sy) {
    things.push_back({name,
                      ThingClass::wall,
                      at(cx, cy, 0.0),
                      {box_on(0.0, 0.0, 0.0, sx, sy, kWallHeight)},
                      std::nullopt});
  };
  add("wall_north", 0.0, y, length, kWallThickness);
  add("wall_south", 0.0, -y, length, kWallThickness);
  add("wall_east", x, 0.0, kWallThickness, kWidth);
  add("wall_west", -x, 0.0, kWallThickness, kWidth);
}

void add_shelves(std::vector<Thing>& things, Random& random, double fill) {
  std::size_t number = 0;
  for (const double y : kRows) {
    for (const double x : kColumns) {
      things.push_back({numbered("shelf", ++number), ThingClass::shelf, at(x, y, 0.0),
                        loaded_rack(random, kBays, fill), std::nullopt});
    }
  }
}

/// A pedestal at one side of a stretch, with a box on it or without.
void add_pedestal(std::vector<Thing>& things, Random& random, const Stretch& where,
                  std::size_t number, bool loaded) {
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const double x = where.x() + random.uniform(-2.5, 2.5);
  const double y = where.y() + side * (kAisle / 2.0 - 0.55);
  const std::string name = numbered("pedestal", number);
  things.push_back({name,
                    ThingClass::pedestal,
                    at(x, y, 0.0),
                    {box_on(0.0, 0.0, 0.0, 1.2, 1.0, kPedestalHeight)},
                    std::nullopt});
  const double length = random.uniform(0.5, 0.9);
  const double width = random.uniform(0.5, 0.8);
  const double height = random.uniform(0.4, 0.9);
  if (loaded)
    things.push_back({name + "_box",
                      ThingClass::box,
                      at(x, y, kPedestalHeight),
                      {box_on(0.0, 0.0, 0.0, length, width, height)},
                      std::nullopt});
}

/// Boxes left standing at one side of a stretch.
void add_floor_box(std::vector<Thing>& things, Random& random, const Stretch& where,
                   std::size_t number) {
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const double edge = random.uniform(0.4, 0.7);
  things.push_back({numbered("box", number),
                    ThingClass::box,
                    at(where.x() + random.uniform(-2.5, 2.5), where.y() + side * 1.0, 0.0),
                    {box_on(0.0, 0.0, 0.0, edge, edge, random.uniform(0.4, 0.8))},
                    std::nullopt});
}

/// Pedestals and boxes in stretches where nothing moves, each stretch used once at most.
void add_clutter(std::vector<Thing>& things, Random& random) {
  std::vector<Stretch> quiet{stretch(0, 1), stretch(0, 3), stretch(1, 0), stretch(1, 1),
                             stretch(1, 2), stretch(2, 0), stretch(2, 1), stretch(2, 3),
                             stretch(3, 0), stretch(3, 2), stretch(3, 3), stretch(4, 1),
                             stretch(4, 2)};
  for (std::size_t i = quiet.size(); i > 1; --i) std::swap(quiet[i - 1], quiet[random.below(i)]);
  for (std::size_t i = 0; i < 8; ++i) add_pedestal(things, random, quiet[i], i + 1, i % 2 == 0);
  for (std::size_t i = 8; i < 12; ++i) add_floor_box(things, random, quiet[i], i - 7);
}

/// A route with the same pause at all its way-points.
Route round(const std::vector<Eigen::Vector2d>& corners, double speed, double pause) {
  Route route;
  for (const Eigen::Vector2d& corner : corners) route.waypoints.push_back({corner, pause});
  route.speed = speed;
  return route;
}

/// Forklifts circle the western and the eastern half along the walls and through a cross aisle;
/// pallet robots circle in the middle. No two of their loops share ground.
void add_vehicles(std::vector<Thing>& things, const WarehouseConfig& config) {
  const double y = 13.3;
  const double wall_x = 23.3;
  const double cross_x = 11.0;
  things.push_back(mover(1, forklift(),
                         round({{-wall_x, -y}, {-wall_x, y}, {-cross_x, y}, {-cross_x, -y}},
                               config.forklift_speed, 1.0)));
  things.push_back(mover(
      2, forklift(),
      round({{wall_x, y}, {wall_x, -y}, {cross_x, -y}, {cross_x, y}}, config.forklift_speed, 1.0)));
  things.push_back(mover(1, pallet_robot(),
                         round({{0.8, -11.5}, {0.8, 11.5}, {-0.8, 11.5}, {-0.8, -11.5}},
                               config.pallet_robot_speed, 1.0)));
  things.push_back(mover(
      2, pallet_robot(),
      round({{2.6, -0.8}, {8.6, -0.8}, {8.6, 0.8}, {2.6, 0.8}}, config.pallet_robot_speed, 2.0)));
}

/// Six workers at one side of six stretches, walking to and fro or standing.
void add_workers(std::vector<Thing>& things, Random& random, const WarehouseConfig& config) {
  const std::array<Stretch, 6> places{stretch(4, 0), stretch(4, 3), stretch(0, 2),
                                      stretch(0, 0), stretch(3, 1), stretch(1, 3)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double y = places[i].y() + (random.chance(0.5) ? 0.95 : -0.95);
    const double from = places[i].x() - random.uniform(1.5, 3.3);
    const double to = places[i].x() + random.uniform(1.5, 3.3);
    const bool walks = config.workers == "walking" || (config.workers == "both" && i % 2 == 0);
    const Route route = round({{from, y}, {to, y}}, config.worker_speed, 2.0);
    if (walks)
      things.push_back(mover(i + 1, worker(), route));
    else
      things.push_back(standing(numbered("worker", i + 1), ThingClass::worker,
                                at((from + to) / 2.0, y, 0.0), worker().shapes));
  }
}

}  // namespace

void WarehouseConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"workers", navvi_config::OneOf{{"standing", "walking", "both"}}, "",
         "whether the workers of the warehouse stand, walk a route, or half of them each; standing "
         "holds for layouts as well"},
        workers);
  visit({"box_fill", Range{0.0, 1.0}, "", "share of the warehouse's shelf places that hold a box"},
        box_fill);
  visit({"forklift_speed", Range{0.05, 5.0}, "m/s",
         "speed of the warehouse's forklifts on their routes"},
        forklift_speed);
  visit({"pallet_robot_speed", Range{0.05, 5.0}, "m/s",
         "speed of the warehouse's pallet robots on their routes"},
        pallet_robot_speed);
  visit({"worker_speed", Range{0.05, 5.0}, "m/s", "speed of the warehouse's workers who walk"},
        worker_speed);
}

WorldDescription warehouse(std::uint64_t seed, const WarehouseConfig& config) {
  Random random(seed);
  WorldDescription world;
  world.name = "warehouse";
  world.floor_height = 0.0;
  world.things.push_back(floor());
  add_walls(world.things);
  add_shelves(world.things, random, config.box_fill);
  add_clutter(world.things, random);
  add_vehicles(world.things, config);
  add_workers(world.things, random, config);
  return world;
}

}  // namespace navvi_sim
