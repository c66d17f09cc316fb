// The layout "warehouse": what is asked of it beyond what layout_test asks of every preset.

#include "warehouse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "description/validate.hpp"
#include "navvi_sim/description/world_hash.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"
#include "octomap_tree.hpp"

namespace navvi_sim::generate {
namespace {

std::map<ThingClass, int> counts(const WorldDescription& world) {
  std::map<ThingClass, int> result;
  for (const Thing& thing : world.things) ++result[thing.thing_class];
  return result;
}

/// The bounds in map of one shape. All shapes of the warehouse are upright, so this is exact
/// wherever headings are multiples of a right angle.
Eigen::AlignedBox3d bounds(const Thing& thing, const Shape& shape) {
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  if (const Box* box = std::get_if<Box>(&shape.geometry)) half = box->size / 2.0;
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape.geometry))
    half = Eigen::Vector3d(cylinder->radius, cylinder->radius, cylinder->length / 2.0);
  if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry))
    half = Eigen::Vector3d::Constant(sphere->radius);
  const Eigen::Isometry3d pose = thing.pose * shape.pose;
  const Eigen::Vector3d reach = pose.linear().cwiseAbs() * half;
  return {pose.translation() - reach, pose.translation() + reach};
}

bool overlap(const Thing& a, const Thing& b) {
  for (const Shape& shape_a : a.shapes)
    for (const Shape& shape_b : b.shapes) {
      const auto common = bounds(a, shape_a).intersection(bounds(b, shape_b));
      if (!common.isEmpty() && common.sizes().minCoeff() > 1e-6) return true;
    }
  return false;
}

/// m, how near a mover's frame comes to the shape's footprint on its route.
double distance_to_route(const Route& route, const Eigen::AlignedBox3d& box) {
  double least = 1e9;
  for (std::size_t i = 0; i < route.waypoints.size(); ++i) {
    const Eigen::Vector2d a = route.waypoints[i].at;
    const Eigen::Vector2d b = route.waypoints[(i + 1) % route.waypoints.size()].at;
    for (double t = 0.0; t <= 1.0; t += 0.005) {
      const Eigen::Vector2d p = a + t * (b - a);
      least =
          std::min(least, box.exteriorDistance(Eigen::Vector3d(p.x(), p.y(), box.center().z())));
    }
  }
  return least;
}

TEST(Warehouse, has_what_a_warehouse_has) {
  const WorldDescription world = warehouse(1);
  auto count = counts(world);
  EXPECT_GE(count[ThingClass::shelf], 22);
  EXPECT_GE(count[ThingClass::wall], 4);
  EXPECT_EQ(count[ThingClass::floor], 1);
  EXPECT_EQ(count[ThingClass::forklift], 2);
  EXPECT_EQ(count[ThingClass::pallet_robot], 2);
  EXPECT_EQ(count[ThingClass::worker], 6);
  EXPECT_GE(count[ThingClass::pedestal], 8);
  EXPECT_GE(count[ThingClass::box], 4);
  EXPECT_EQ(world.floor_height, 0.0);
}

TEST(Warehouse, shows_the_boxes_on_a_shelf_as_boxes_that_belong_to_the_shelf) {
  std::size_t boxes = 0;
  for (const Thing& thing : warehouse(1).things)
    for (const Shape& shape : thing.shapes)
      if (thing.thing_class == ThingClass::shelf && look_of(thing, shape) == ThingClass::box)
        ++boxes;
  EXPECT_GE(boxes, 100u);
}

TEST(Warehouse, is_valid_and_without_overlaps_for_every_seed) {
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const WorldDescription world = warehouse(seed);
    ASSERT_NO_THROW(validate(world)) << "seed " << seed;
    for (std::size_t i = 0; i < world.things.size(); ++i)
      for (std::size_t j = i + 1; j < world.things.size(); ++j)
        EXPECT_FALSE(overlap(world.things[i], world.things[j]))
            << world.things[i].name << " and " << world.things[j].name << ", seed " << seed;
  }
}

