#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "navvi_study/trial_monitor.hpp"

namespace navvi_study {

/// map -> odom, as a localisation or the simulator tells it.
struct Correction {
  static constexpr std::int64_t kForGood = std::numeric_limits<std::int64_t>::max();

  std::int64_t stamp = 0;  ///< ns, ROS time; kForGood for one that is told once
  Point2 origin;           ///< m, of odom in map
  double yaw = 0.0;        ///< rad
};

/// Takes odometry, which may drift, over to map. Each report gets the first correction that is not
/// older than itself, whichever of the two comes first, so that a bag gives the same places again.
/// While nobody corrects, odom is map.
class OdometryInMap {
 public:
  /// \return in map: none, one, or more that have waited
  [[nodiscard]] std::vector<OdometryReport> take(const OdometryReport& odometry);
  [[nodiscard]] std::vector<OdometryReport> take(const Correction& correction);

 private:
  [[nodiscard]] std::vector<OdometryReport> release();

  std::deque<Correction> corrections_;  ///< the latest, oldest first
  std::deque<OdometryReport> waiting_;
};

}  // namespace navvi_study
