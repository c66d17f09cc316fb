#pragma once

#include <cstdint>
#include <map>
#include <navvi_people/loop/closed_loop.hpp>
#include <set>

#include "record/row.hpp"

namespace navvi_study::batch {

using navvi_people::loop::ClosedLoop;

/// Counts what drove near the robot, and judges what its own sensors told of that.
class SensingFigures {
 public:
  /// Call it after every step of `loop`.
  void watch(const ClosedLoop& loop);
  /// Adds: `passed`, how often a mover came within 5 m, where a lidar senses into its sight, and
  /// drove there for 1.5 s; `missed`, how often of these nothing was told within 1 m of it; `ghosts`, numbers of
  /// obstacles that were told to drive where no mover was within 1 m; `lag`, s on the mean from a
  /// mover's driving in sight to the first message that says it drives.
  void add_to(record::Fields& row) const;

 private:
  struct Passage {
    double since = 0.0;   ///< s
    double seen = 0.0;    ///< s, the last time
    bool told = false;    ///< as an obstacle
    bool drives = false;  ///< as one that drives
    bool judged = false;
  };

  std::map<std::uint32_t, Passage> passages_;  ///< by thing
  std::set<std::uint32_t> ghosts_;
  std::uint64_t passed_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t lags_ = 0;
  double lag_ = 0.0;  ///< s, the sum
};

}  // namespace navvi_study::batch
