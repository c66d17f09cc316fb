#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "generate/floor_plan.hpp"
#include "generate/furniture.hpp"
#include "generate/layout_config.hpp"
#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::generate {

/// What a layout's goods stand in: floor, outer walls with a closed door at each dock, inner walls
/// with their doors, and fences across the ways that the plan has closed.
class LayoutHall {
 public:
  LayoutHall(const FloorPlan& plan, Random random) : plan_(plan), random_(random) {}

  [[nodiscard]] std::vector<Thing> things();

 private:
  void add_floor_and_walls();
  void add_dock_wall(const Area& outside);
  void add_inner_walls();
  void add_fences();
  void add_wall(const std::string& name, const Area& area, double height = kWallHeight);

  const FloorPlan& plan_;
  Random random_;
  std::vector<Thing> things_;
};

/// A warehouse built from `config` (R-SIM-1 to R-SIM-3): its middle is the origin, its floor z = 0,
/// its docks in the south. The same config and seed give the same world, number by number.
///
/// Every place that one can drive to is connected to every other. Everything that moves has a
/// stretch of its route to itself, in which it stands at time zero and can wait for others that
/// cross the rest. \throws LayoutError if the config contradicts itself or asks for more than there
/// is room for
[[nodiscard]] WorldDescription layout(const std::string& name, const LayoutConfig& config,
                                      std::uint64_t seed);

}  // namespace navvi_sim::generate
