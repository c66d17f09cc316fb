#include "bake/map_bake.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace navvi_nav::bake {
namespace {

map::MapSurvey survey_of(SmallWorld& world) { return map::survey_map(world.voxels(), {}); }

std::vector<Point> outline_of(const mesh::GridPolygon& polygon, double cell) {
  std::vector<Point> out;
  for (const auto& corner : polygon.corners)
    out.push_back(
        {corner[0] * cell / map::kStepsPerCellSide, corner[1] * cell / map::kStepsPerCellSide});
  return out;
}

TEST(MapBake, bakes_the_same_on_any_number_of_threads) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    RandomWorld world(seed);
    MapBakeConfig config;
    config.tile_size = 4.0;
    config.threads = 1;
    const BakedMap alone = bake_map(survey_of(world.map), config);
    for (const int threads : {2, 5}) {
      config.threads = threads;
      const BakedMap shared = bake_map(survey_of(world.map), config);
      EXPECT_EQ(shared.tiles, alone.tiles) << seed;
      EXPECT_EQ(shared.rebuilt, alone.rebuilt);
    }
  }
}

/// Voxels of 0.1 m are halved: 0.35 m are no whole number of them.
TEST(MapBake, keeps_the_margin_from_every_voxel_and_loses_less_than_a_cell) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const double resolution = seed % 2 == 0 ? 0.1 : 0.05;
    std::mt19937 random(seed);
    SmallWorld world(resolution);
    world.room(12, 9);
    for (int i = 0; i < 25; ++i) {
      const double x = 0.1 * static_cast<double>(5 + random() % 100),
                   y = 0.1 * static_cast<double>(5 + random() % 70);
      world.box(x, y, 0, x + 0.1 * static_cast<double>(1 + random() % 8),
                y + 0.1 * static_cast<double>(1 + random() % 8),
                0.1 * static_cast<double>(1 + random() % 9));
    }
    MapBakeConfig config;
    config.tile_size = 5.0;
    const BakedMap map = bake_map(survey_of(world), config);
    ASSERT_EQ(map.error, "");
    std::vector<std::vector<Point>> outlines;
    for (const auto& [tile, polygons] : map.tiles) {
      for (const mesh::GridPolygon& polygon : polygons)
        outlines.push_back(outline_of(polygon, map.floor->cell_size()));
    }
    int inside = 0, roomy = 0;
    for (int probe = 0; probe < 6000; ++probe) {
      const Point at{12.0 * static_cast<double>(random()) / 4294967296.0,
                     9.0 * static_cast<double>(random()) / 4294967296.0};
      const auto covers =
          std::count_if(outlines.begin(), outlines.end(),
                        [at](const auto& outline) { return convex_contains(outline, at); });
      ASSERT_LE(covers, 1) << seed;
      const double clearance = map.floor->clearance(at);
      if (covers == 1) {
        ASSERT_GE(clearance, config.margin - 1e-9) << seed;
        ++inside;
      }
      // Round corners cost a little more than the cell that a filled notch may.
      if (clearance > config.margin + 1.5 * map.floor->cell_size()) {
        EXPECT_EQ(covers, 1) << seed << ": " << at.x << ' ' << at.y;
        ++roomy;
      }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(roomy, 500);
    EXPECT_GE(inside, roomy);
  }
}

mesh::Mesh mesh_of(const BakedMap& map) {
  std::vector<mesh::GridPolygon> all;
  for (const auto& [tile, polygons] : map.tiles)
    all.insert(all.end(), polygons.begin(), polygons.end());
  return mesh::join(all, map.floor->cell_size() / map::kStepsPerCellSide);
}

