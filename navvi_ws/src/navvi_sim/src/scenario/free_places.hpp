#pragma once

#include <cstddef>
#include <vector>

#include "description/footprint.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "scenario/floor_grid.hpp"

namespace navvi_sim::scenario {

/// Around everything that stands still and rises from the floor, from above; m, in map.
[[nodiscard]] Polygon hull_of_what_stands(const WorldDescription& world);

/// False for all places if nothing stands.
[[nodiscard]] bool lies_in(const Polygon& hull, const Eigen::Vector2d& place);

/// Where on a floor a route may start or end, as cells of a grid of the floor.
class FreePlaces {
 public:
  using Places = std::vector<std::size_t>;  ///< cells

  /// \throws WorldError if there is no place as clear as `config` says, or as swept_ground
  FreePlaces(const WorldDescription& world, const FloorGrid& grid, const ScenarioConfig& config);

  /// Clear of everything that stands still, inside the hull of that, and in rooms, each where there
  /// are such; at least one.
  [[nodiscard]] const Places& all() const { return all_; }
  /// Those of them off the ground that movers sweep.
  [[nodiscard]] const Places& quiet() const { return quiet_; }
  /// Those of `places` that keep their distance from where movers begin; all of them if none does.
  [[nodiscard]] Places away_from_movers(const Places& places) const;

 private:
  void find_quiet();

  const WorldDescription& world_;
  const FloorGrid& grid_;
  const ScenarioConfig& config_;
  Places all_, quiet_;
};

}  // namespace navvi_sim::scenario
