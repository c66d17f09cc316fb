#include "occupancy/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "navvi_sim/occupancy/occupancy.hpp"
#include "octomap_tree.hpp"

namespace navvi_sim::occupancy {
namespace {

constexpr long double kBeside = 1e-10L;  // m: what is nearer to a voxel than that belongs to it
constexpr long double kAway = 1e-5L;     // m: what is farther away does not

using Point = std::array<long double, 3>;
using Corners = std::array<Eigen::Vector3d, 3>;
using Voxel = std::array<int, 3>;

/// An independent rasteriser: what of a triangle lies in a voxel that is grown to each side, by
/// clipping (Sutherland and Hodgman, 1974).
bool reaches(const Corners& corners, const Voxel& voxel, double resolution, long double grown) {
  std::vector<Point> polygon;
  for (const Eigen::Vector3d& corner : corners)
    polygon.push_back({corner.x(), corner.y(), corner.z()});
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const long double border = (voxel[axis] + (side > 0 ? 1 : 0)) * (long double){resolution};
      const auto inside = [&](const Point& p) { return grown - side * (p[axis] - border); };
      std::vector<Point> rest;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point& a = polygon[i];
        const Point& b = polygon[(i + 1) % polygon.size()];
        const long double in_a = inside(a), in_b = inside(b);
        if (in_a >= 0) rest.push_back(a);
        if ((in_a >= 0) == (in_b >= 0)) continue;
        Point cut;
        for (std::size_t k = 0; k < 3; ++k) cut[k] = a[k] + (b[k] - a[k]) * in_a / (in_a - in_b);
        cut[axis] = border + side * grown;
        rest.push_back(cut);
      }
      polygon = std::move(rest);
    }
  return !polygon.empty();
}

/// Where the map has the triangles of a mesh: a surface counts a little lower than it is.
std::vector<Corners> triangles_of(const Thing& thing, double resolution) {
  std::vector<Corners> triangles;
  for (const Shape& shape : thing.shapes) {
    const auto& mesh = *std::get<std::shared_ptr<const Mesh>>(shape.geometry);
    for (const auto& indices : mesh.triangles) {
      Corners& corners = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = thing.pose * (shape.pose * mesh.vertices[indices[i]].cast<double>()) -
                     0.05 * resolution * Eigen::Vector3d::UnitZ();
    }
  }
  return triangles;
}

octomap::OcTree map_of(const std::vector<Thing>& things, double resolution) {
  WorldDescription world;
  world.floor_height = -5.0;
  world.things = things;
  return tree_of(occupancy_of(world, OccupancyConfig{resolution}));
}

/// Counts the voxels near `middle` that the surface of a thing reaches into and the map lacks, and
/// those that the map has though none of it is near.
std::pair<int, int> faults(const Thing& thing, double resolution, const Eigen::Vector3d& middle,
                           double around) {
  const octomap::OcTree map = map_of({thing}, resolution);
  const std::vector<Corners> triangles = triangles_of(thing, resolution);
  Eigen::AlignedBox3d bounds;
  for (const Corners& corners : triangles)
    for (const Eigen::Vector3d& corner : corners) bounds.extend(corner);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(around);
  bounds = bounds.intersection(Eigen::AlignedBox3d(middle - reach, middle + reach));
  std::array<int, 3> low, high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    low[axis] = static_cast<int>(std::floor(bounds.min()[i] / resolution)) - 2;
    high[axis] = static_cast<int>(std::floor(bounds.max()[i] / resolution)) + 2;
  }
  int missing = 0, too_many = 0;
  for (int x = low[0]; x <= high[0]; ++x)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int z = low[2]; z <= high[2]; ++z) {
        const auto touches = [&](long double grown) {
          return std::any_of(triangles.begin(), triangles.end(), [&](const Corners& corners) {
            return reaches(corners, {x, y, z}, resolution, grown);
          });
        };
        const bool is =
            occupied(map, (x + 0.5) * resolution, (y + 0.5) * resolution, (z + 0.5) * resolution);
        if (!is && touches(kBeside)) ++missing;
        if (is && !touches(kAway)) ++too_many;
      }
  return {missing, too_many};
}

