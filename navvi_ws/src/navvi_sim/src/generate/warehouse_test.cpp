// The layout "warehouse": what is asked of it beyond what layout_test asks of every preset.

#include "warehouse.hpp"

#include <gtest/gtest.h>

#include <map>

#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"
#include "octomap_tree.hpp"

namespace navvi_sim::generate {
namespace {

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
