#include "generate/layout.hpp"

#include <algorithm>
#include <iterator>

#include "generate/layout_goods.hpp"
#include "generate/layout_traffic.hpp"

namespace navvi_sim::generate {
namespace {

constexpr double kFloorDepth = 0.8;  // m; so deep that an OctoMap of it is made of few, large cubes
constexpr double kDoorWidth = 3.0;   // m, of a dock
constexpr double kPanel = 0.08;      // m, thickness of a dock's door
constexpr double kFenceHeight = 2.0;  // m, of what closes a way

/// One use of the seed: to change one of them leaves what the others draw as it is.
enum class Stream : std::uint64_t { plan = 1, stock, traffic, staging, clutter };

Random stream(std::uint64_t seed, Stream use) {
  return Random(Random(seed + (static_cast<std::uint64_t>(use) << 56U)).next());
}

}  // namespace

std::vector<Thing> LayoutHall::things() {
  add_floor_and_walls();
  add_inner_walls();
  add_fences();
  return std::move(things_);
}

/// A wall on `area`.
void LayoutHall::add_wall(const std::string& name, const Area& area, double height) {
  const Eigen::Vector2d size = area.sizes();
  add(things_, name, ThingClass::wall, at(area.center().x(), area.center().y(), 0.0),
      {box_on(0.0, 0.0, 0.0, size.x(), size.y(), height)});
}

void LayoutHall::add_floor_and_walls() {
  const Area hall = plan_.hall();
  const Eigen::Vector2d rim(kWallThickness, kWallThickness);
  const Area outside(hall.min() - rim, hall.max() + rim);
  const Eigen::Vector2d floor = outside.sizes() + 2.0 * rim;
  add(things_, "floor", ThingClass::floor, at(0.0, 0.0, 0.0),
      {box_on(0.0, 0.0, -kFloorDepth, floor.x(), floor.y(), kFloorDepth)});
  const double west = outside.min().x(), east = outside.max().x();
  const double south = hall.min().y(), north = hall.max().y();
  add_wall("wall_north", area_of(west, north, east, outside.max().y()));
  add_wall("wall_east", area_of(hall.max().x(), south, east, north));
  add_wall("wall_west", area_of(west, south, hall.min().x(), north));
  add_dock_wall(outside);
}

void LayoutHall::add_dock_wall(const Area& outside) {
  double west = outside.min().x();
  std::size_t piece = 0;
  const auto wall_to = [&](double east) {
    add_wall(numbered("wall_south", ++piece),
             area_of(west, outside.min().y(), east, plan_.hall().min().y()));
  };
  for (int lane = 0; lane < plan_.lanes(); ++lane) {
    if (!plan_.docked(lane)) continue;
    const Area way = plan_.lane(lane);
    const double half = std::min(kDoorWidth, way.sizes().x()) / 2.0;
    wall_to(way.center().x() - half);
    west = way.center().x() + half;
    add_wall(numbered("dock_door", piece),
             area_of(way.center().x() - half, outside.min().y(), west, outside.min().y() + kPanel));
    things_.back().shapes.front().look = ThingClass::other;
  }
  wall_to(outside.max().x());
}

/// Through the flue of a row from front to back, with a door in each open passage.
void LayoutHall::add_inner_walls() {
  std::size_t piece = 0;
  for (int row = 0; row < plan_.rows(); ++row) {
    if (!plan_.walled(row)) continue;
    const double x = plan_.passage(row, 0).center().x();
    double south = plan_.hall().min().y();
    const auto wall_to = [&](double north) {
      if (north - south < 1e-6) return;
      add_wall(numbered("wall_inner", ++piece),
               area_of(x - kWallThickness / 2.0, south, x + kWallThickness / 2.0, north));
    };
    for (int crossing = 0; crossing < plan_.crossings(); ++crossing) {
      if (!plan_.passage_open(row, crossing)) continue;
      const double middle = plan_.passage(row, crossing).center().y();
      wall_to(middle - plan_.door() / 2.0);
      south = middle + plan_.door() / 2.0;
    }
    wall_to(plan_.hall().max().y());
  }
}

/// What closes the ways that the plan has closed: an aisle at one end, a passage in its middle.
void LayoutHall::add_fences() {
  std::size_t number = 0;
  const double thickness = kWallThickness;
  for (int lane = 0; lane < plan_.lanes(); ++lane)
    for (int block = 0; block < plan_.blocks(); ++block) {
      if (plan_.aisle_open(lane, block)) continue;
      const Area aisle = plan_.aisle(lane, block);
      const double y = random_.chance(0.5) ? aisle.min().y() : aisle.max().y() - thickness;
      add_wall(numbered("fence", ++number),
               area_of(aisle.min().x(), y, aisle.max().x(), y + thickness), kFenceHeight);
    }
  for (int row = 0; row < plan_.rows(); ++row)
    for (int crossing = 0; crossing < plan_.crossings(); ++crossing) {
      if (plan_.walled(row) || plan_.passage_open(row, crossing)) continue;
      const Area passage = plan_.passage(row, crossing);
      const double x = passage.center().x() - thickness / 2.0;
      add_wall(numbered("fence", ++number),
               area_of(x, passage.min().y(), x + thickness, passage.max().y()), kFenceHeight);
    }
}

WorldDescription layout(const std::string& name, const LayoutConfig& config, std::uint64_t seed) {
  Random random = stream(seed, Stream::plan);
  const FloorPlan plan(config, random);
  LayoutGoods goods(plan, config);
  // Laid before anything is left in an aisle, which then is one where nothing moves.
  LayoutTraffic traffic(plan, config, stream(seed, Stream::traffic));
  std::vector<Thing> movers = traffic.movers();

  WorldDescription world;
  world.name = name;
  world.places = plan.places();
  const auto add = [&](std::vector<Thing> things) {
    std::move(things.begin(), things.end(), std::back_inserter(world.things));
  };
  add(LayoutHall(plan, random).things());
  add(goods.racks(stream(seed, Stream::stock)));
  add(goods.staged(stream(seed, Stream::staging)));
  add(goods.left_behind(stream(seed, Stream::clutter), traffic));
  add(std::move(movers));
  return world;
}

}  // namespace navvi_sim::generate
