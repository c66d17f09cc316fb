#include "occupancy/octree.hpp"

#include <gtest/gtest.h>

#include <array>

#include "navvi_sim/occupancy/occupancy.hpp"

namespace navvi_sim::occupancy {
namespace {

/// A hall of 4 x 4 m with a floor, a wall along x, and a box in the middle.
WorldDescription hall() {
  WorldDescription world;
  const auto add = [&](ThingClass what, const Eigen::Vector3d& size, const Eigen::Vector3d& at) {
    Thing thing;
    thing.name = to_string(what);
    thing.thing_class = what;
    Shape shape;
    shape.geometry = Box{size};
    thing.shapes = {shape};
    thing.pose.translation() = at;
    world.things.push_back(thing);
  };
  add(ThingClass::floor, {4.0, 4.0, 0.2}, {0.0, 0.0, -0.1});
  add(ThingClass::wall, {4.0, 0.2, 2.0}, {0.0, 1.9, 1.0});
  add(ThingClass::box, {0.4, 0.4, 0.4}, {0.0, 0.0, 0.2});
  return world;
}

enum class Known { no, free, occupied };

Known at(const octomap::OcTree& tree, double x, double y, double z) {
  const octomap::OcTreeNode* node = tree.search(x, y, z);
  if (node == nullptr) return Known::no;
  return tree.isNodeOccupied(node) ? Known::occupied : Known::free;
}

TEST(Octree, comes_and_goes_without_a_change) {
  const OccupancyMap map = occupancy_of(hall(), {});
  EXPECT_EQ(map_of(*octree_of(map)).stream(), map.stream());
  EXPECT_TRUE(map_of(*octree_of(OccupancyMap(0.05, {}))).stream().empty());
}

TEST(Octree, knows_what_is_free_between_the_floor_and_as_high_as_a_mapper_looks) {
  const auto tree = octree_of(with_free_space(occupancy_of(hall(), {}), hall()));
  EXPECT_EQ(at(*tree, 1.0, 1.0, 0.5), Known::free);
  EXPECT_EQ(at(*tree, 0.0, 0.0, 1.0), Known::free) << "above the box";
  EXPECT_EQ(at(*tree, 1.0, 1.0, 3.0), Known::free);
  EXPECT_EQ(at(*tree, 0.0, 0.0, 0.2), Known::occupied);
  EXPECT_EQ(at(*tree, 1.0, 1.0, -0.05), Known::occupied) << "the floor";
  EXPECT_EQ(at(*tree, 0.0, 1.9, 1.0), Known::occupied) << "the wall";
  EXPECT_EQ(at(*tree, 1.0, 1.0, -0.5), Known::no) << "below the floor";
  EXPECT_EQ(at(*tree, 1.0, 1.0, 5.0), Known::no);
  EXPECT_EQ(at(*tree, 3.0, 1.0, 0.5), Known::no) << "outside";
}

TEST(Octree, keeps_what_is_occupied_where_free_space_is_marked) {
  const OccupancyMap plain = occupancy_of(hall(), {});
  const OccupancyMap marked = with_free_space(plain, hall());
  const auto cubes = [](const OccupancyMap& map) {
    std::vector<std::array<int, 4>> found;
    map.for_each_cube([&](const OccupiedCube& cube) {
      found.push_back({cube.x, cube.y, cube.z, cube.side});
    });
    return found;
  };
  EXPECT_GT(marked.stream().size(), plain.stream().size());
  EXPECT_EQ(plain.nodes(), octree_of(plain)->size());
  EXPECT_EQ(marked.nodes(), octree_of(marked)->size());
  EXPECT_EQ(OccupancyMap(0.05, {}).nodes(), 0U);
  EXPECT_EQ(cubes(marked), cubes(plain));
}

}  // namespace
}  // namespace navvi_sim::occupancy