TEST(Warehouse, leaves_routes_free_of_what_stands_still) {
  // Half the width of each, and half the length of those that turn in place on open ground.
  const std::map<ThingClass, double> half_width{
      {ThingClass::forklift, 0.5}, {ThingClass::pallet_robot, 0.35}, {ThingClass::worker, 0.24}};
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const WorldDescription world = warehouse(seed);
    for (const Thing& mover : world.things) {
      if (!mover.route) continue;
      for (const Thing& thing : world.things) {
        if (thing.route || thing.thing_class == ThingClass::floor) continue;
        for (const Shape& shape : thing.shapes)
          EXPECT_GT(distance_to_route(*mover.route, bounds(thing, shape)),
                    half_width.at(mover.thing_class) + 0.1)
              << mover.name << " passes " << thing.name << ", seed " << seed;
      }
    }
  }
}

TEST(Warehouse, is_the_same_for_the_same_seed_and_another_for_another) {
  EXPECT_EQ(world_hash(warehouse(5)), world_hash(warehouse(5)));
  EXPECT_NE(world_hash(warehouse(5)), world_hash(warehouse(6)));
}

TEST(Warehouse, is_the_one_that_earlier_trials_were_recorded_in) {
  EXPECT_EQ(world_hash(warehouse(1)), "c73c0ac67551ea8b");
  EXPECT_EQ(world_hash(warehouse(123456789)), "b2df3713e63de7f5");
}

TEST(Warehouse, lets_workers_stand_or_walk_as_asked) {
  for (const auto& [word, walking] :
       std::map<std::string, int>{{"standing", 0}, {"walking", 6}, {"both", 3}}) {
    setup::SimNodeConfig config;
    config.workers = word;
    int workers = 0, routes = 0;
    for (const Thing& thing : setup::load_world(config).world.things) {
      if (thing.thing_class != ThingClass::worker) continue;
      ++workers;
      routes += thing.route ? 1 : 0;
    }
    EXPECT_EQ(workers, 6) << word;
    EXPECT_EQ(routes, walking) << word;
  }
}

TEST(Warehouse, gives_every_seed_a_free_and_connected_scenario) {
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const WorldDescription world = warehouse(seed);
    const octomap::OcTree tree = tree_of(occupancy::occupancy_of(world, {}));
    const scenario::StartAndGoal scenario =
        scenario::draw_scenario(world, occupancy::voxels_of(world, {}), {}, seed);
    EXPECT_GE(scenario.route_length, 10.0) << "seed " << seed;
    for (const Eigen::Vector2d& place : {scenario.start.position, scenario.goal})
      for (double angle = 0.0; angle < 6.3; angle += 0.2)
        for (const double z : {0.02, 0.07, 0.5, 1.1})
          EXPECT_FALSE(occupied(tree, place.x() + 0.45 * std::cos(angle),
                                place.y() + 0.45 * std::sin(angle), z))
              << place.transpose() << ", seed " << seed;
  }
}

TEST(Warehouse, shows_a_pedestal_in_the_map_above_the_floor) {
  const WorldDescription world = warehouse(3);
  const octomap::OcTree tree = tree_of(occupancy::occupancy_of(world, {}));
  for (const Thing& thing : world.things) {
    if (thing.name.rfind("pedestal", 0) != 0 || thing.thing_class != ThingClass::pedestal) continue;
    const Eigen::Vector3d edge = thing.pose * Eigen::Vector3d(0.55, 0.35, 0.0);
    for (const double z : {-0.02, 0.02, 0.07})
      EXPECT_TRUE(occupied(tree, edge.x(), edge.y(), z)) << thing.name << " at " << z;
    EXPECT_FALSE(occupied(tree, edge.x(), edge.y(), 0.12)) << thing.name;
  }
}

}  // namespace
}  // namespace navvi_sim::generate
