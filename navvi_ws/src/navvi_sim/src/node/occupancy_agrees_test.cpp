// The OctoMap beside rays and distances that this test computes for itself, in worlds of others and
// in seeded ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/read/world_source.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "octomap_tree.hpp"
#include "warehouse.hpp"

namespace navvi_sim::node {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

using Corners = std::array<Eigen::Vector3d, 3>;

/// Everything that stands in a world: surfaces, and bodies with an inside.
struct Surfaces {
  std::vector<Corners> triangles;
  struct Body {
    Geometry geometry;
    Eigen::Isometry3d pose;
    double radius;  ///< m, around its pose
  };
  std::vector<Body> bodies;
};

Surfaces surfaces_of(const WorldDescription& world) {
  Surfaces surfaces;
  for (const Thing& thing : world.things) {
    if (thing.route) continue;
    for (const Shape& shape : thing.shapes) {
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry)) {
        for (const auto& [a, b, c] : (*mesh)->triangles)
          surfaces.triangles.push_back({pose * (*mesh)->vertices[a].cast<double>(),
                                        pose * (*mesh)->vertices[b].cast<double>(),
                                        pose * (*mesh)->vertices[c].cast<double>()});
      } else if (const auto* box = std::get_if<Box>(&shape.geometry)) {
        surfaces.bodies.push_back({*box, pose, box->size.norm() / 2.0});
      } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
        surfaces.bodies.push_back(
            {*cylinder, pose, std::hypot(cylinder->radius, cylinder->length / 2.0)});
      } else {
        const Sphere& sphere = std::get<Sphere>(shape.geometry);
        surfaces.bodies.push_back({sphere, pose, sphere.radius});
      }
    }
  }
  return surfaces;
}

/// m, from a point to a body, <= 0 inside.
double distance(const Surfaces::Body& body, const Eigen::Vector3d& at) {
  const Eigen::Vector3d p = body.pose.inverse() * at;
  if (const auto* box = std::get_if<Box>(&body.geometry))
    return (p.cwiseAbs() - box->size / 2.0).cwiseMax(0.0).norm();
  if (const auto* cylinder = std::get_if<Cylinder>(&body.geometry))
    return std::hypot(std::max(0.0, p.head<2>().norm() - cylinder->radius),
                      std::max(0.0, std::abs(p.z()) - cylinder->length / 2.0));
  return p.norm() - std::get<Sphere>(body.geometry).radius;
}

/// m, from a point to a triangle: the least over its inside, its sides and its corners.
double distance(const Corners& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  double least = kNever;
  bool over = normal.norm() > 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d side = t[(i + 1) % 3] - t[i];
    over = over && normal.dot(side.cross(p - t[i])) >= 0.0;
    const double share = side.squaredNorm() > 0.0
                             ? std::clamp(side.dot(p - t[i]) / side.squaredNorm(), 0.0, 1.0)
                             : 0.0;
    least = std::min(least, (p - t[i] - share * side).norm());
  }
  if (over) least = std::min(least, std::abs(normal.normalized().dot(p - t[0])));
  return least;
}

double distance(const Surfaces& surfaces, const Eigen::Vector3d& at) {
  double least = kNever;
  for (const Surfaces::Body& body : surfaces.bodies) {
    if ((at - body.pose.translation()).norm() - body.radius < least)
      least = std::min(least, distance(body, at));
  }
  for (const Corners& triangle : surfaces.triangles)
    least = std::min(least, distance(triangle, at));
  return least;
}

/// m along the ray to a triangle (by the plane, then the sides), never if it is missed.
double hit(const Corners& t, const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double slope = normal.dot(way);
  if (std::abs(slope) < 1e-12) return kNever;
  const double along = normal.dot(t[0] - from) / slope;
  if (along < 0.0) return kNever;
  const Eigen::Vector3d p = from + along * way;
  for (std::size_t i = 0; i < 3; ++i)
    if (normal.dot((t[(i + 1) % 3] - t[i]).cross(p - t[i])) < 0.0) return kNever;
  return along;
}

/// m along the ray to a body, by steps of the distance to it; never beyond `most`.
double hit(const Surfaces::Body& body, const Eigen::Vector3d& from, const Eigen::Vector3d& way,
           double most) {
  const double middle = way.dot(body.pose.translation() - from);
  if ((from + middle * way - body.pose.translation()).norm() > body.radius) return kNever;
  for (double along = 0.0; along < most;) {
    const double gap = distance(body, from + along * way);
    if (gap < 1e-5) return along;
    along += gap;
  }
  return kNever;
}

