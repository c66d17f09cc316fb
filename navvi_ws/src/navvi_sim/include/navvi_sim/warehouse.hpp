#pragma once

#include <cstdint>
#include <navvi_config/field.hpp>
#include <string>

#include "navvi_sim/world_description.hpp"

namespace navvi_sim {

/// What can be chosen of the built-in warehouse (R-SIM-1 to R-SIM-3).
struct WarehouseConfig {
  std::string workers = "both";     ///< standing, walking, or both
  double box_fill = 0.6;            ///< share of shelf places that hold a box, 0 to 1
  double forklift_speed = 1.0;      ///< m/s
  double pallet_robot_speed = 0.7;  ///< m/s
  double worker_speed = 0.8;        ///< m/s, of those who walk

  void describe(navvi_config::Visitor& visit);
};

/// The built-in warehouse, 50 x 30 m with its south-west inner corner at (-25, -15) and its floor
/// at z = 0: 24 shelves with boxes in two blocks, aisles 3 m wide, cross aisles, pedestals 0.10 m
/// high with and without boxes, two forklifts and two pallet robots on routes, workers. The same
/// seed and config give the same world, number by number; the seed moves boxes, pedestals and
/// workers, never shelves or routes.
[[nodiscard]] WorldDescription warehouse(std::uint64_t seed, const WarehouseConfig& config);

}  // namespace navvi_sim
