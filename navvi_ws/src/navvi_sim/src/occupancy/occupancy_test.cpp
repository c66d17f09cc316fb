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

/// Checks voxel by voxel: what `depth` says is inside must be occupied, what it says is more than
/// a voxel's diagonal outside must not be.
/// \param depth  m, of a point of the thing's frame: positive inside, negative outside
template <typename Depth>
void expect_matches(const octomap::OcTree& map, const Eigen::Isometry3d& frame, double around,
                    const Depth& depth) {
  int inside = 0;
  const Eigen::Vector3d centre = frame.translation();
  for (double x = -around; x < around; x += 0.031)
    for (double y = -around; y < around; y += 0.031)
      for (double z = -around; z < around; z += 0.031) {
        const Eigen::Vector3d point = centre + Eigen::Vector3d(x, y, z);
        const double d = depth(frame.inverse() * point);
        const bool is = occupied(map, point.x(), point.y(), point.z());
        if (d > kVoxel * 0.05 * 2.0) {
          ++inside;
          ASSERT_TRUE(is) << point.transpose() << " lies " << d << " m inside";
        }
        if (d < -kVoxel * std::sqrt(3.0)) {
          ASSERT_FALSE(is) << point.transpose() << " lies " << -d << " m outside";
        }
      }
  EXPECT_GT(inside, 100);
}

double box_depth(const Eigen::Vector3d& size, const Eigen::Vector3d& point) {
  const Eigen::Vector3d out = point.cwiseAbs() - size / 2.0;
  return out.maxCoeff() > 0.0 ? -out.cwiseMax(0.0).norm() : -out.maxCoeff();
}

TEST(Occupancy, follows_a_box_however_it_lies) {
  const Eigen::Vector3d size(0.7, 0.4, 0.5);
  for (const auto& frame :
       {pose(0, 0, 0.25), pose(1.013, -0.507, 0.3, 0.0, 0.6), pose(-2.0, 3.0, 1.0, 0.8, 1.9)}) {
    const auto map = map_of({standing(ThingClass::box, Box{size}, frame)});
    expect_matches(map, frame, 0.6, [&](const auto& point) { return box_depth(size, point); });
  }
}

TEST(Occupancy, follows_a_cylinder_however_it_lies) {
  const auto depth = [](const Eigen::Vector3d& point) {
    const double radial = point.head<2>().norm() - 0.3;
    const double along = std::abs(point.z()) - 0.4;
    const double out = std::max(radial, along);
    return out > 0.0 ? -std::hypot(std::max(radial, 0.0), std::max(along, 0.0)) : -out;
  };
  for (const auto& frame : {pose(0.5, 0.5, 0.4), pose(0.51, 0.47, 0.4, 1.0, 0.3)}) {
    const auto map = map_of({standing(ThingClass::other, Cylinder{0.3, 0.8}, frame)});
    expect_matches(map, frame, 0.6, depth);
  }
}

TEST(Occupancy, follows_a_sphere) {
  const Eigen::Isometry3d frame = pose(0.123, 0.456, 0.789);
  const auto map = map_of({standing(ThingClass::other, Sphere{0.4}, frame)});
  expect_matches(map, frame, 0.6, [](const auto& point) { return 0.4 - point.norm(); });
}

TEST(Occupancy, has_the_surface_of_a_mesh_and_not_its_inside) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{0.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 1.0F}};
  mesh->triangles = {{0, 1, 2}};
  const auto map = map_of({standing(ThingClass::other, std::shared_ptr<const Mesh>(mesh),
                                    Eigen::Isometry3d::Identity())});
  EXPECT_TRUE(occupied(map, 0.5, 0.5, 0.24));
  EXPECT_TRUE(occupied(map, 0.02, 1.9, 0.94));
  EXPECT_FALSE(occupied(map, 0.5, 0.5, 0.35));
  EXPECT_FALSE(occupied(map, 0.5, 0.5, 0.12));
  EXPECT_FALSE(occupied(map, 1.5, 1.5, 0.75));
}

/// The same voxels, put in one by one as octomap would have it.
octomap::OcTree inserted(const octomap::OcTree& map) {
  octomap::OcTree tree(map.getResolution());
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf) {
    const octomap::OcTreeKey low = leaf.getIndexKey();
    const int side = 1 << (map.getTreeDepth() - leaf.getDepth());
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z)
          tree.setNodeValue(octomap::OcTreeKey(static_cast<octomap::key_type>(low[0] + x),
                                               static_cast<octomap::key_type>(low[1] + y),
                                               static_cast<octomap::key_type>(low[2] + z)),
                            map.getClampingThresMaxLog(), true);
  }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
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
  EXPECT_TRUE(full == inserted(full));
  expect_matches(full, frame * Eigen::Translation3d(0.5, 0.5, 0.5), 0.8, [](const auto& point) {
    return box_depth(Eigen::Vector3d::Ones(), point) - 0.01;  // it counts a little lower
  });
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

