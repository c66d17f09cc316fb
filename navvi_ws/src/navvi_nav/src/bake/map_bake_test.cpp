#include "bake/map_bake.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <sstream>

#include "door.hpp"
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

double area_of(const BakedMap& map) {
  double sum = 0.0;
  for (const auto& [tile, polygons] : map.tiles) {
    for (const mesh::GridPolygon& polygon : polygons) {
      const auto corners = outline_of(polygon, map.floor->cell_size());
      for (std::size_t k = 2; k < corners.size(); ++k)
        sum += cross(corners[k - 1] - corners[0], corners[k] - corners[0]) / 2;
    }
  }
  return sum;
}

TEST(MapBake, covers_as_much_floor_by_layers_as_by_the_watershed_in_as_few_polygons) {
  std::size_t by_layers = 0, by_watershed = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    RandomWorld world(seed);
    MapBakeConfig config;
    const BakedMap layers = bake_map(survey_of(world.map), config);
    config.watershed = true;
    const BakedMap watershed = bake_map(survey_of(world.map), config);
    EXPECT_NE(layers.tiles, watershed.tiles) << seed;
    // A wall is smoothed within a region, so the borders between them count a little.
    EXPECT_NEAR(area_of(layers) / area_of(watershed), 1.0, 0.005) << seed;
    for (const auto& [tile, polygons] : layers.tiles) by_layers += polygons.size();
    for (const auto& [tile, polygons] : watershed.tiles) by_watershed += polygons.size();
  }
  EXPECT_LE(static_cast<double>(by_layers), 1.1 * static_cast<double>(by_watershed));
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
                        [at](const auto& outline) { return nearest_in_convex(at, outline) == at; });
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
    eighths.ground = {eighths.columns, eighths.rows};
    for (int y = 0; y < eighths.rows; ++y)
      for (int x = 0; x < eighths.columns; ++x)
        eighths.ground.own_row(y)[x] = survey.ground.at(x / kParts, y / kParts);
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

/// A hall in which things come, go and grow: boxes, steps, ramps, ceilings, decks, pits, blocks of
/// the octree, free space, and floor beyond the walls.
class ChangingHall {
 public:
  /// \param length, width  voxels; things come and go at one end, within 420 x 300
  ChangingHall(unsigned seed, double resolution, int length = 420, int width = 300)
      : length_(std::min(length, 420)),
        width_(std::min(width, 300)),
        random_(seed),
        tree_(resolution) {
    fill(0, 0, -1, length, width, 0);
    fill(0, 0, -1, length_, width_, 0);
    fill(0, 0, 0, length_, 2, 10);
    fill(0, 0, 0, 2, width_, 10);
    for (int i = 0; i < 12; ++i) change();
  }
  void change() {
    const int x = pick(-10, length_), y = pick(-10, width_), side = pick(1, 30), high = pick(1, 12);
    const double level = 2.0 * kPi * pick(0, 15) / 16.0;  // of a ramp's heading
    switch (pick(0, 12)) {
      case 0:  // a step
        return fill(x, y, 0, x + side, y + pick(1, 90), pick(1, 2));
      case 1:  // a ramp to a deck
        for (int i = 0; i < 60; ++i)
          for (int k = 0; k < 40; ++k) {
            const double along = (i - 30) * std::cos(level) + (k - 20) * std::sin(level);
            fill(x + i, y + k, 0, x + i + 1, y + k + 1,
                 static_cast<int>(std::clamp(along * high / 20.0, 0.0, 8.0)));
          }
        return;
      case 2:  // a ceiling
        return fill(x, y, high, x + 2 * side, y + 2 * side, high + 1);
      case 3:  // a pit, or a map that ends here
        return fill(x, y, -1, x + side, y + side, 0, -2.0F);
      case 4:  // all that stood here is gone
        return fill(x, y, 0, x + 3 * side, y + 3 * side, 14, -2.0F);
      case 5:  // free space where nothing was known, which the map tells, too
        return fill(x, y, 20, x + side, y + side, 20 + high, -2.0F);
      case 6:  // leaves as large as blocks
        return fill(x & ~63, y & ~63, 0, (x & ~63) + 64, (y & ~63) + 64, pick(0, 1) * 64);
      case 7:  // floor beyond
        return fill(pick(0, 1) * (length_ - 1), y, -1, length_ + pick(0, 20), y + side, 0);
      case 8:  // a floor above the floor, as large
        return fill(x, y, 40, pick(0, 9) == 0 ? length_ : x + side, width_, 41);
      default:  // a box
        return fill(x, y, 0, x + side, y + side, high);
    }
  }
  std::vector<std::int8_t> bytes(bool binary) {
    tree_.updateInnerOccupancy();
    octomap::OcTree pruned(tree_);
    pruned.prune();
    std::ostringstream out;
    if (binary)
      pruned.writeBinaryData(out);
    else
      pruned.writeData(out);
    const std::string text = out.str();
    return {text.begin(), text.end()};
  }
  int pick(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
  }

 private:
  void fill(int x0, int y0, int z0, int x1, int y1, int z1, float value = 2.0F) {
    const auto key = [](int at) { return static_cast<octomap::key_type>(map::kMapCenter + at); };
    for (int x = x0; x < x1; ++x)
      for (int y = y0; y < y1; ++y)
        for (int z = z0; z < z1; ++z)
          tree_.setNodeValue(octomap::OcTreeKey(key(x), key(y), key(z)), value, true);
  }