double first_hit(const Surfaces& surfaces, const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                 double most) {
  double first = kNever;
  for (const Corners& triangle : surfaces.triangles)
    first = std::min(first, hit(triangle, from, way));
  for (const Surfaces::Body& body : surfaces.bodies)
    first = std::min(first, hit(body, from, way, std::min(most, first)));
  return first <= most ? first : kNever;
}

/// Whether triangles close a point in: on both sides of it along every one of some ways.
bool enclosed(const Surfaces& surfaces, const Eigen::Vector3d& at) {
  for (const Eigen::Vector3d& way :
       {Eigen::Vector3d(1.0, 0.013, 0.007), Eigen::Vector3d(0.011, 1.0, 0.017),
        Eigen::Vector3d(0.7, -0.6, 0.019), Eigen::Vector3d(0.019, 0.007, 1.0)})
    for (const double side : {-1.0, 1.0})
      if (!std::isfinite(first_hit(surfaces, at, side * way.normalized(), 100.0))) return false;
  return true;
}

/// Checks rays from free places of the floor against the map, and every occupied cell against the
/// surfaces and what they enclose.
void expect_agreement(const WorldDescription& world, std::uint64_t seed) {
  constexpr double kRange = 12.0;  // m
  const occupancy::OccupancyConfig config;
  const octomap::OcTree map = tree_of(occupancy::occupancy_of(world, config));
  const Surfaces surfaces = surfaces_of(world);
  const double voxel = config.resolution;
  const double lift = std::round(world.floor_height / voxel) * voxel - world.floor_height;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int hits = 0;
  const Pose2 stand =
      scenario::draw_scenario(world, occupancy::voxels_of(world, config), {}, seed).start;
  for (int place = 0; place < 60;) {
    const Eigen::Vector3d eye(stand.position.x() + 8.0 * unit(random),
                              stand.position.y() + 8.0 * unit(random),
                              world.floor_height + 0.3 + 0.2 * (1.0 + unit(random)));
    if (distance(surfaces, eye) < 0.2 || enclosed(surfaces, eye)) continue;
    ++place;
    for (int ray = 0; ray < 10; ++ray) {
      const Eigen::Vector3d& from = eye;
      const Eigen::Vector3d way =
          Eigen::Vector3d(unit(random), unit(random), 0.3 * unit(random)).normalized();
      const double truth = first_hit(surfaces, from, way, kRange);
      const octomap::point3d origin(static_cast<float>(from.x()), static_cast<float>(from.y()),
                                    static_cast<float>(from.z() + lift));
      octomap::point3d end;
      const bool seen =
          map.castRay(origin,
                      octomap::point3d(static_cast<float>(way.x()), static_cast<float>(way.y()),
                                       static_cast<float>(way.z())),
                      end, true, kRange + voxel);
      if (std::isfinite(truth)) {
        ++hits;
        ASSERT_TRUE(seen) << "a ray from " << from.transpose() << " along " << way.transpose()
                          << " goes through what it meets at " << truth << " m";
      }
      if (!seen) continue;
      // The map is hit where a surface is; a ray that grazes by may be stopped by a voxel that it
      // shares with a surface.
      const Eigen::Vector3d met(static_cast<double>(end.x()), static_cast<double>(end.y()),
                                static_cast<double>(end.z()) - lift);
      EXPECT_LE(distance(surfaces, met), voxel * std::sqrt(3.0) / 2.0 + voxel * 0.1);
      EXPECT_LE((met - from).norm(), truth + voxel * std::sqrt(3.0))
          << "a ray from " << from.transpose() << " along " << way.transpose();
    }
  }
  EXPECT_GT(hits, 200);
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf) {
    if (random() % 40 != 0) continue;
    const double half = leaf.getSize() / 2.0 - voxel / 2.0;
    const Eigen::Vector3d corner(leaf.getX() + half * unit(random),
                                 leaf.getY() + half * unit(random),
                                 leaf.getZ() + half * unit(random) - lift);
    ASSERT_TRUE(distance(surfaces, corner) <= voxel * std::sqrt(3.0) || enclosed(surfaces, corner))
        << corner.transpose();
  }
}

TEST(OccupancyAgrees, with_the_geometry_of_seeded_warehouses) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) expect_agreement(warehouse(seed), seed);
}

TEST(OccupancyAgrees, with_the_meshes_of_a_world_that_others_made) {
  const std::filesystem::path folder =
      std::filesystem::path(NAVVI_SHARED_DIR) / "worlds/aws_small_warehouse";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not on this machine";
  expect_agreement(read::load_world({(folder / "no_roof_small_warehouse.world").string()}).world,
                   1);
}

}  // namespace
}  // namespace navvi_sim::node
