#include "generate/layout_config.hpp"

#include <algorithm>

namespace navvi_sim::generate {
namespace {

/// A hall with nothing in it that moves or was left.
LayoutConfig still() {
  LayoutConfig config;
  config.pedestals = config.clutter = 0.0;
  config.forklifts = config.pallet_robots = config.walking_workers = config.standing_workers = 0;
  return config;
}

LayoutConfig training() {
  LayoutConfig config = still();
  config.length = 18.0;
  config.width = 15.0;
  config.aisle = 3.4;
  config.cross_aisle = 3.0;
  config.bays = 0;
  config.docks = 2;
  config.fill = 0.5;
  config.staged = 0.25;
  return config;
}

LayoutConfig warehouse() {
  LayoutConfig config = still();
  config.length = 50.0;
  config.width = 30.0;
  config.bays = 4;
  config.aisle = 3.2;
  config.cross_aisle = 3.0;
  config.docks = 3;
  config.staged = 0.4;
  config.pedestals = 0.25;
  config.pedestal_min = config.pedestal_max = 0.10;
  config.clutter = 0.12;
  config.forklifts = 2;
  config.pallet_robots = 2;
  config.walking_workers = 3;
  config.standing_workers = 3;
  return config;
}

LayoutConfig busy() {
  LayoutConfig config = still();
  config.length = 64.0;
  config.width = 48.0;
  config.bays = 4;
  config.aisle = 3.2;
  config.cross_aisle = 4.0;
  config.dead_ends = 0.1;
  config.docks = 6;
  config.walls = 1;
  config.door = 3.0;
  config.fill = 0.75;
  config.staged = 0.8;
  config.pallets = 0.15;
  config.pedestals = 0.10;
  config.clutter = 0.10;
  config.forklifts = 6;
  config.pallet_robots = 6;
  config.walking_workers = 14;
  config.standing_workers = 4;
  return config;
}

LayoutConfig narrow() {
  LayoutConfig config = still();
  config.length = 36.0;
  config.width = 28.0;
  config.bays = 4;
  config.aisle = 1.7;
  config.cross_aisle = 2.4;
  config.dead_ends = 0.2;
  config.docks = 3;
  config.fill = 0.8;
  config.staged = 0.7;
  config.pallet_robots = 2;
  config.walking_workers = 4;
  return config;
}

LayoutConfig maze() {
  LayoutConfig config = still();
  config.length = 40.0;
  config.width = 40.0;
  config.bays = 2;
  config.aisle = 2.2;
  config.cross_aisle = 2.2;
  config.dead_ends = 1.0;
  config.docks = 2;
  config.walls = 2;
  config.door = 1.4;
  config.fill = 0.7;
  config.pedestals = 0.10;
  config.clutter = 0.15;
  config.walking_workers = 3;
  config.standing_workers = 3;
  return config;
}

}  // namespace

void LayoutConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  const Range share{0.0, 1.0};
  const Range speed{0.05, 5.0};
  visit(length, "length", Range{10.0, 300.0}, "m", "of the hall along the dock wall, inside");
  visit(width, "width", Range{10.0, 300.0}, "m", "of the hall away from the dock wall, inside");
  visit(rows, "rows", Range{0, 200}, "", "shelf rows, each of two racks back to back; 0: as fit");
  visit(blocks, "blocks", Range{0, 100}, "", "shelf blocks behind each other; 0: as fit");
  visit(bays, "bays", Range{0, 150}, "", "of 2 m in a rack of a block; 0: as fit");
  visit(aisle, "aisle", Range{1.4, 20.0}, "m", "between two rows; the outermost two may be wider");
  visit(cross_aisle, "cross_aisle", Range{1.4, 20.0}, "m", "before, between and behind the blocks");
  visit(dead_ends, "dead_ends", share, "",
        "share closed of the ways that can be, with nothing cut off; 1: a "
        "maze with one way between any two places");
  visit(docks, "docks", Range{0, 201}, "",
        "doors in the southern wall, each at the end of an aisle");
  visit(walls, "walls", Range{0, 200}, "",
        "through the hall from front to back, between two racks");
  visit(door, "door", Range{1.4, 20.0}, "m", "width of the doors of the walls, one a cross-aisle");
  visit(fill, "fill", share, "", "share of shelf places that hold a box");
  visit(staged, "staged", share, "", "share of places at the docks that hold a loaded pallet");
  visit(pallets, "pallets", share, "", "share of places in quiet aisles where a pallet was left");
  visit(pedestals, "pedestals", share, "", "share of places in quiet aisles with a pedestal");
  visit(clutter, "clutter", share, "", "share of places in quiet aisles with boxes on the floor");
  visit(pedestal_min, "pedestal_min", Range{0.05, 0.30}, "m", "least height of a pedestal");
  visit(pedestal_max, "pedestal_max", Range{0.05, 0.30}, "m", "greatest height of a pedestal");
  visit(forklifts, "forklifts", Range{0, 1000}, "", "on routes");
  visit(pallet_robots, "pallet_robots", Range{0, 1000}, "", "on routes");
  visit(walking_workers, "walking_workers", Range{0, 1000}, "", "on routes");
  visit(standing_workers, "standing_workers", Range{0, 1000}, "", "who stand");
  visit(forklift_speed, "forklift_speed", speed, "m/s", "of forklifts on their routes");
  visit(pallet_robot_speed, "pallet_robot_speed", speed, "m/s", "of pallet robots on their routes");
  visit(worker_speed, "worker_speed", speed, "m/s", "of workers who walk");
  visit(pause, "pause", Range{0.0, 600.0}, "s", "of what moves, at docks and shelves");
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      {"training", "a small hall with wide aisles where nothing moves, to learn the stick",
       training()},
      {"easy", "wide aisles, few obstacles, little traffic", {}},
      {"warehouse", "the usual one: racks, pedestals, some traffic", warehouse()},
      {"busy", "a large hall at work: docks, forklifts, pallet robots, workers, things left behind",
       busy()},
      {"narrow", "aisles of 1.7 m with pallet robots and workers in them", narrow()},
      {"maze", "many dead ends, walls with doors, one way from any place to any other", maze()},
  };
  return all;
}

std::optional<LayoutConfig> preset(const std::string& name) {
  for (const Preset& known : presets())
    if (known.name == name) return known.config;
  return std::nullopt;
}

}  // namespace navvi_sim::generate
