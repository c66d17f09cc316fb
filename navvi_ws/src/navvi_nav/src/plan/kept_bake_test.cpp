#include "plan/kept_bake.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "small_world.hpp"
#include "temp_folder.hpp"

namespace navvi_nav::plan {
namespace {

namespace fs = std::filesystem;

/// An OctoMap as it is sent.
struct Sent {
  explicit Sent(SmallWorld& world) : data(world.bytes()) {}
  [[nodiscard]] map::MapBytes bytes() const {
    return {data.data(), data.size(), true, "OcTree", 0.05};
  }
  std::vector<std::int8_t> data;
};

void expect_same(const map::Floor& a, const map::Floor& b) {
  ASSERT_EQ(a.area(), b.area());
  EXPECT_EQ(a.all_ground(), b.all_ground());
  EXPECT_EQ(a.cell_size(), b.cell_size());
  EXPECT_EQ(a.height(), b.height());
  EXPECT_EQ(a.reach(), b.reach());
  EXPECT_EQ(a.grow(), b.grow());
  for (int y = a.area().low.y; y < a.area().high.y; ++y) {
    EXPECT_TRUE(std::equal(a.open_row(y), a.open_row(y) + a.columns(), b.open_row(y)));
    EXPECT_TRUE(std::equal(a.gap2_row(y), a.gap2_row(y) + a.columns(), b.gap2_row(y)));
  }
}

class KeptBake : public testing::Test {
 protected:
  [[nodiscard]] std::vector<fs::path> files() const { return folder_.files(); }

  navvi_test::TempFolder folder_;
  NavMeshConfig config_;
};

TEST_F(KeptBake, gives_the_same_mesh_and_floor_and_the_same_after_the_next_map) {
  const navvi_files::Cache cache({folder_, 16, "build"});
  for (unsigned seed = 0; seed < 6; ++seed) {
    RandomWorld world(seed);
    const Sent sent(world.map);
    NavMesh fresh(config_);
    ASSERT_EQ(fresh.set_map(sent.bytes()).error, "");
    for (const bool kept : {false, true}) {
      NavMesh mesh(config_);
      EXPECT_EQ(files().size(), seed + (kept ? 1U : 0U));
      const MeshUpdate update =
          mesh.take(kept_bake(mesh, map::read_voxels(sent.bytes()), std::nullopt, cache));
      EXPECT_EQ(update.tiles_rebuilt, update.tiles);
      EXPECT_TRUE(same(mesh.mesh(), fresh.mesh()));
      expect_same(*mesh.shared_floor(), *fresh.shared_floor());
      RandomWorld next(seed);
      next.map.box(2, 2, 0, 2.4, 2.4, 0.5);
      const Sent changed(next.map);
      ASSERT_EQ(mesh.set_map(changed.bytes()).error, "");
      NavMesh second(config_);
      ASSERT_EQ(second.set_map(changed.bytes()).error, "");
      expect_same(*mesh.shared_floor(), *second.shared_floor());
      EXPECT_EQ(mesh.mesh().polygons.size(), second.mesh().polygons.size());
    }
  }
}

TEST_F(KeptBake, is_another_one_for_another_map_config_clearance_or_height) {
  const navvi_files::Cache cache({folder_, 16, "build"});
  SmallWorld world, other;
  world.room(6, 4);
  other.room(6, 4.05);
  const Sent sent(world), other_sent(other);
  std::size_t count = 0;
  const auto expect_new = [&](const NavMesh& mesh, const Sent& map, std::optional<double> height) {
    for (int i = 0; i < 2; ++i) (void)kept_bake(mesh, map::read_voxels(map.bytes()), height, cache);
    EXPECT_EQ(files().size(), ++count);
  };
  expect_new(NavMesh(config_), sent, std::nullopt);
  expect_new(NavMesh(config_), other_sent, std::nullopt);
  expect_new(NavMesh(config_), sent, 0.0);
  expect_new(NavMesh(config_, 0.7), sent, std::nullopt);
  config_.robot_radius = 0.4;
  expect_new(NavMesh(config_), sent, std::nullopt);
}

TEST_F(KeptBake, keeps_no_map_that_is_rejected) {
  const navvi_files::Cache cache({folder_, 16, "build"});
  SmallWorld world;
  world.box(0, 0, 0, 0.2, 0.2, 0.2);
  const Sent sent(world);
  const map::Voxels voxels = map::read_voxels(sent.bytes());
  EXPECT_NE(kept_bake(NavMesh(config_), voxels, std::nullopt, cache).error, "");
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace navvi_nav::plan