Thing mesh_thing(const std::vector<Eigen::Vector3d>& corners, const Eigen::Isometry3d& pose) {
  auto mesh = std::make_shared<Mesh>();
  for (const Eigen::Vector3d& corner : corners) mesh->vertices.push_back(corner.cast<float>());
  for (std::uint32_t i = 2; i < corners.size(); ++i) mesh->triangles.push_back({0, i - 1, i});
  Thing thing;
  thing.name = "sheet";
  thing.thing_class = ThingClass::wall;
  thing.pose = pose;
  thing.shapes.push_back({std::shared_ptr<const Mesh>(mesh), Eigen::Isometry3d::Identity()});
  return thing;
}

/// An upright sheet of a width and height through the origin, then turned.
Thing sheet(double width, double height, const Eigen::Vector3d& at, double yaw, double tilt) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = at;
  pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()));
  const double y = width / 2.0, z = height / 2.0;
  return mesh_thing({{0, -y, -z}, {0, y, -z}, {0, y, z}, {0, -y, z}}, pose);
}

TEST(Triangle, of_a_face_on_any_border_of_voxels_touches_both_sides) {
  for (const double resolution : {0.05, 0.04, 0.1})
    for (int k = -400; k <= 400; ++k)
      for (const double yaw : {0.0, kPi / 2, kPi}) {
        const double plane = k * resolution;
        const Eigen::Vector3d at =
            yaw == kPi / 2 ? Eigen::Vector3d(0.0, plane, 1.0) : Eigen::Vector3d(plane, 0.0, 1.0);
        const auto [missing, too_many] = faults(sheet(0.2, 0.2, at, yaw, 0.0), resolution, at, 1.0);
        EXPECT_EQ(missing, 0) << plane << " m at " << resolution << " m, yaw " << yaw;
        EXPECT_EQ(too_many, 0) << plane << " m at " << resolution << " m, yaw " << yaw;
      }
}

TEST(Triangle, with_its_corners_in_map_is_on_its_border_too) {
  for (int k = 1; k <= 400; ++k) {
    const double x = 0.05 * k;
    const Thing wall = mesh_thing({{x, -0.1, 0.9}, {x, 0.1, 0.9}, {x, 0.1, 1.1}, {x, -0.1, 1.1}},
                                  Eigen::Isometry3d::Identity());
    EXPECT_EQ(faults(wall, 0.05, {x, 0, 1}, 1.0), std::make_pair(0, 0)) << x;
  }
}

TEST(Triangle, is_where_a_rasteriser_has_it_at_any_angle_and_scale) {
  for (const double resolution : {0.05, 0.025})
    for (const double plane : {0.75, 3.0, 5.75, 9.5, -19.0, 500.0})
      for (const double yaw : {0.0, 1e-7, 0.1, kPi / 6, 3 * kPi / 4})
        for (const double tilt : {0.0, 1e-9, 0.3})
          for (const auto& [width, height] :
               {std::pair{0.003, 0.003}, {0.3, 0.2}, {0.3, 1e-4}, {60.0, 0.3}, {60.0, 1e-4}}) {
            const Eigen::Vector3d at(plane, 0.0, 1.0);
            const auto [missing, too_many] =
                faults(sheet(width, height, at, yaw, tilt), resolution, at, 0.15);
            EXPECT_EQ(missing, 0) << plane << " m at " << resolution << " m, turned by " << yaw
                                  << ", " << tilt << ", " << width << " x " << height;
            EXPECT_EQ(too_many, 0) << plane << " m at " << resolution << " m, turned by " << yaw
                                   << ", " << tilt << ", " << width << " x " << height;
          }
}

}  // namespace
}  // namespace navvi_sim::occupancy
