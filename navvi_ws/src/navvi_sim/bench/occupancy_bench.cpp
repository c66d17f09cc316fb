// The OctoMap of the built-in warehouse, beside octomap's own insertion of the same voxels.

#include <cstdio>
#include <vector>

#include "medians.hpp"
#include "navvi_sim/occupancy.hpp"
#include "navvi_sim/warehouse.hpp"

namespace {

using navvi_sim::occupancy_of;

const navvi_sim::WorldDescription& world() {
  static const navvi_sim::WorldDescription world = navvi_sim::warehouse(1, {});
  return world;
}

void from_shapes(benchmark::State& state, double resolution) {
  for (auto _ : state) benchmark::DoNotOptimize(occupancy_of(world(), {resolution}).size());
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
  for (auto _ : state) {
    octomap::OcTree tree(resolution);
    for (const octomap::OcTreeKey& voxel : voxels) tree.updateNode(voxel, true, lazy);
    if (lazy) {
      tree.updateInnerOccupancy();
      tree.prune();
    }
    if (tree.size() != model.size()) state.SkipWithError("the two trees differ");
  }
  state.counters["voxels"] = static_cast<double>(voxels.size());
}

}  // namespace

int main(int argc, char** argv) {
  for (const double resolution : {0.10, 0.05}) {
    const std::string at = resolution < 0.07 ? " 0.05 m" : " 0.10 m";
    benchmark::RegisterBenchmark(("occupancy_of" + at).c_str(), from_shapes, resolution)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("updateNode lazy" + at).c_str(), voxel_by_voxel, resolution, true)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("updateNode" + at).c_str(), voxel_by_voxel, resolution, false)
        ->Unit(benchmark::kMillisecond);
  }
  const navvi_sim::Medians medians(argc, argv);
  std::puts("\nours / octomap, voxel by voxel");
  for (const std::string at : {" 0.10 m", " 0.05 m"}) {
    medians.ratio("occupancy_of" + at, "updateNode lazy" + at);
    medians.ratio("occupancy_of" + at, "updateNode" + at);
  }
  return 0;
}
