#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <navvi_types/motion.hpp>
#include <vector>

namespace navvi_study {
using navvi_types::Odometry;
}  // namespace navvi_study

namespace navvi_study::trial {

/// map -> odom, from a localisation or the simulator.
struct Correction {
  static constexpr std::int64_t kForGood = std::numeric_limits<std::int64_t>::max();

  std::int64_t stamp = 0;        ///< ns, ROS time; kForGood for one that is sent once
  navvi_types::Pose2 odom = {};  ///< in map
};

/// Takes odometry, which may drift, over to map. Each report gets the first correction that is not
/// older than itself, whichever of the two comes first, so that a bag gives the same places again;
/// where none comes for 0.2 s, the last.
/// Without corrections odom is map.
class OdometryInMap {
 public:
  /// \return in map: none, one, or more that have waited
  [[nodiscard]] std::vector<Odometry> take(const Odometry& odometry);
  [[nodiscard]] std::vector<Odometry> take(const Correction& correction);

 private:
  [[nodiscard]] std::vector<Odometry> release();

  std::deque<Correction> corrections_;  ///< the latest, oldest first
  std::deque<Odometry> waiting_;
};

}  // namespace navvi_study::trial
