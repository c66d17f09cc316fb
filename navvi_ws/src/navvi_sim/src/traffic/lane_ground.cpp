#include "traffic/lane_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_sim::traffic {
namespace {

Eigen::AlignedBox3d bounds_of(const Polygon& polygon, double margin) {
  Eigen::AlignedBox3d bounds;
  const Eigen::Vector3d reach(margin, margin, 0.0);
  for (const Eigen::Vector2d& corner : polygon) {
    const Eigen::Vector3d at(corner.x(), corner.y(), 0.0);
    bounds.extend(at - reach).extend(at + reach);
  }
  return bounds;
}

/// Calls `visit` with the index of each box of the tree that may meet `bounds`.
template <typename Visit>
void for_each_near(const AabbTree& tree, const Eigen::AlignedBox3d& bounds, Visit visit) {
  tree.search([&](const Eigen::AlignedBox3d& box) { return box.intersects(bounds) ? 0.0 : 1.0; },
              [] { return 0.0; }, visit);
}

constexpr double kTurnStep = 0.1;  // rad, between the poses of a body that a block is the hull of

}  // namespace

PolygonIndex::PolygonIndex(const std::vector<Polygon>& polygons, double gap)
    : polygons_(polygons), gap_(gap) {
  for (const Polygon& polygon : polygons) bounds_.push_back(bounds_of(polygon, 0.5 * gap));
  tree_ = AabbTree(bounds_);
}

std::vector<PolygonIndex::Pair> PolygonIndex::pairs(
    const std::function<bool(const Pair&)>& wanted) const {
  std::vector<Pair> found;
  for (std::size_t a = 0; a < bounds_.size(); ++a)
    for_each_near(tree_, bounds_[a], [&](std::size_t b) {
      if (b > a && bounds_[a].intersects(bounds_[b]) && wanted({a, b}) &&
          overlap(polygons_[a], polygons_[b], gap_))
        found.emplace_back(a, b);
    });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::size_t> PolygonIndex::touching(const Polygon& other) const {
  std::vector<std::size_t> found;
  const Eigen::AlignedBox3d bounds = bounds_of(other, 0.0);
  for_each_near(tree_, bounds, [&](std::size_t i) {
    if (bounds_[i].intersects(bounds) && overlap(polygons_[i], other, 0.0)) found.push_back(i);
  });
  std::sort(found.begin(), found.end());
  return found;
}

Polygon swept(const Track& track, const Footprint& print, double from, double to) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(2 * print.hull.size());
  double wider = 0.0;
  const auto stand = [&](const Track::Element& element, double s) {
    const Pose2 place = element.place(s);
    const Eigen::Rotation2Dd rotation(place.yaw);
    for (const Eigen::Vector2d& corner : print.hull)
      points.push_back(place.position + rotation * corner);
  };
  for (std::size_t e = track.element_at(from); e < track.elements().size(); ++e) {
    const Track::Element& element = track.elements()[e];
    if (element.begin >= to) break;
    const double begin = std::max(from, element.begin);
    const double end = std::min(to, element.end());
    const double turn = (std::abs(element.curvature) + std::abs(element.spin)) * (end - begin);
    const int steps = std::max(1, static_cast<int>(std::ceil(turn / kTurnStep)));
    for (int i = 0; i <= steps; ++i) stand(element, begin + (end - begin) * i / steps);
    // Between two poses a point leaves their chord by the arc's height.
    if (turn > 0.0) {
      const double radius =
          print.radius + (element.curvature != 0.0 ? 1.0 / std::abs(element.curvature) : 0.0);
      wider = std::max(wider, radius * (1.0 - std::cos(0.5 * turn / steps)));
    }
  }
  Polygon hull = convex_hull(std::move(points));
  if (wider == 0.0) return hull;
  std::vector<Eigen::Vector2d> grown;
  for (const Eigen::Vector2d& corner : hull)
    for (const double x : {wider, -wider})
      for (const double y : {wider, -wider}) grown.push_back(corner + Eigen::Vector2d(x, y));
  return convex_hull(std::move(grown));
}

std::vector<Polygon> ground_of(const Lane& lane) {
  std::vector<Polygon> ground;
  for (int block = 0; block < lane.blocks; ++block)
    ground.push_back(swept(lane.track, lane.footprint, block * lane.block_length,
                           (block + 1) * lane.block_length));
  return ground;
}

void for_each_standing(const WorldDescription& world, double least,
                       const std::function<void(const Standing&)>& visit) {
  for (std::size_t id = 0; id < world.things.size(); ++id) {
    const Thing& thing = world.things[id];
    if (thing.route) continue;
    const auto show = [&](const std::vector<Eigen::Vector3d>& points) {
      Standing standing{
          id, std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), {}};
      std::vector<Eigen::Vector2d> seen;
      for (const Eigen::Vector3d& point : points) {
        standing.bottom = std::min(standing.bottom, point.z());
        standing.top = std::max(standing.top, point.z());
        seen.emplace_back(point.x(), point.y());
      }
      if (standing.top <= world.floor_height + least) return;
      standing.polygon = convex_hull(std::move(seen));
      visit(standing);
    };
    for (const Shape& shape : thing.shapes) {
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry)) {
        const auto at = [&](std::uint32_t index) -> Eigen::Vector3d {
          return pose * (*mesh)->vertices[index].cast<double>();
        };
        for (const auto& [a, b, c] : (*mesh)->triangles) show({at(a), at(b), at(c)});
      } else {
        std::vector<Eigen::Vector3d> points = hull_points(shape.geometry);
        for (Eigen::Vector3d& point : points) point = pose * point;
        show(points);
      }
    }
  }
}

}  // namespace navvi_sim::traffic
