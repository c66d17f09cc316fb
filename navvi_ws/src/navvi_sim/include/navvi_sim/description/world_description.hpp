#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <navvi_files/printable.hpp>
#include <navvi_types/angles.hpp>
#include <navvi_types/random.hpp>
#include <navvi_types/scenario.hpp>
#include <navvi_types/thing.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace navvi_sim {

using navvi_types::kPi;
using navvi_types::Place;
using navvi_types::Pose2;
using navvi_types::Random;
using navvi_types::ThingClass;

struct Box {
  Eigen::Vector3d size;  ///< m, full extents, > 0
};
struct Cylinder {
  double radius;  ///< m, > 0
  double length;  ///< m, > 0, along z, centred
};
struct Sphere {
  double radius;  ///< m, > 0
};
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;                ///< m, scaled
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
};
using Geometry = std::variant<Box, Cylinder, Sphere, std::shared_ptr<const Mesh>>;

struct Shape {
  Geometry geometry;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< in the thing's frame
  std::optional<ThingClass> look =
      std::nullopt;    ///< shown as this class where not as its thing: a shelf's boxes
  bool solid = false;  ///< a mesh without a hollow, such as a polyline: filled whatever its size
};

/// A place on a route.
struct Waypoint {
  Eigen::Vector2d at;  ///< m, in map
  double pause = 0.0;  ///< s, stop here: to load, to look; >= 0
  double speed = 0.0;  ///< m/s on the way to it; 0: the route's
};

/// Way-points that a moving thing follows in order: a round. After the last it drives back to the
/// first, and the next round begins.
struct Route {
  std::vector<Waypoint> waypoints;  ///< two or more
  double speed = 1.0;               ///< m/s, > 0
  bool loop = true;                 ///< false: it ends at the last way-point and stays there
  double delay = 0.0;               ///< s, stands still before each round, >= 0
  bool yields = true;               ///< stops for the robot ahead; all do backing out
};

/// Anything with a body and a class. It stands still unless it has a route.
struct Thing {
  std::string name;  ///< unique in the world
  ThingClass thing_class = ThingClass::other;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< in map, at time zero
  std::vector<Shape> shapes;                               ///< one or more
  std::optional<Route> route;
};

/// The class that a shape of the thing is shown as.
[[nodiscard]] inline ThingClass look_of(const Thing& thing, const Shape& shape) {
  return shape.look.value_or(thing.thing_class);
}

/// What the robot meets in a thing. Only what rises from a floor can be met: it is called a wall.
[[nodiscard]] inline ThingClass obstacle_class(const Thing& thing) {
  return thing.thing_class == ThingClass::floor ? ThingClass::wall : thing.thing_class;
}

/// Everything there is to know of a world before it lives. Frame: map, z up.
struct WorldDescription {
  std::string name;
  double floor_height = 0.0;       ///< m, z of the surface the robot drives on
  std::vector<Thing> things;       ///< a thing's id in the messages is its index here
  std::vector<Place> places = {};  ///< where they are; `at` is their middle, free or not
};

/// 64-bit FNV-1a over every name and number of `world`, as 16 hexadecimal digits. Two worlds with
/// the same hash are, for a trial, the same world.
[[nodiscard]] std::string world_hash(const WorldDescription& world);

/// A sentence that says which file or thing is wrong, what is wrong with it, and what is allowed.
class WorldError : public std::runtime_error {
 public:
  explicit WorldError(const std::string& sentence)
      : std::runtime_error(navvi_files::printable(sentence, true)) {}
};

/// A thing with a route at one instant.
struct MoverState {
  navvi_types::MovingThing thing;                          ///< its id: WorldDescription::things
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of its origin, in map
};

}  // namespace navvi_sim
