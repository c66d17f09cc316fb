#include "navvi_sim/msg_conversion.hpp"

#include <sstream>

#include "painter.hpp"

namespace navvi_sim {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

octomap_msgs::Octomap to_msg(const octomap::OcTree& map, const ros::Time& stamp) {
  octomap_msgs::Octomap msg;
  msg.header.frame_id = "map";
  msg.header.stamp = stamp;
  msg.binary = true;
  msg.id = map.getTreeType();
  msg.resolution = map.getResolution();
  std::ostringstream stream;
  map.writeBinaryData(stream);
  const std::string data = stream.str();
  msg.data.assign(data.begin(), data.end());
  return msg;
}

std::unique_ptr<octomap::OcTree> from_msg(const octomap_msgs::Octomap& msg) {
  auto map = std::make_unique<octomap::OcTree>(msg.resolution);
  std::istringstream stream(std::string(msg.data.begin(), msg.data.end()));
  map->readBinaryData(stream);
  return map;
}

namespace {

std::size_t occupied(const octomap::OcTree& map, unsigned depth) {
  std::size_t count = 0;
  for (auto leaf = map.begin_leafs(static_cast<unsigned char>(depth)); leaf != map.end_leafs();
       ++leaf)
    count += map.isNodeOccupied(*leaf) ? 1 : 0;
  return count;
}

}  // namespace

MarkerArray occupied_cells_msg(const octomap::OcTree& map, const ros::Time& stamp,
                               std::size_t most) {
  constexpr Color kVoxel{0.35F, 0.38F, 0.42F};
  MarkerArray array;
  for (unsigned depth = 0; depth <= map.getTreeDepth(); ++depth) {
    Marker msg = marker_msg("map", static_cast<int>(depth), Marker::CUBE_LIST, kVoxel);
    msg.header.stamp = stamp;
    msg.scale.x = msg.scale.y = msg.scale.z = map.getNodeSize(depth);
    msg.action = Marker::DELETE;
    array.markers.push_back(std::move(msg));
  }
  unsigned depth = map.getTreeDepth();
  while (depth > 1 && occupied(map, depth) > most) --depth;
  for (auto leaf = map.begin_leafs(static_cast<unsigned char>(depth)); leaf != map.end_leafs();
       ++leaf) {
    if (!map.isNodeOccupied(*leaf)) continue;
    Marker& msg = array.markers[leaf.getDepth()];
    msg.action = Marker::ADD;
    msg.points.push_back(point_msg({leaf.getX(), leaf.getY(), leaf.getZ()}));
  }
  return array;
}

}  // namespace navvi_sim
