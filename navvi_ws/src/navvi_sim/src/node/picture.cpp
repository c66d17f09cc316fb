#include "node/picture.hpp"

#include <algorithm>

#include "navvi_sim/node/msg_conversion.hpp"

namespace navvi_sim::node {
namespace {

// What moves in the picture, for a bag that RViz shows without us: seldom, that it stays small.
constexpr double kRecordedPeriod = 0.5;     // s
constexpr double kRecordedMarkers = 400.0;  // a second, at most

}  // namespace

Picture::Picture(ros::NodeHandle& node, const WorldDescription& world,
                 const physics::RobotConfig& robot, const occupancy::OccupancyMap& map,
                 const live::Session& session)
    : session_(session), looks_(world, robot) {
  // Large and seldom looked at: made for each subscriber.
  cells_ = node.advertise<visualization_msgs::MarkerArray>(
      "occupied_cells_vis_array", 1, [this, &map](const ros::SingleSubscriberPublisher& listener) {
        listener.publish(occupied_cells_msg(map, stamp()));
      });
  standing_ = node.advertise<visualization_msgs::MarkerArray>("navvi/scene", 1, true);
  moving_ = node.advertise<visualization_msgs::MarkerArray>("navvi/scene_moving", 1);
  recorded_ = node.advertise<visualization_msgs::MarkerArray>("navvi/scene_recorded", 1);
}

void Picture::publish_standing() { standing_.publish(looks_.standing(stamp())); }

void Picture::publish_moving() {
  const live::Snapshot& now = session_.world().now();
  const visualization_msgs::MarkerArray& scene = looks_.moving(now, stamp());
  moving_.publish(scene);
  if (now.time < next_recorded_) return;
  recorded_.publish(scene);
  const auto markers = static_cast<double>(scene.markers.size());
  next_recorded_ = now.time + std::max(kRecordedPeriod, markers / kRecordedMarkers);
}

}  // namespace navvi_sim::node
