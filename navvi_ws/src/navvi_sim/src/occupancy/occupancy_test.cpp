#include "navvi_sim/occupancy/occupancy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "octomap_tree.hpp"

namespace navvi_sim::occupancy {
namespace {

constexpr double kVoxel = 0.05;

Thing standing(ThingClass thing_class, const Geometry& geometry, const Eigen::Isometry3d& pose) {
  Thing thing;
  thing.name = "thing";
  thing.thing_class = thing_class;
  thing.pose = pose;
  thing.shapes.push_back({geometry, Eigen::Isometry3d::Identity()});
  return thing;
}

Eigen::Isometry3d pose(double x, double y, double z, double roll = 0.0, double yaw = 0.0) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = Eigen::Vector3d(x, y, z);
  result.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  result.rotate(Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return result;
}

octomap::OcTree map_of(const std::vector<Thing>& things, double floor_height = 0.0,
                       double resolution = kVoxel) {
  WorldDescription world;
  world.floor_height = floor_height;
  world.things = things;
  return tree_of(occupancy_of(world, OccupancyConfig{resolution}));
}

/// A box of 1 x 1 x 1 m as a mesh on the floor, without its lid if `open`.
std::shared_ptr<const Mesh> crate(bool open) {
  auto mesh = std::make_shared<Mesh>();
  for (const float z : {0.0F, 1.0F})
    for (const float y : {0.0F, 1.0F})
      for (const float x : {0.0F, 1.0F}) mesh->vertices.emplace_back(x, y, z);
  mesh->triangles = {{0, 1, 3}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 3, 7},
                     {1, 7, 5}, {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}};
  if (!open) mesh->triangles.insert(mesh->triangles.end(), {{4, 5, 7}, {4, 7, 6}});
  return mesh;
}

TEST(Occupancy, fills_a_closed_mesh_and_no_open_one_and_no_wall) {
  const Eigen::Isometry3d frame = pose(0.013, 0.021, 0.0, 0.0, 0.3);
  const Eigen::Vector3d inside = frame * Eigen::Vector3d(0.5, 0.5, 0.5);
  const Eigen::Vector3d beside = frame * Eigen::Vector3d(1.2, 0.5, 0.5);
  const auto at = [](const octomap::OcTree& map, const Eigen::Vector3d& p) {
    return occupied(map, p.x(), p.y(), p.z());
  };
  const auto full = map_of({standing(ThingClass::box, crate(false), frame)});
  EXPECT_TRUE(at(full, inside));
  EXPECT_FALSE(at(full, beside));
  EXPECT_FALSE(at(map_of({standing(ThingClass::box, crate(true), frame)}), inside));
  EXPECT_FALSE(at(map_of({standing(ThingClass::wall, crate(false), frame)}), inside));
}

TEST(Occupancy, fills_a_solid_mesh_however_wide_and_whatever_its_class) {
  for (const ThingClass thing_class : {ThingClass::wall, ThingClass::other}) {
    Thing block = standing(thing_class, crate(false), pose(0, 0, 0.01));
    auto wide =
        std::make_shared<Mesh>(*std::get<std::shared_ptr<const Mesh>>(block.shapes[0].geometry));
    for (Eigen::Vector3f& vertex : wide->vertices) vertex.head<2>() *= 6.0F;
    block.shapes[0].geometry = std::shared_ptr<const Mesh>(wide);
    EXPECT_FALSE(occupied(map_of({block}), 3.0, 3.0, 0.5));
    block.shapes[0].solid = true;
    EXPECT_TRUE(occupied(map_of({block}), 3.0, 3.0, 0.5));
    EXPECT_FALSE(occupied(map_of({block}), 3.0, 3.0, 1.1));
  }
}

TEST(Occupancy, does_not_let_the_floor_creep_up) {
  const auto slab = standing(ThingClass::floor, Box{{4.0, 4.0, 0.1}}, pose(0, 0, -0.05));
  auto plane = std::make_shared<Mesh>();
  plane->vertices = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
  plane->triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto sheet = standing(ThingClass::floor, std::shared_ptr<const Mesh>(plane), pose(0, 0, 0));
  for (const Thing& floor : {slab, sheet}) {
    const auto map = map_of({floor});
    EXPECT_TRUE(occupied(map, 0.01, 0.01, -0.02));
    EXPECT_FALSE(occupied(map, 0.01, 0.01, 0.02));
    EXPECT_FALSE(occupied(map, 2.1, 0.01, -0.02));
  }
}

TEST(Occupancy, shows_a_pedestal_of_5_cm_on_a_floor_at_any_height) {
  for (const double resolution : {0.05, 0.08, 0.1, 0.2}) {
    for (double floor = -0.3; floor < 0.3; floor += 0.007) {
      const auto map =
          map_of({standing(ThingClass::floor, Box{{4.0, 4.0, 0.1}}, pose(0, 0, floor - 0.05)),
                  standing(ThingClass::pedestal, Box{{1.2, 1.0, 0.05}}, pose(0, 0, floor + 0.025))},
                 floor, resolution);
      const double border = std::round(floor / resolution) * resolution;
      EXPECT_NEAR(border, floor, resolution / 2 + 1e-9);
      EXPECT_TRUE(occupied(map, 1.5, 1.5, border - 0.02)) << floor;
      EXPECT_FALSE(occupied(map, 1.5, 1.5, border + 0.02)) << floor;
      EXPECT_TRUE(occupied(map, 0.1, 0.1, border + 0.02)) << floor << " at " << resolution;
      EXPECT_FALSE(occupied(map, 0.1, 0.1, border + 0.05 + resolution)) << floor;
    }
  }
}

TEST(Occupancy, has_no_step_where_the_robot_drives_over) {
  auto bump = std::make_shared<Mesh>();  // a sill of 3 cm, and a wall that stands on it
  bump->vertices = {{0, 0, 0},       {1, 0, 0.03F},   {0, 1, 0.03F},
                    {0, 1.5F, 0.0F}, {1, 1.5F, 0.0F}, {1, 1.5F, 1.0F}};
  bump->triangles = {{0, 1, 2}, {3, 4, 5}};
  for (const double resolution : {0.02, 0.05, 0.1}) {
    for (const double floor : {0.0, -0.013, 0.16}) {
      const auto map = map_of(
          {standing(ThingClass::floor, Box{{8.0, 8.0, 0.1}}, pose(0, 0, floor - 0.05)),
           standing(ThingClass::other, Box{{1.0, 1.0, 0.002}}, pose(-2, 0, floor + 0.001)),
           standing(ThingClass::other, Cylinder{0.5, 0.049}, pose(-2, 2, floor + 0.0245)),
           standing(ThingClass::floor, Box{{1.0, 1.0, 0.1}}, pose(5, 0, floor - 0.09)),
           standing(ThingClass::other, std::shared_ptr<const Mesh>(bump), pose(1, 1, floor))},
          floor, resolution);
      const double border = std::round(floor / resolution) * resolution;
      for (const auto& [x, y] : {std::pair{-1.99, 0.01}, {-1.99, 2.01}, {5.01, 0.01}, {1.3, 1.3}}) {
        EXPECT_TRUE(occupied(map, x, y, border - 0.01)) << x << ' ' << floor << ' ' << resolution;
        EXPECT_FALSE(occupied(map, x, y, border + 0.01)) << x << ' ' << floor << ' ' << resolution;
      }
      EXPECT_TRUE(occupied(map, 1.95, 2.499, border + 0.55)) << resolution;
    }
  }
}

TEST(Occupancy, leaves_out_what_has_a_route) {
  Thing mover = standing(ThingClass::forklift, Box{{1.0, 1.0, 1.0}}, pose(0, 0, 0.5));
  mover.route = Route{{{{0, 0}}, {{5, 0}}}};
  EXPECT_FALSE(occupied(map_of({mover}), 0.0, 0.0, 0.5));
}

TEST(Occupancy, refuses_what_does_not_fit_into_a_tree) {
  EXPECT_THROW(map_of({standing(ThingClass::floor, Box{{10, 10, 0.1}}, pose(2000.0, 0, 0))}),
               WorldError);
  EXPECT_THROW(map_of({standing(ThingClass::floor, Box{{990, 990, 0.05}}, pose(0, 0, -0.025))}),
               WorldError);
}

}  // namespace
}  // namespace navvi_sim::occupancy
