#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::traffic {

/// What a thing that drives a route can do.
struct TrackLimits {
  double acceleration = 0.8;   ///< m/s^2, along the track, and across it in curves
  double turn_rate = 1.0;      ///< rad/s
  double corner_radius = 1.2;  ///< m, at which corners are rounded where there is room
};

/// A route as one smooth way, measured along it: straight lines; arcs that round the corners; and
/// turns on the spot where the route stops or leaves no room to round a corner. A turn on the spot
/// counts kSpinArm metres a radian, so that all motion is along one coordinate: `s`, m. The speed
/// allowed at each place respects the limits on turning and braking.
class Track {
 public:
  static constexpr double kSpinArm = 0.4;  ///< m a rad

  /// A line, an arc or a turn on the spot.
  struct Element {
    double begin = 0.0;   ///< m, its s
    double length = 0.0;  ///< m, > 0
    Eigen::Vector2d from = Eigen::Vector2d::Zero();
    double yaw = 0.0;                                 ///< rad, at its begin
    double curvature = 0.0;                           ///< 1/m, left is positive
    double spin = 0.0;                                ///< rad a metre of s, while standing
    double speed = 0.0;                               ///< m/s, the most within it
    double end_speed = 0.0;                           ///< m/s, the most at its end
    double pause = 0.0;                               ///< s, stands at its end
    Eigen::Vector2d along = Eigen::Vector2d::Zero();  ///< unit vector of yaw, set by Track
    std::size_t corner = 0;                           ///< way-point that it rounds or leads to
    [[nodiscard]] double end() const { return begin + length; }
    [[nodiscard]] Pose2 place(double s) const;
  };

  /// \param route  valid (validate.hpp)
  /// \param radii  m, of the corners, one a way-point; 0: turned on the spot
  Track(const Route& route, const TrackLimits& limits, const std::vector<double>& radii);

  [[nodiscard]] double length() const { return length_; }
  /// False if it ends: s then goes from 0 to length, and does not come round.
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] const std::vector<Element>& elements() const { return elements_; }
  /// The element that holds s.
  [[nodiscard]] std::size_t element_at(double s) const;
  [[nodiscard]] Pose2 place(double s) const { return elements_[element_at(s)].place(s); }
  /// The s of the place nearest to a pose; of equal ones, that with the nearer heading.
  [[nodiscard]] double nearest(const Pose2& pose) const;

 private:
  struct Corner {
    Eigen::Vector2d at;
    double radius;  ///< m, wanted
    double pause;   ///< s
    double speed;   ///< m/s, on the way to it
    std::size_t waypoint;
  };

  /// How the corner at the end of a leg is taken.
  struct Rounding {
    double turn = 0.0;     ///< rad
    double radius = 0.0;   ///< m; 0: on the spot
    double tangent = 0.0;  ///< m, that the arc takes of each leg
  };

  [[nodiscard]] std::vector<Rounding> roundings_of(const std::vector<Corner>& corners) const;
  void lay(const std::vector<Corner>& corners, const TrackLimits& limits);
  void add(Element element);
  void limit_speeds(double acceleration);

  std::vector<Element> elements_;
  double length_ = 0.0;
  bool closed_ = true;
};

}  // namespace navvi_sim::traffic
