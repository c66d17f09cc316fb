#include "navvi_sim/node/msg_conversion.hpp"

#include <map>
#include <utility>
#include <vector>

#include "scene/painter.hpp"

namespace navvi_sim::node {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

octomap_msgs::Octomap to_msg(const occupancy::OccupancyMap& map, const ros::Time& stamp) {
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

/// voxels, the least side of cubes of which for_each_cube visits `most` at most.
int finest_of(const occupancy::OccupancyMap& map, std::size_t most) {
  // Nodes by their side.
  std::vector<std::size_t> whole(occupancy::OccupancyMap::kCenter + 1),
      partial(occupancy::OccupancyMap::kCenter + 1);
  map.for_each_node([&](const occupancy::OccupiedCube& cube, bool is_whole) {
    ++(is_whole ? whole : partial)[static_cast<std::size_t>(cube.side)];
  });
  std::size_t cubes = 0;
  int finest = occupancy::OccupancyMap::kCenter;
  for (int side = occupancy::OccupancyMap::kCenter; side > 0; side /= 2) {
    cubes += whole[static_cast<std::size_t>(side)];
    if (cubes + partial[static_cast<std::size_t>(side)] <= most) finest = side;
  }
  return finest;
}

}  // namespace

MarkerArray occupied_cells_msg(const occupancy::OccupancyMap& map, const ros::Time& stamp,
                               std::size_t most) {
  constexpr scene::Color kVoxel{0.35F, 0.38F, 0.42F};
  MarkerArray array;
  std::map<int, std::size_t> depths;  // by side
  for (int depth = 0; depth <= occupancy::OccupancyMap::kDepth; ++depth) {
    const int side = 1 << (occupancy::OccupancyMap::kDepth - depth);
    depths[side] = array.markers.size();
    Marker msg = scene::marker_msg("map", depth, Marker::CUBE_LIST, kVoxel);
    msg.header.stamp = stamp;
    msg.scale.x = msg.scale.y = msg.scale.z = side * map.resolution();
    msg.action = Marker::DELETE;
    array.markers.push_back(std::move(msg));
  }
  map.for_each_cube(
      [&](const occupancy::OccupiedCube& cube) {
        Marker& msg = array.markers[depths.at(cube.side)];
        const auto centre = [&](int low) { return (low + 0.5 * cube.side) * map.resolution(); };
        msg.action = Marker::ADD;
        msg.points.push_back(scene::point_msg({centre(cube.x), centre(cube.y), centre(cube.z)}));
      },
      finest_of(map, most));
  return array;
}

}  // namespace navvi_sim::node
