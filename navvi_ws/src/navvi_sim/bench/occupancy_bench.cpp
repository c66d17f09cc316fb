// The OctoMap of a warehouse of 100 x 100 m, beside octomap's own insertion of the same voxels.
// What is measured is the making of a tree on a heap as a process finds it, not its end.

#include <malloc.h>

#include <cstdio>
#include <sstream>
#include <vector>

#include "medians.hpp"
#include "navvi_sim/occupancy.hpp"
#include "navvi_sim/warehouse.hpp"

namespace {

using navvi_sim::occupancy_of;

/// Two by three built-in warehouses side by side, 100 x 90 m, on a floor of 100 x 100 m.
navvi_sim::WorldDescription hall() {
  navvi_sim::WorldDescription hall;
  hall.name = "hall";
  for (int column = 0; column < 2; ++column)
    for (int row = 0; row < 3; ++row)
      for (navvi_sim::Thing thing :
           navvi_sim::warehouse(static_cast<std::uint64_t>(2 * row + column + 1), {}).things) {
        if (thing.thing_class == navvi_sim::ThingClass::floor) continue;
        thing.name += "_" + std::to_string(column) + std::to_string(row);
        thing.pose =
            Eigen::Translation3d(50.0 * column - 25.0, 30.0 * row - 30.0, 0.0) * thing.pose;
        hall.things.push_back(std::move(thing));
      }
  navvi_sim::Thing floor;
  floor.name = "floor";
  floor.thing_class = navvi_sim::ThingClass::floor;
  floor.pose = Eigen::Translation3d(0.0, 0.0, -0.05) * Eigen::Isometry3d::Identity();
  floor.shapes.push_back({navvi_sim::Box{{100.0, 100.0, 0.1}}, Eigen::Isometry3d::Identity()});
  hall.things.push_back(std::move(floor));
  return hall;
}

const navvi_sim::WorldDescription& world() {
  static const navvi_sim::WorldDescription world = hall();
  return world;
}

void count(benchmark::State& state, const octomap::OcTree& tree) {
  std::ostringstream message;
  tree.writeBinaryData(message);
  state.counters["nodes"] = static_cast<double>(tree.size());
  state.counters["memory_MB"] = static_cast<double>(tree.memoryUsage()) / 1e6;
  state.counters["message_MB"] = static_cast<double>(message.str().size()) / 1e6;
}

void end(octomap::OcTree& tree) {
  tree.clear();
  malloc_trim(0);
}

void from_shapes(benchmark::State& state, double resolution) {
  for (auto _ : state) {
    octomap::OcTree tree = occupancy_of(world(), {resolution});
    benchmark::DoNotOptimize(tree.size());
    state.PauseTiming();
    end(tree);
    state.ResumeTiming();
  }
  count(state, occupancy_of(world(), {resolution}));
}

/// Every occupied voxel of the tree at its finest depth.
std::vector<octomap::OcTreeKey> voxels_of(const octomap::OcTree& tree) {
  std::vector<octomap::OcTreeKey> voxels;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey low = leaf.getIndexKey();
    const int side = 1 << (tree.getTreeDepth() - leaf.getDepth());
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z)
          voxels.emplace_back(static_cast<octomap::key_type>(low[0] + x),
                              static_cast<octomap::key_type>(low[1] + y),
                              static_cast<octomap::key_type>(low[2] + z));
  }
  return voxels;
}

/// \param lazy  as octomap advises for many voxels: inner nodes and pruning once, at the end
void voxel_by_voxel(benchmark::State& state, double resolution, bool lazy) {
  const octomap::OcTree model = occupancy_of(world(), {resolution});
  const std::vector<octomap::OcTreeKey> voxels = voxels_of(model);
  const float occupied = model.getClampingThresMaxLog();
  for (auto _ : state) {
    octomap::OcTree tree(resolution);
    for (const octomap::OcTreeKey& voxel : voxels) tree.setNodeValue(voxel, occupied, lazy);
    if (lazy) {
      tree.updateInnerOccupancy();
      tree.prune();
    }
    state.PauseTiming();
    if (!(tree == model)) state.SkipWithError("the two trees differ");
    end(tree);
    state.ResumeTiming();
  }
  state.counters["voxels"] = static_cast<double>(voxels.size());
}

}  // namespace

int main(int argc, char** argv) {
  for (const double resolution : {0.10, 0.05}) {
    const std::string at = resolution < 0.07 ? " 0.05 m" : " 0.10 m";
    benchmark::RegisterBenchmark(("occupancy_of" + at).c_str(), from_shapes, resolution)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("setNodeValue lazy" + at).c_str(), voxel_by_voxel, resolution,
                                 true)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("setNodeValue" + at).c_str(), voxel_by_voxel, resolution, false)
        ->Unit(benchmark::kMillisecond);
  }
  const navvi_sim::Medians medians(argc, argv);
  std::puts("\nours / octomap, voxel by voxel");
  for (const std::string at : {" 0.10 m", " 0.05 m"}) {
    medians.ratio("occupancy_of" + at, "setNodeValue lazy" + at);
    medians.ratio("occupancy_of" + at, "setNodeValue" + at);
  }
  return 0;
}
