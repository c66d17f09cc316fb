#include "occupancy/octree.hpp"

#include <gtest/gtest.h>

#include "navvi_sim/occupancy/occupancy.hpp"

namespace navvi_sim::occupancy {
namespace {

TEST(Octree, has_the_cubes_of_the_map) {
  WorldDescription world;
  Thing box;
  box.name = "box";
  box.thing_class = ThingClass::box;
  Shape shape;
  shape.geometry = Box{{0.4, 0.4, 0.4}};
  box.shapes = {shape};
  world.things = {box};
  const OccupancyMap map = occupancy_of(world, {});
  const auto tree = octree_of(map);
  EXPECT_EQ(map.nodes(), tree->size());
  const octomap::OcTreeNode* node = tree->search(0.1, 0.1, 0.1);
  EXPECT_TRUE(node != nullptr && tree->isNodeOccupied(node));
  EXPECT_EQ(tree->search(1.0, 1.0, 0.5), nullptr);
  EXPECT_EQ(octree_of(OccupancyMap(0.05, {}))->size(), 0U);
}

}  // namespace
}  // namespace navvi_sim::occupancy
