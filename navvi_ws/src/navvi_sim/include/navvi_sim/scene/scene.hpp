#pragma once

#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "navvi_sim/live/world.hpp"
#include "navvi_sim/physics/robot.hpp"

namespace navvi_sim::scene {

/// A world as RViz shows it, in the frame map: one namespace a class, colours and shapes that read
/// at a glance (R-VIS-2). Looks only: racks, for one, are drawn open where their body is a cube.
class Scene {
 public:
  Scene(const WorldDescription& world, const physics::RobotConfig& robot);

  /// What stands still; to be latched. A picture cut open, so that a view from behind the robot or
  /// from above sees in: walls are drawn to 1.0 m above the floor, everything else to 2.7 m. The
  /// number of markers does not grow with the world, but by one for each standing worker.
  [[nodiscard]] visualization_msgs::MarkerArray standing(const ros::Time& stamp) const;

  /// What moves, and the robot in the namespace `robot`. Ids stay the same from call to call. In
  /// worlds with many movers, those far from the robot take turns. The next call writes over
  /// what this one returns.
  [[nodiscard]] const visualization_msgs::MarkerArray& moving(const live::Snapshot& now,
                                                              const ros::Time& stamp);

 private:
  /// A marker, and where it is on its thing.
  struct Part {
    visualization_msgs::Marker marker;
    Eigen::Isometry3d pose;
  };
  using Parts = std::vector<Part>;

  [[nodiscard]] Parts parts_of(const Thing& thing, std::map<std::string, int>& next_id) const;
  [[nodiscard]] static Parts parts_of(const physics::RobotConfig& robot);

  const WorldDescription& world_;
  Parts robot_;
  std::map<std::size_t, Parts> movers_;  ///< by thing
  visualization_msgs::MarkerArray moving_;
  std::uint64_t turn_ = 0;
};

}  // namespace navvi_sim::scene
