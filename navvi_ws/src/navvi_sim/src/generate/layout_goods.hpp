#pragma once

#include <vector>

#include "generate/floor_plan.hpp"
#include "generate/layout_traffic.hpp"

namespace navvi_sim::generate {

/// What stands in a layout's hall: racks, pallets at the docks, and, in aisles where nothing moves,
/// goods that were left there, and workers.
class LayoutGoods {
 public:
  /// \throws LayoutError for shares that cannot be had together, or in aisles so narrow
  LayoutGoods(const FloorPlan& plan, const LayoutConfig& config);

  [[nodiscard]] std::vector<Thing> racks(Random random) const;
  [[nodiscard]] std::vector<Thing> staged(Random random);
  /// \throws LayoutError if there is no room for so many workers
  [[nodiscard]] std::vector<Thing> left_behind(Random random, const LayoutTraffic& traffic);

 private:
  /// A place at one side of an aisle in which nothing moves.
  struct Place {
    Area aisle;
    double y;     ///< m, its middle
    double side;  ///< -1 west, 1 east
    /// Where something stands that takes `room` m of the aisle's width.
    [[nodiscard]] double x(double room) const;
  };
  using Things = std::vector<Thing>;

  [[nodiscard]] std::vector<Place> quiet_places(Random& random, const LayoutTraffic& traffic) const;
  void add_standing_workers(Things& things, Random& random, std::vector<Place>& places) const;
  void add_pallet(Things& things, Random& random, const Eigen::Vector2d& spot, double yaw,
                  bool loaded);
  void add_pedestal(Things& things, Random& random, const Place& place);
  void add_boxes(Things& things, Random& random, const Place& place);

  const FloorPlan& plan_;
  const LayoutConfig& config_;
  std::size_t pallets_ = 0;
  std::size_t pedestals_ = 0;
  std::size_t boxes_ = 0;
};

}  // namespace navvi_sim::generate
