#pragma once

#include <vector>

#include "generate/floor_plan.hpp"
#include "generate/furniture.hpp"

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
  void add_wall(const std::string& name, const Area& area, double height);

  const FloorPlan& plan_;
  Random random_;
  std::vector<Thing> things_;
};

}  // namespace navvi_sim::generate
