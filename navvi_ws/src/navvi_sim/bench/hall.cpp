#include "hall.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_sim::bench {
namespace {

constexpr double kCell = 9.0;  // m

Shape box_on(double x, double bottom, double length, double width, double height) {
  return {Box{{length, width, height}},
          Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, bottom + 0.5 * height))};
}

Thing thing_at(const std::string& name, ThingClass thing_class, const Eigen::Vector2d& at) {
  Thing thing;
  thing.name = name;
  thing.thing_class = thing_class;
  thing.pose.translation() = Eigen::Vector3d(at.x(), at.y(), 0.0);
  return thing;
}

Thing shelf(const std::string& name, const Eigen::Vector2d& at) {
  Thing thing = thing_at(name, ThingClass::shelf, at);
  for (const double height : {0.0, 0.8, 1.6}) {
    thing.shapes.push_back(box_on(0.0, height, 5.0, 1.2, 0.1));
    for (const double x : {-2.0, -1.0, 0.0, 1.0, 2.0})
      thing.shapes.push_back(box_on(x, height + 0.1, 0.7, 0.6, 0.5));
  }
  return thing;
}

Thing mover(const std::string& name, const Eigen::Vector2d& at, double speed) {
  const double x = 4.7, y = 3.0;
  Thing thing = thing_at(name, ThingClass::pallet_robot, at - Eigen::Vector2d(0.0, y));
  thing.shapes.push_back(box_on(0.0, 0.03, 0.9, 0.7, 0.25));
  thing.shapes.push_back(box_on(-0.05, 0.28, 0.6, 0.5, 0.6));
  Route route;
  route.speed = speed;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y),
                                        Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y)})
    route.waypoints.push_back({at + corner});
  route.waypoints[0].pause = 2.0;
  thing.route = route;
  return thing;
}

}  // namespace

WorldDescription hall(int cells, std::size_t shelves, std::size_t movers) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      places.push_back(kCell * Eigen::Vector2d(i - cells / 2, j - cells / 2));
  std::stable_sort(places.begin(), places.end(),
                   [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                     return a.squaredNorm() < b.squaredNorm();
                   });
  WorldDescription world;
  world.name = "hall";
  Thing floor = thing_at("floor", ThingClass::floor, {0.0, 0.0});
  const double side = kCell * (cells + 1);
  floor.shapes.push_back(box_on(0.0, -0.1, side, side, 0.1));
  world.things.push_back(floor);
  for (std::size_t i = 0; i < shelves; ++i)
    world.things.push_back(shelf("shelf_" + std::to_string(i), places.at(i)));
  for (std::size_t i = 0; i < movers; ++i)
    world.things.push_back(
        mover("mover_" + std::to_string(i), places.at(i), 0.8 + 0.05 * static_cast<double>(i % 9)));
  return world;
}

}  // namespace navvi_sim::bench
