#include "node/msg_conversion.hpp"

#include <navvi_types/msg_conversion.hpp>

namespace navvi_nav::node {

constexpr std::uint32_t kMaxGridSide = 1000000;  // cells
constexpr float kMeshAlpha = 0.35F;
constexpr double kAboveFloor = 0.02;  // m
constexpr double kBorder = 0.12;      // m, of a zone
constexpr double kDash = 0.5;         // m, of a slow one, and as much between two

plan::MapMessage from_msg(const octomap_msgs::Octomap& map) {
  plan::MapMessage out;
  out.data.assign(map.data.begin(), map.data.end());
  out.binary = map.binary != 0;
  out.id = map.id;
  out.resolution = map.resolution;
  return out;
}

std::string error_of(const octomap_msgs::Octomap& map, const std::string& frame) {
  if (map.header.frame_id != frame)
    return "it is in frame '" + map.header.frame_id + "', not '" + frame + "'";
  if (map.data.size() > map::kMaxMapBytes) return "it is larger than 64 MiB";
  return "";
}

navvi_types::Checked<map::OccupancyGrid> from_msg(const nav_msgs::OccupancyGrid& map) {
  const navvi_types::Checked<navvi_types::Pose2> origin = navvi_types::origin_of(map);
  if (!origin) return navvi_types::Refusal{origin.why()};
  if (map.info.width > kMaxGridSide || map.info.height > kMaxGridSide)
    return navvi_types::Refusal{"it has more than 1000000 cells along a side"};
  map::OccupancyGrid out;
  out.width = static_cast<int>(map.info.width);
  out.height = static_cast<int>(map.info.height);
  out.resolution = static_cast<double>(map.info.resolution);
  out.origin = {origin->position.x(), origin->position.y()};
  out.yaw = origin->yaw;
  out.cells.assign(map.data.begin(), map.data.end());
  return out;
}

visualization_msgs::MarkerArray to_msg(const mesh::Mesh& mesh, double z, const std::string& frame,
                                       const ros::Time& stamp) {
  visualization_msgs::MarkerArray out;
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.header.stamp = stamp;
  marker.ns = "navmesh";
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.action =
      mesh.polygons.empty() ? visualization_msgs::Marker::DELETE : visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.g = 1.0F;
  marker.color.b = 1.0F;
  marker.color.a = kMeshAlpha;
  for (const mesh::Polygon& polygon : mesh.polygons) {
    for (std::size_t k = 2; k < polygon.corners.size(); ++k) {
      for (const std::size_t corner : {std::size_t{0}, k - 1, k}) {
        const Point at = mesh.at(polygon.corners[corner]);
        marker.points.push_back(navvi_types::point_msg({at.x, at.y}, z + kAboveFloor));
      }
    }
  }
  out.markers.push_back(std::move(marker));
  return out;
}

visualization_msgs::MarkerArray to_msg(const map::Zones& zones, double z, const std::string& frame,
                                       const ros::Time& stamp) {
  using visualization_msgs::Marker;
  visualization_msgs::MarkerArray out;
  for (const map::Zone& zone : zones.all()) {
    const bool slow = zone.kind == navvi_types::ZoneState::Kind::slow;
    Marker marker;
    marker.header.frame_id = frame;
    marker.header.stamp = stamp;
    marker.ns = "zone";
    marker.id = static_cast<int>(out.markers.size());
    marker.type = slow ? Marker::LINE_LIST : Marker::LINE_STRIP;
    marker.pose.orientation.w = 1.0;
    marker.scale.x = kBorder;
    marker.color.r = slow ? 0.0F : 1.0F;
    marker.color.g = marker.color.a = 1.0F;
    const auto add = [&](const Point& at) {
      marker.points.push_back(navvi_types::point_msg({at.x, at.y}, z + kAboveFloor));
    };
    for (std::size_t i = 0; i < zone.corners.size(); ++i) {
      const Point from = zone.corners[i];
      const Point edge = zone.corners[(i + 1) % zone.corners.size()] - from;
      const double dashes = slow ? std::max(1.0, std::round(0.5 * norm(edge) / kDash)) : 0.0;
      if (!slow) add(from);
      for (double k = 0.25; k < dashes; k += 0.5) add(from + k / dashes * edge);
    }
    if (!slow) add(zone.corners.front());
    out.markers.push_back(std::move(marker));
  }
  return out;
}

}  // namespace navvi_nav::node
