#include "generate/furniture.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace navvi_sim::generate {
namespace {

constexpr double kRackHeight = 2.2;
constexpr double kDeckThickness = 0.05;
constexpr double kBaseHeight = 0.15;
constexpr std::array<double, 4> kDecks{kBaseHeight, 0.85, 1.55, kRackHeight};  // their tops
constexpr double kUpright = 0.08;
constexpr double kBoxPlace = 1.0;  // along the rack

/// A base that goes down to the floor, three decks above it, and uprights in pairs.
std::vector<Shape> rack(int bays) {
  const double length = kBay * bays;
  std::vector<Shape> shapes{box_on(0.0, 0.0, 0.0, length, kRackDepth, kBaseHeight)};
  for (std::size_t deck = 1; deck < kDecks.size(); ++deck)
    shapes.push_back(
        box_on(0.0, 0.0, kDecks[deck] - kDeckThickness, length, kRackDepth, kDeckThickness));
  const double y = (kRackDepth - kUpright) / 2.0;
  const double reach = (length - kUpright) / 2.0;
  for (int i = 0; i <= bays; ++i)
    for (const double side : {-y, y})
      shapes.push_back(
          box_on(-reach + 2.0 * reach * i / bays, side, 0.0, kUpright, kUpright, kRackHeight));
  return shapes;
}

}  // namespace

Eigen::Isometry3d at(double x, double y, double z, double yaw) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

Shape box_on(double x, double y, double bottom, double length, double width, double height) {
  return {Box{{length, width, height}}, at(x, y, bottom + height / 2.0)};
}

std::string numbered(const std::string& word, std::size_t number) {
  return word + (number < 10 ? "_0" : "_") + std::to_string(number);
}

void add(std::vector<Thing>& things, std::string name, ThingClass thing_class,
         const Eigen::Isometry3d& pose, std::vector<Shape> shapes) {
  things.push_back({std::move(name), thing_class, pose, std::move(shapes), std::nullopt});
}

std::vector<Shape> loaded_rack(Random& random, int bays, double fill) {
  std::vector<Shape> shapes = rack(bays);
  const double length = kBay * bays;
  for (std::size_t deck = 0; deck + 1 < kDecks.size(); ++deck) {
    const double room = kDecks[deck + 1] - kDeckThickness - kDecks[deck];
    for (int place = 0; place < static_cast<int>(length / kBoxPlace); ++place) {
      const double box_length = random.uniform(0.45, 0.75);
      const double box_width = random.uniform(0.45, 0.70);
      const double box_height = random.uniform(0.5, 0.85) * room;
      const double x = -length / 2.0 + kBoxPlace * (place + 0.5);
      if (!random.chance(fill)) continue;
      shapes.push_back(box_on(x, 0.0, kDecks[deck], box_length, box_width, box_height));
      shapes.back().look = ThingClass::box;
    }
  }
  return shapes;
}

Vehicle forklift() {
  return {"forklift",
          ThingClass::forklift,
          {
              box_on(-0.45, 0.0, 0.05, 1.6, 1.0, 0.85),    // body
              box_on(-0.75, 0.0, 0.90, 0.9, 0.9, 1.10),    // cabin
              box_on(0.42, 0.0, 0.05, 0.14, 0.9, 2.05),    // mast
              box_on(0.87, 0.28, 0.05, 0.76, 0.14, 0.08),  // forks
              box_on(0.87, -0.28, 0.05, 0.76, 0.14, 0.08),
          },
          0.5,
          1.35};
}

Vehicle pallet_robot() {
  return {
      "pallet_robot",
      ThingClass::pallet_robot,
      {
          box_on(0.0, 0.0, 0.03, 0.9, 0.7, 0.25), box_on(0.0, 0.0, 0.28, 0.8, 0.6, 0.12),  // pallet
          box_on(-0.05, 0.0, 0.40, 0.6, 0.5, 0.5),                                         // load
      },
      0.35,
      0.571};
}

Vehicle worker() {
  return {"worker",
          ThingClass::worker,
          {
              {Cylinder{0.24, 1.45}, at(0.0, 0.0, 0.725)},
              {Sphere{0.15}, at(0.0, 0.0, 1.60)},
          },
          0.24,
          0.24};
}

Thing mover(std::size_t number, const Vehicle& vehicle, Route route) {
  const Eigen::Vector2d start = route.waypoints[0].at;
  const Eigen::Vector2d way = route.waypoints[1].at - start;
  return {numbered(vehicle.name, number), vehicle.thing_class,
          at(start.x(), start.y(), 0.0, std::atan2(way.y(), way.x())), vehicle.shapes,
          std::move(route)};
}

}  // namespace navvi_sim::generate
