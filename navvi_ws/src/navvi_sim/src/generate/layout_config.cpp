#include "generate/layout_config.hpp"

#include <navvi_config/reader.hpp>

#include "presets.hpp"

namespace navvi_sim::generate {
void LayoutConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  const Range share{0.0, 1.0};
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
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = [] {
    std::vector<Preset> read;
    for (const YAML::Node& node : YAML::Load(kPresets)) {
      Preset& known = read.emplace_back();
      known.name = node["name"].as<std::string>();
      known.help = node["help"].as<std::string>();
      navvi_config::read(known.config, node["layout"], "config/presets.yaml");
    }
    return read;
  }();
  return all;
}

std::optional<LayoutConfig> preset(const std::string& name) {
  for (const Preset& known : presets())
    if (known.name == name) return known.config;
  return std::nullopt;
}

}  // namespace navvi_sim::generate
