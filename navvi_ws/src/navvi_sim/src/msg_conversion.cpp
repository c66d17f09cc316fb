#include "navvi_sim/msg_conversion.hpp"

#include <map>
#include <utility>

#include "painter.hpp"

namespace navvi_sim {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

octomap_msgs::Octomap to_msg(const OccupancyMap& map, const ros::Time& stamp) {
  octomap_msgs::Octomap msg;
  msg.header.frame_id = "map";
  msg.header.stamp = stamp;
  msg.binary = true;
  msg.id = "OcTree";
  msg.resolution = map.resolution();
  msg.data = map.stream();
  return msg;
}

namespace {

std::size_t count_cubes(const OccupancyMap& map, int finest) {
  std::size_t count = 0;
  map.for_each_cube([&](const OccupiedCube&) { ++count; }, finest);
  return count;
}

}  // namespace

MarkerArray occupied_cells_msg(const OccupancyMap& map, const ros::Time& stamp, std::size_t most) {
  constexpr Color kVoxel{0.35F, 0.38F, 0.42F};
  MarkerArray array;
  std::map<int, std::size_t> depths;  // by side
  for (int depth = 0; depth <= OccupancyMap::kDepth; ++depth) {
    const int side = 1 << (OccupancyMap::kDepth - depth);
    depths[side] = array.markers.size();
    Marker msg = marker_msg("map", depth, Marker::CUBE_LIST, kVoxel);
    msg.header.stamp = stamp;
    msg.scale.x = msg.scale.y = msg.scale.z = side * map.resolution();
    msg.action = Marker::DELETE;
    array.markers.push_back(std::move(msg));
  }
  int finest = 1;
  while (finest < OccupancyMap::kCenter && count_cubes(map, finest) > most) finest *= 2;
  map.for_each_cube(
      [&](const OccupiedCube& cube) {
        Marker& msg = array.markers[depths.at(cube.side)];
        const auto centre = [&](int low) { return (low + 0.5 * cube.side) * map.resolution(); };
        msg.action = Marker::ADD;
        msg.points.push_back(point_msg({centre(cube.x), centre(cube.y), centre(cube.z)}));
      },
      finest);
  return array;
}

}  // namespace navvi_sim
