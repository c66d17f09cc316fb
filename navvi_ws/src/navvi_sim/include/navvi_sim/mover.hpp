#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <navvi_config/field.hpp>
#include <random>
#include <vector>

#include "navvi_sim/world_description.hpp"

namespace navvi_sim {

/// How things with a route behave (R-SIM-3).
struct MoversConfig {
  bool yield = true;          ///< stop for the robot
  double acceleration = 0.8;  ///< m/s^2, to faster and to slower
  double turn_rate = 1.0;     ///< rad/s
  double clearance = 0.4;     ///< m, at which they stop before what is in their way
  double patience = 6.0;      ///< s before two movers that block each other turn back
  double pause_spread = 0.3;  ///< share by which a pause varies either way, drawn from the seed

  void describe(navvi_config::Visitor& visit);
};

/// A vertical cylinder that may stand in a mover's way.
struct Disc {
  Eigen::Vector2d centre;  ///< m, in map
  double radius;           ///< m
};

/// The horizontal extent of a thing about its origin, in its own frame, and its top.
struct Footprint {
  double front = 0.0;   ///< m, from the origin along x to the foremost point
  double back = 0.0;    ///< m, from the origin against x
  double side = 0.0;    ///< m, largest distance from the x axis
  double radius = 0.0;  ///< m, largest distance from the origin
  double bottom = 0.0;  ///< m, lowest z in the frame of the thing's origin, map's axes
  double top = 0.0;     ///< m, likewise
};

/// \param tilt  of the thing's shapes: its orientation without its yaw
[[nodiscard]] Footprint footprint_of(const Thing& thing, const Eigen::Quaterniond& tilt);

/// The thing's heading: rad, the direction of its x axis seen from above.
[[nodiscard]] double yaw_of(const Eigen::Isometry3d& pose);

/// Follows a Route: along straight lines at the route's speed with a smooth start and
/// stop, turning on the spot at corners. Pure: the same calls give the same poses.
class Mover {
 public:
  /// What is near on this step.
  struct Surroundings {
    Disc robot;
    std::vector<Disc> first;    ///< other movers with right of way over this one
    std::vector<Disc> rest;     ///< other movers without
    bool pushing_back = false;  ///< the robot is pressed against and cannot give way: stop dead
  };

  /// \param thing  must have a route
  Mover(std::size_t id, const Thing& thing, const MoversConfig& config, std::uint64_t seed);

  void step(const Surroundings& around, double dt);

  [[nodiscard]] std::size_t id() const { return id_; }
  [[nodiscard]] Eigen::Isometry3d pose() const;
  [[nodiscard]] const Eigen::Vector2d& position() const { return position_; }
  [[nodiscard]] double yaw() const { return yaw_; }
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] double turn_rate() const { return turn_rate_; }
  [[nodiscard]] Eigen::Vector2d velocity() const;
  [[nodiscard]] const Footprint& footprint() const { return footprint_; }
  [[nodiscard]] std::size_t target() const { return target_; }
  [[nodiscard]] double pause_left() const { return pause_left_; }

 private:
  enum class Blocked { no, by_robot, by_mover };

  [[nodiscard]] bool yields() const { return config_.yield && route_.yields; }
  [[nodiscard]] Blocked blocked(const Surroundings& around) const;
  [[nodiscard]] bool in_way(const Disc& disc, double reach) const;
  /// rad, from the heading to the next way-point's direction
  [[nodiscard]] double course_error() const;
  void turn(double dt);
  void drive(double distance, double dt);
  void arrive();
  void advance_target();

  std::size_t id_;
  MoversConfig config_;
  Route route_;
  Footprint footprint_;
  Eigen::Quaterniond tilt_;
  double z_;
  std::mt19937_64 random_;
  Eigen::Vector2d position_;
  double yaw_;
  double speed_ = 0.0;
  double turn_rate_ = 0.0;
  double pause_left_ = 0.0;
  double waited_ = 0.0;
  std::size_t target_ = 0;
  bool backwards_ = false;  ///< the route's order is reversed
  bool turning_ = true;
  bool ended_ = false;  ///< at the last way-point of a route that does not loop
};

}  // namespace navvi_sim