TEST(Occupancy, is_the_tree_that_octomap_makes_of_the_same_voxels) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{0.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 1.0F}};
  mesh->triangles = {{0, 1, 2}};
  const std::vector<Thing> things{
      standing(ThingClass::floor, Box{{6.0, 6.0, 0.1}}, pose(0, 0, -0.05)),
      standing(ThingClass::box, Box{{0.8, 0.8, 0.8}}, pose(0, 0, 0.4)),
      standing(ThingClass::box, Box{{0.4, 0.8, 0.8}}, pose(0.6, 0, 0.4)),  // joins it to one cell
      standing(ThingClass::box, Box{{0.7, 0.6, 0.5}}, pose(-1.5, 0.3, 0.4, 0.3, 0.7)),
      standing(ThingClass::other, Cylinder{0.3, 1.0}, pose(1.5, -1.0, 0.5)),
      standing(ThingClass::other, Cylinder{0.3, 1.0}, pose(1.5, 1.0, 0.5, 1.2)),
      standing(ThingClass::other, Sphere{0.4}, pose(-1.0, -1.0, 0.3)),
      standing(ThingClass::other, std::shared_ptr<const Mesh>(mesh), pose(0.3, 0.3, 0.5))};
  for (std::size_t count = 1; count <= things.size(); ++count) {
    const octomap::OcTree map =
        map_of({things.begin(), things.begin() + static_cast<std::ptrdiff_t>(count)});
    EXPECT_GT(map.getNumLeafNodes(), 100U);
    EXPECT_TRUE(map == inserted(map)) << "with " << count << " things";
  }
}

TEST(Occupancy, of_many_things_is_that_of_each_one) {
  const std::vector<Thing> things{
      standing(ThingClass::box, Box{{0.8, 0.8, 0.8}}, pose(0, 0, 0.4)),
      standing(ThingClass::box, Box{{0.9, 0.3, 0.5}}, pose(0.2, 0.1, 0.6, 0.3, 0.7)),
      standing(ThingClass::other, Cylinder{0.3, 1.0}, pose(0.4, 0.2, 0.5))};
  const auto all = map_of(things);
  std::vector<octomap::OcTree> each;
  for (const Thing& thing : things) each.push_back(map_of({thing}));
  for (double x = -1.0; x < 1.5; x += 0.03)
    for (double y = -1.0; y < 1.0; y += 0.03)
      for (double z = -0.2; z < 1.5; z += 0.03) {
        bool any = false;
        for (const auto& one : each) any = any || occupied(one, x, y, z);
        ASSERT_EQ(occupied(all, x, y, z), any) << x << " " << y << " " << z;
      }
}

TEST(Occupancy, keeps_what_is_thinner_than_a_voxel) {
  const auto map =
      map_of({standing(ThingClass::wall, Box{{0.001, 2.0, 2.0}}, pose(1.0, 0.0, 1.0))});
  EXPECT_TRUE(occupied(map, 1.01, 0.0, 1.0) || occupied(map, 0.99, 0.0, 1.0));
}

TEST(Occupancy, leaves_out_what_has_a_route) {
  Thing mover = standing(ThingClass::forklift, Box{{1.0, 1.0, 1.0}}, pose(0, 0, 0.5));
  mover.route = Route{{{{0, 0}}, {{5, 0}}}};
  EXPECT_FALSE(occupied(map_of({mover}), 0.0, 0.0, 0.5));
}

TEST(Occupancy, of_nothing_is_empty) {
  const auto map = map_of({});
  int occupied_leafs = 0;
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf)
    occupied_leafs += map.isNodeOccupied(*leaf) ? 1 : 0;
  EXPECT_EQ(occupied_leafs, 0);
}

TEST(Occupancy, refuses_what_does_not_fit_into_a_tree) {
  EXPECT_THROW(map_of({standing(ThingClass::floor, Box{{10, 10, 0.1}}, pose(2000.0, 0, 0))}),
               WorldError);
  EXPECT_THROW(map_of({standing(ThingClass::floor, Box{{990, 990, 0.05}}, pose(0, 0, -0.025))}),
               WorldError);
}

}  // namespace
}  // namespace navvi_sim::occupancy
