// The OctoMap of a warehouse of 100 x 100 m, beside octomap's own insertion of the same voxels;
// both up to the bytes of the message, both on one thread and on a heap as a process finds it. Ours
// begins with the shapes, octomap's with the voxels: which ones are occupied it is told for
// nothing.

#include <malloc.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "medians.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/read/world_source.hpp"

namespace {

using navvi_sim::occupancy::occupancy_of;

/// Two by three warehouses side by side, 100 x 90 m, on a floor of 100 x 100 m.
navvi_sim::WorldDescription hall() {
  navvi_sim::WorldDescription hall;
  hall.name = "hall";
  for (int column = 0; column < 2; ++column)
    for (int row = 0; row < 3; ++row)
      for (navvi_sim::Thing thing :
           navvi_sim::read::load_world(
               {"warehouse", "", static_cast<std::uint64_t>(2 * row + column + 1)})
               .world.things) {
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

void from_shapes(benchmark::State& state, double resolution) {
  std::size_t bytes = 0;
  for (auto _ : state) {
    const navvi_sim::occupancy::OccupancyMap map = occupancy_of(world(), {resolution});
    bytes = map.stream().size();
    state.PauseTiming();
    malloc_trim(0);
    state.ResumeTiming();
  }
  state.counters["message_MB"] = static_cast<double>(bytes) / 1e6;
}

/// Every occupied voxel at its finest depth.
std::vector<octomap::OcTreeKey> voxels_of(const navvi_sim::occupancy::OccupancyMap& map) {
  std::vector<octomap::OcTreeKey> voxels;
  const auto key = [](int voxel) {
    return static_cast<octomap::key_type>(voxel + navvi_sim::occupancy::OccupancyMap::kCenter);
  };
  map.for_each_cube([&](const navvi_sim::occupancy::OccupiedCube& cube) {
    for (int x = cube.x; x < cube.x + cube.side; ++x)
      for (int y = cube.y; y < cube.y + cube.side; ++y)
        for (int z = cube.z; z < cube.z + cube.side; ++z)
          voxels.emplace_back(key(x), key(y), key(z));
  });
  return voxels;
}

/// \param lazy  as octomap advises for many voxels: inner nodes and pruning once, at the end
void voxel_by_voxel(benchmark::State& state, double resolution, bool lazy) {
  const navvi_sim::occupancy::OccupancyMap ours = occupancy_of(world(), {resolution});
  const std::vector<octomap::OcTreeKey> voxels = voxels_of(ours);
  std::size_t nodes = 0;
  std::size_t memory = 0;
  double writing = 0.0;
  double all = 0.0;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    octomap::OcTree tree(resolution);
    const float occupied = tree.getClampingThresMaxLog();
    for (const octomap::OcTreeKey& voxel : voxels) tree.setNodeValue(voxel, occupied, lazy);
    if (lazy) {
      tree.updateInnerOccupancy();
      tree.prune();
    }
    const auto inserted = std::chrono::steady_clock::now();
    std::ostringstream stream;
    tree.writeBinaryNode(stream, tree.getRoot());  // writeBinaryData, but for a line on stderr
    const std::string bytes = stream.str();
    state.PauseTiming();
    const auto end = std::chrono::steady_clock::now();
    writing += std::chrono::duration<double>(end - inserted).count();
    all += std::chrono::duration<double>(end - begin).count();
    if (!std::equal(bytes.begin(), bytes.end(), ours.stream().begin(), ours.stream().end()))
      state.SkipWithError("the bytes differ");
    nodes = tree.size();
    memory = tree.memoryUsage();
    tree.clear();
    malloc_trim(0);
    state.ResumeTiming();
  }
  state.counters["voxels"] = static_cast<double>(voxels.size());
  state.counters["writing_%"] = 100.0 * writing / all;
  state.counters["nodes"] = static_cast<double>(nodes);
  state.counters["memory_MB"] = static_cast<double>(memory) / 1e6;
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
  using navvi_bench::Medians;
  const Medians medians(argc, argv, Medians::Print::medians);
  std::puts("\nours / octomap, voxel by voxel");
  for (const std::string at : {" 0.10 m", " 0.05 m"}) {
    const double ours = medians.get("occupancy_of" + at, "ms");
    for (const std::string plain : {"setNodeValue lazy", "setNodeValue"})
      if (const double theirs = medians.get(plain + at, "ms"); ours > 0.0 && theirs > 0.0)
        std::printf("%7.3f x  %s\n", ours / theirs, (plain + at).c_str());
  }
  return 0;
}
