#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2/buffer_core.h>

#include <deque>
#include <optional>
#include <string>

namespace navvi_perception::node {

/// A scan or a cloud, and when it came.
struct Waiting {
  std_msgs::Header header;
  double sweep = 0.0;  ///< s, from the first ray to the last
  ros::Time came;
  sensor_msgs::LaserScan::ConstPtr scan;
  sensor_msgs::PointCloud2::ConstPtr cloud;
};

/// What a sensor sent, in its order, until transforms tell where the sensor and the robot were. A
/// scan waits for the place of its last ray where that comes soon; else all its rays count as
/// measured at its stamp, so that none is lost because its sweep is known.
class SensorQueue {
 public:
  static constexpr std::size_t kMost = 10;  ///< that wait
  static constexpr double kOld = 1.0;       ///< s; an older message tells of another place

  SensorQueue(const tf2::BufferCore& transforms, std::string map_frame, std::string base_frame)
      : transforms_(transforms),
        map_frame_(std::move(map_frame)),
        base_frame_(std::move(base_frame)) {}

  /// The first one, if it need not wait any more, or why it is dropped.
  struct Next {
    Waiting one;
    bool whole = false;  ///< the sensor's place is known for all of the sweep
    std::string why;     ///< empty: it is used
  };

  /// \return why one was dropped, this one or the first; empty: none was
  [[nodiscard]] std::string push(Waiting one);
  [[nodiscard]] std::optional<Next> next(const ros::Time& now);

 private:
  [[nodiscard]] bool is_placed(const std_msgs::Header& header, double later) const;
  [[nodiscard]] std::string why_not_placed(const std_msgs::Header& header) const;

  const tf2::BufferCore& transforms_;
  std::string map_frame_, base_frame_;
  std::deque<Waiting> waiting_;
};

}  // namespace navvi_perception::node
