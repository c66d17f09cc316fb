#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "description/footprint.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "scenario/floor_ways.hpp"

namespace navvi_sim::scenario {

/// Around everything that stands still and rises from the floor, from above; m, in map.
[[nodiscard]] Polygon hull_of_what_stands(const WorldDescription& world);

/// False for all places if nothing stands.
[[nodiscard]] bool lies_in(const Polygon& hull, const Eigen::Vector2d& place);

/// Where on a floor a route may start or end, as cells.
class FreePlaces {
 public:
  using Places = FloorWays::Cells;

  /// \throws WorldError if there is no place as clear as `config` says, or as swept_ground
  FreePlaces(const WorldDescription& world, const FloorWays& ways, const ScenarioConfig& config);

  /// Clear of everything that stands still, on the main part of the floor, inside the hull of what
  /// stands, and in rooms, each where there are such some m apart; at least one.
  [[nodiscard]] const Places& all() const { return all_; }
  /// Those of them off the ground that movers sweep.
  [[nodiscard]] const Places& quiet() const { return quiet_; }
  /// Around everything that stands, as hull_of_what_stands().
  [[nodiscard]] const Polygon& hull() const { return hull_; }
  /// Those of `places` that keep their distance from where movers begin; all of them if none does.
  [[nodiscard]] Places away_from_movers(const Places& places) const;

 private:
  [[nodiscard]] std::uint32_t main_part(const std::vector<std::uint32_t>& part,
                                        const std::vector<std::uint8_t>& indoors) const;
  /// Keeps only those that meet the condition, if they are more than this share and do not lie
  /// closer together than a trial needs.
  template <typename Condition>
  void keep(const Condition& condition, double share);
  /// m, the longer side of the rectangle around places, or one that is long enough.
  [[nodiscard]] double side_of(const Places& places) const;
  void find_quiet();

  const WorldDescription& world_;
  const FloorWays& ways_;
  const ScenarioConfig& config_;
  Polygon hull_;
  Places all_, quiet_;
};

/// Those of the places that meet the condition.
template <typename Condition>
FreePlaces::Places those(const FreePlaces::Places& places, const Condition& condition) {
  FreePlaces::Places out;
  out.reserve(places.size());
  std::copy_if(places.begin(), places.end(), std::back_inserter(out), condition);
  return out;
}

}  // namespace navvi_sim::scenario