/// By the same floor in cells of an eighth, eroded by 1.5 cm more.
TEST(MapBake, loses_no_way_that_is_3_cm_wider_than_the_robot) {
  constexpr int kParts = 8;
  int opened = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    SmallWorld world(0.05);
    world.room(9, 7);
    for (int i = 0; i < 22; ++i) {
      const double x = 0.05 * static_cast<double>(10 + random() % 150),
                   y = 0.05 * static_cast<double>(10 + random() % 120);
      world.box(x, y, 0, x + 0.05 * static_cast<double>(1 + random() % 12),
                y + 0.05 * static_cast<double>(1 + random() % 12), 1.0);
    }
    const map::MapSurvey survey = survey_of(world);
    map::MapSurvey eighths{"",
                           survey.cell_size / kParts,
                           0.0,
                           {survey.low.x * kParts, survey.low.y * kParts},
                           survey.columns * kParts,
                           survey.rows * kParts,
                           {},
                           "",
                           ""};
    for (int y = 0; y < eighths.rows; ++y)
      for (int x = 0; x < eighths.columns; ++x)
        eighths.ground.push_back(
            survey.ground[static_cast<std::size_t>(y / kParts * survey.columns + x / kParts)]);
    MapBakeConfig config;
    config.tile_size = 4.0;
    const BakedMap map = bake_map(survey, config);
    config.fine_parts = false;
    const mesh::Mesh whole = mesh_of(bake_map(survey, config)), mesh = mesh_of(map);
    config.margin += 0.015;
    config.contour_error = 0.0;
    const mesh::Mesh exact = mesh_of(bake_map(eighths, config));
    for (const mesh::Vertex& vertex : mesh.vertices)
      ASSERT_GE(map.floor->clearance(vertex.at), 0.35 - 1e-9) << seed;
    const auto component = [](const mesh::Mesh& of, Point at) {
      const auto place = of.locate(at, 0.03);
      return place ? of.polygon(place->polygon).component : -1;
    };
    std::map<int, int> of_exact, of_whole;  // component of the exact mesh -> of the others
    for (int probe = 0; probe < 3000; ++probe) {
      const Point at{9.0 * static_cast<double>(random()) / 4294967296.0,
                     7.0 * static_cast<double>(random()) / 4294967296.0};
      if (!exact.locate(at, 0.0)) continue;
      const int ours = component(mesh, at), coarse = component(whole, at);
      const int judge = component(exact, at);
      if (ours >= 0) {
        ASSERT_EQ(of_exact.emplace(judge, ours).first->second, ours) << seed;
      }
      if (coarse >= 0) opened += of_whole.emplace(judge, coarse).first->second != coarse;
    }
  }
  EXPECT_GT(opened, 0);
}

TEST(MapBake, keeps_exactly_the_margin_from_straight_walls) {
  SmallWorld world(0.1);
  world.room(8, 8);
  const BakedMap map = bake_map(survey_of(world), {});
  double low = 8.0, high = 0.0;
  for (const auto& [tile, polygons] : map.tiles) {
    for (const mesh::GridPolygon& polygon : polygons) {
      for (const Point corner : outline_of(polygon, map.floor->cell_size())) {
        low = std::min(low, corner.x);
        high = std::max(high, corner.x);
      }
    }
  }
  EXPECT_NEAR(low, 0.1 + 0.35, 1e-9);
  EXPECT_NEAR(high, 7.9 - 0.35, 1e-9);
}

TEST(MapBake, takes_over_tiles_in_which_nothing_changed) {
  SmallWorld world;
  world.room(32, 24);
  MapBakeConfig config;
  config.tile_size = 8.0;
  const BakedMap first = bake_map(survey_of(world), config);
  const BakedMap same = bake_map(survey_of(world), config, &first);
  EXPECT_TRUE(same.rebuilt.empty());
  EXPECT_EQ(same.tiles, first.tiles);
  world.box(4, 4, 0, 4.5, 4.5, 0.5);
  const BakedMap changed = bake_map(survey_of(world), config, &same);
  EXPECT_EQ(changed.rebuilt, (std::vector<TileIndex>{{0, 0}}));
  EXPECT_EQ(changed.tiles, bake_map(survey_of(world), config).tiles);
  world.floor(-20, 0, 0.2, 4);
  const BakedMap wider = bake_map(survey_of(world), config, &changed);
  EXPECT_EQ(wider.tiles, bake_map(survey_of(world), config).tiles);
  EXPECT_LT(wider.rebuilt.size(), wider.tiles.size());
}

TEST(MapBake, refuses_a_map_without_room_and_a_robot_too_wide_for_the_cells) {
  SmallWorld world;
  world.floor(0, 0, 0.6, 0.6);
  EXPECT_EQ(bake_map(survey_of(world), {}).error,
            "the map shows no walkable floor; what there is of floor lies at z = 0.00 m (0.4 m^2)");
  SmallWorld fine(0.01);
  fine.floor(0, 0, 1, 1);
  MapBakeConfig wide;
  wide.margin = 1.9;
  EXPECT_EQ(bake_map(survey_of(fine), wide).error,
            "the robot is too wide for a map with cells of 0.010000 m: its radius must not be more "
            "than 178 cells");
}

}  // namespace
}  // namespace navvi_nav::bake

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
