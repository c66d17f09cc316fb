#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "navvi_types/limits.hpp"
#include "navvi_types/motion.hpp"
#include "navvi_types/names.hpp"

namespace navvi_types {

/// The class of a thing (R-SIM-4). `floor` can be driven on and is in no message; everything else
/// is an obstacle.
enum class ThingClass { floor, shelf, wall, box, pedestal, worker, forklift, pallet_robot, other };

/// One thing near the robot (R-SIM-7).
struct NearThing {
  ThingClass thing_class = ThingClass::other;
  std::uint32_t id = 0;
  double gap = 0.0;                                   ///< m, hull to surface; <= 0 when touching
  Eigen::Vector2d nearest = Eigen::Vector2d::Zero();  ///< m, of its surface, in base_link
  bool moving = false;
  std::string name = {};  ///< as in the world, for the record; never spoken
  double height = 0.0;    ///< m, z of `nearest`
};

/// Each thing within `detection_radius` of the robot's hull.
struct Proximity {
  std::int64_t stamp = 0;              ///< ns, ROS time
  std::vector<NearThing> things = {};  ///< nearest first
  double detection_radius = 5.0;       ///< m, > 0
};

/// The robot began to touch a thing (R-SIM-6).
struct Contact {
  ThingClass thing_class = ThingClass::other;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< m, where they touch, in map
  std::uint32_t id = 0;                             ///< of the thing
  std::string name = {};                            ///< as NearThing::name
  double height = 0.0;                              ///< m, z of `point`
  Pose2 robot = {};                                 ///< base_link in map at that instant
  double floor = 0.0;                               ///< m, height of the floor in map
  double speed = 0.0;                               ///< m/s, the robot's just before
  std::map<ThingClass, std::uint32_t> counts = {};  ///< contacts so far, this one included
  std::uint32_t seq = 1;                            ///< 1 for the first of the world, no gaps
  std::int64_t stamp = 0;                           ///< ns, ROS time

  /// m, in base_link
  [[nodiscard]] Eigen::Vector2d seen_from_robot() const { return robot.to_local(point); }
};

/// A moving thing as a vertical cylinder on the floor and, where it is known, its rectangle within
/// that (R-NAV-4).
struct MovingThing {
  std::uint32_t id = 0;  ///< the same for the life of the world
  ThingClass thing_class = ThingClass::other;
  Pose2 pose = {};                                     ///< in map, x along its heading
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s, in map
  double radius = 0.0;                                 ///< m, > 0
  double height = 0.0;                                 ///< m, > 0
  double length = 0.0;  ///< m, along the heading; 0, as is `width`, where it is not known
  double width = 0.0;   ///< m
  double floor = 0.0;   ///< m, height of the floor in map

  /// True if there is no rectangle, or it has two sides and lies within the cylinder.
  [[nodiscard]] bool sound() const {
    if (length == 0.0 && width == 0.0) return true;
    return length > 0.0 && width > 0.0 &&
           Eigen::Vector2d(length, width).norm() / 2.0 <= radius + kSticksOut;
  }
};

/// Every moving thing at one instant.
struct Obstacles {
  std::int64_t stamp = 0;  ///< ns, ROS time
  std::vector<MovingThing> things = {};
};

}  // namespace navvi_types
