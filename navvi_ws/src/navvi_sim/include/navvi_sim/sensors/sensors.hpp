#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <navvi_config/field.hpp>
#include <navvi_types/random.hpp>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/live/world.hpp"

namespace navvi_sim::sensors {

/// A lidar that turns in a plane, about x of base_link.
struct LidarConfig {
  double rate = 10.0;       ///< Hz
  double field = 360.0;     ///< degrees, that a scan covers, its middle ahead
  int rays = 360;           ///< of a scan
  double x = 0.0;           ///< m, place in base_link
  double height = 0.12;     ///< m above the floor; the base of a rack is 0.15 m high
  double nearest = 0.1;     ///< m, least range
  double farthest = 12.0;   ///< m
  double noise = 0.01;      ///< m, standard deviation
  double dropouts = 0.005;  ///< share of rays without a measurement

  void describe(navvi_config::Visitor& visit);
};

/// A camera that measures depth, a ray a pixel.
struct CameraConfig {
  double rate = 5.0;      ///< Hz, pictures a second
  double field = 87.0;    ///< degrees, from left to right
  int columns = 64;       ///< pixels from left to right
  int rows = 40;          ///< pixels from top to bottom
  double x = 0.25;        ///< m, place in base_link
  double height = 0.45;   ///< m, above the floor
  double pitch = 20.0;    ///< degrees, downwards
  double nearest = 0.3;   ///< m, least range
  double farthest = 4.0;  ///< m, greatest range
  /// m, standard deviation of a range at 1 m; it grows with the square of the range
  double noise = 0.002;
  double dropouts = 0.01;  ///< share of pixels without a measurement
};

/// What one sensor measured at one instant.
struct Reading {
  std::int64_t stamp = 0;     ///< ns
  std::vector<float> ranges;  ///< m, along each of Sensor::rays(); as in REP-117 NaN where nothing
                              ///< was measured, infinity where nothing was met
  std::vector<std::uint32_t> movers;  ///< the thing that each ray truly met, if it has a route,
                                      ///< else kNoMover: ground truth for evaluation, not
                                      ///< visible to perception
  static constexpr std::uint32_t kNoMover = 0xffffffffU;
};

/// Rays from one place on the robot. Noise and drop-outs are drawn from a seed.
class Sensor {
 public:
  Sensor(const LidarConfig& config, std::uint64_t seed);
  Sensor(const CameraConfig& config, std::uint64_t seed);

  [[nodiscard]] double rate() const { return rate_; }
  [[nodiscard]] double nearest() const { return nearest_; }                ///< m
  [[nodiscard]] double farthest() const { return farthest_; }              ///< m
  [[nodiscard]] const Eigen::Isometry3d& mount() const { return mount_; }  ///< in base_link
  /// Unit vectors, own frame.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& rays() const { return rays_; }

 private:
  friend class Sensors;
  [[nodiscard]] double normal();

  double rate_, nearest_, farthest_;
  double noise_, growth_;  ///< m, and m for each m of range squared
  double dropouts_;
  Eigen::Isometry3d mount_;
  navvi_types::Random random_;
  std::vector<Eigen::Vector3d> rays_;
};

/// The sensors of a simulated robot: what their rays meet of the world, its movers and its floor.
class Sensors {
 public:
  explicit Sensors(const WorldDescription& description);
  ~Sensors();

  [[nodiscard]] Reading look(Sensor& sensor, const live::Snapshot& now) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace navvi_sim::sensors
