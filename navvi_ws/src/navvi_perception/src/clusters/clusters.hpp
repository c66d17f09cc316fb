#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace navvi_perception::clusters {

/// Points that belong together, seen from above. Frame: map.
struct Cluster {
  std::vector<std::size_t> members;                  ///< indices of its points
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m, middle of the cylinder
  double radius = 0.0;                               ///< m, of the cylinder about what was seen
  double length = 0.0;                               ///< m, longest extent of what was seen
  double top = 0.0;                                  ///< m, z of the highest point
};

/// Points whose neighbours along x and y are at most `gap` m away are one cluster. Only the side
/// towards the sensor is seen: the cylinder lies behind it, and is at least `radius` m wide.
/// \param origin  m, of the sensor
[[nodiscard]] std::vector<Cluster> clusters_of(const std::vector<Eigen::Vector3d>& points,
                                               double gap, double radius,
                                               const Eigen::Vector2d& origin);

/// Numbers for the standing things around: cells that are near each other are one thing, which
/// keeps its number as long as most of its place is where it was.
class StandingThings {
 public:
  using Cell = std::pair<int, int>;
  struct StandingThing {
    std::uint32_t id = 0;
    std::vector<Cell> cells;
  };

  /// \param apart  cells at most so far apart along x and y are surely of one thing; >= 1
  /// \param next   the next free number, counted on
  [[nodiscard]] const std::vector<StandingThing>& update(const std::vector<Cell>& cells, int apart,
                                                         std::uint32_t& next);
  [[nodiscard]] const std::vector<StandingThing>& now() const { return things_; }

 private:
  std::vector<StandingThing> things_;
  std::map<Cell, std::uint32_t> ids_;  ///< by blocks of cells
};

}  // namespace navvi_perception::clusters
