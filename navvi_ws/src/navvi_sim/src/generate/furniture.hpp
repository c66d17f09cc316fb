#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

// What a warehouse holds: things by their measures, wherever they come to stand.

namespace navvi_sim::generate {

constexpr double kWallHeight = 2.5;     // m
constexpr double kWallThickness = 0.2;  // m
constexpr double kRackDepth = 1.0;      // m
constexpr double kBay = 2.0;            // m, along a rack
constexpr double kPalletLength = 1.2;   // m
constexpr double kPalletWidth = 0.8;    // m

/// A pose on the floor, turned by `yaw` rad.
[[nodiscard]] Eigen::Isometry3d at(double x, double y, double z, double yaw = 0.0);
/// A box by the height it stands at.
[[nodiscard]] Shape box_on(double x, double y, double bottom, double length, double width,
                           double height);
/// "shelf_07"
[[nodiscard]] std::string numbered(const std::string& word, std::size_t number);

/// Adds a thing that stands.
void add(std::vector<Thing>& things, std::string name, ThingClass thing_class,
         const Eigen::Isometry3d& pose, std::vector<Shape> shapes);

/// A rack along x with the boxes on it, which stay clear of its uprights and of each other. To the
/// driver they are one shelf, so that it is felt and said once.
[[nodiscard]] std::vector<Shape> loaded_rack(Random& random, int bays, double fill);

/// What moves, by how much room it takes.
struct Vehicle {
  std::string name;
  ThingClass thing_class;
  std::vector<Shape> shapes;  ///< ahead is x
  double half_width;          ///< m
  double radius;              ///< m, of the circle around its origin that it turns in
};
[[nodiscard]] Vehicle forklift();
[[nodiscard]] Vehicle pallet_robot();
[[nodiscard]] Vehicle worker();

/// At the start of its route, looking along it.
[[nodiscard]] Thing mover(std::size_t number, const Vehicle& vehicle, Route route);

}  // namespace navvi_sim::generate