  const int length_, width_;
  std::mt19937 random_;
  octomap::OcTree tree_;
};

TEST(MapBake, surveys_a_large_map_that_changes_over_and_over_as_at_once) {
  int in_part = 0;
  for (unsigned seed = 0; seed < 3; ++seed) {
    ChangingHall hall(seed, seed == 2 ? 0.1 : 0.05, 1000, 800);
    map::SurveyConfig how;
    how.climb = seed == 1 ? 0.1 : 0.04;
    map::MapSurvey last;
    map::Floor floor;
    for (int round = 0; round < 15; ++round) {
      hall.change();
      const std::vector<std::int8_t> data = hall.bytes(true);
      const map::MapBytes bytes{data.data(), data.size(), true, "OcTree", seed == 2 ? 0.1 : 0.05};
      map::MapSurvey survey = map::survey_map(bytes, how, last.record.get(), &floor);
      const map::MapSurvey anew = map::survey_map(map::read_voxels(bytes), how);
      ASSERT_EQ(survey.error, anew.error);
      ASSERT_EQ(survey.levels, anew.levels);
      ASSERT_EQ(survey.columns, anew.columns);
      ASSERT_TRUE(survey.ground == anew.ground) << seed << ' ' << round;
      in_part += survey.in_part ? 1 : 0;
      last = std::move(survey);
      floor = map::Floor({last.low, last.cell_size, 0.0, last.ground}, {0.1, 0.0});
    }
  }
  EXPECT_GT(in_part, 25);
}

TEST(MapBake, takes_back_a_long_deck_whose_ramp_a_box_closes) {
  SmallWorld world(0.1);
  world.floor(0, 0, 40, 30);
  for (int level = 1; level <= 3; ++level) world.box(10 + 0.5 * level, 10, 0, 38, 12, 0.1 * level);
  map::SurveyConfig how;
  how.climb = 0.1;
  const auto survey_of = [&](const BakedMap& last) {
    const std::vector<std::int8_t> data = world.bytes();
    const map::MapBytes bytes{data.data(), data.size(), true, "OcTree", 0.1};
    map::MapSurvey survey = map::survey_map(bytes, how, last.record.get(), last.floor.get());
    EXPECT_TRUE(survey.ground == map::survey_map(map::read_voxels(bytes), how).ground);
    return survey;
  };
  const BakedMap open = bake_map(survey_of({}), {});
  world.box(9.5, 9.5, 0, 11.8, 12.5, 0.7);
  const BakedMap closed = bake_map(survey_of(open), {}, &open);
  EXPECT_EQ(open.floor->ground(open.floor->cell_at({30, 11})), map::Ground::floor);
  EXPECT_EQ(closed.floor->ground(closed.floor->cell_at({30, 11})), map::Ground::obstacle);
}

TEST(MapBake, makes_of_a_map_that_changes_over_and_over_what_it_makes_of_it_at_once) {
  int in_part = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    ChangingHall hall(seed, seed % 2 == 0 ? 0.1 : 0.05);
    map::SurveyConfig how;
    how.climb = std::array{0.04, 0.0, 0.1}[seed % 3];
    how.robot_height = seed % 4 == 3 ? 0.3 : 0.8;
    how.cell_size = seed % 5 == 4 ? 0.15 : 0.0;
    MapBakeConfig config;
    config.tile_size = 4.0;
    BakedMap last;
    for (int round = 0; round < 14; ++round) {
      const int changes = hall.pick(0, 2);
      for (int i = 0; i < changes; ++i) hall.change();
      const std::vector<std::int8_t> data = hall.bytes(seed % 6 != 5);
      const map::MapBytes bytes{data.data(), data.size(), seed % 6 != 5, "OcTree",
                                seed % 2 == 0 ? 0.1 : 0.05};
      map::MapSurvey survey = map::survey_map(bytes, how, last.record.get(), last.floor.get());
      const map::MapSurvey anew = map::survey_map(map::read_voxels(bytes), how);
      ASSERT_EQ(survey.error, anew.error);
      ASSERT_EQ(survey.columns, anew.columns);
      ASSERT_EQ(survey.rows, anew.rows);
      ASSERT_EQ(survey.low.x, anew.low.x);
      ASSERT_EQ(survey.low.y, anew.low.y);
      ASSERT_EQ(survey.cell_size, anew.cell_size);
      ASSERT_EQ(survey.floor_height, anew.floor_height);
      ASSERT_EQ(survey.levels, anew.levels);
      ASSERT_TRUE(survey.ground == anew.ground) << seed << ' ' << round;
      BakedMap map = bake_map(std::move(survey), config, &last);
      const BakedMap fresh = bake_map(anew, config);
      ASSERT_EQ(map.error, fresh.error);
      if (!map.error.empty()) continue;
      for (int y = 0; y < fresh.floor->rows(); ++y) {
        const int row = fresh.floor->origin().y + y;
        const auto count = static_cast<std::size_t>(fresh.floor->columns());
        ASSERT_EQ(std::memcmp(map.floor->gap2_row(row), fresh.floor->gap2_row(row), 2 * count), 0);
        ASSERT_EQ(std::memcmp(map.floor->open_row(row), fresh.floor->open_row(row), count), 0);
      }
      ASSERT_TRUE(map.tiles == fresh.tiles) << seed << ' ' << round;
      in_part += map.rebuilt.size() < map.tiles.size();
      last = std::move(map);
    }
  }
  EXPECT_GT(in_part, 30);
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
