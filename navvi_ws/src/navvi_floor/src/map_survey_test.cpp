#include "navvi_floor/map_survey.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <navvi_types/angles.hpp>
#include <random>

#include "height_field.hpp"
#include "navvi_floor/occupancy_grid.hpp"
#include "voxel_world.hpp"

namespace navvi_floor {
namespace {

Ground ground_at(const MapSurvey& survey, double x, double y) {
  const int column = static_cast<int>(std::floor(x / survey.cell_size)) - survey.low.x;
  const int row = static_cast<int>(std::floor(y / survey.cell_size)) - survey.low.y;
  if (column < 0 || row < 0 || column >= survey.columns || row >= survey.rows) return Ground::none;
  return survey.ground.at(column, row);
}

MapSurvey survey_of(SmallWorld& world, const SurveyConfig& config = {}) {
  MapSurvey survey = survey_map(world.voxels(), config);
  EXPECT_EQ(survey.error, "");
  return survey;
}

SurveyConfig climbing(double climb) {
  SurveyConfig config;
  config.climb = climb;
  return config;
}

/// A floor 12 m long with a ramp from x = 3 to x = 6 that leads to a deck on its level.
SmallWorld ramp_world(double slope, double resolution = 0.05) {
  SmallWorld world(resolution);
  world.floor(0, 0, 12, 4);
  for (double x = 3.0; x < 6.0 - 1e-6; x += resolution) {
    const double top = std::ceil((x + resolution - 3.0) * slope / resolution - 1e-6) * resolution;
    world.box(x, 0, 0, x + resolution, 4, top);
  }
  const double deck = std::ceil(3.0 * slope / resolution - 1e-6) * resolution;
  world.box(6, 0, 0, 9, 4, deck);
  return world;
}

TEST(MapSurvey, takes_all_that_rises_five_centimetres_above_the_floor_for_an_obstacle) {
  for (const double top : {0.05, 0.10, 0.60}) {
    SmallWorld world;
    world.floor(0, 0, 4, 4).box(1, 1, 0, 2, 2, top);
    EXPECT_EQ(ground_at(survey_of(world), 1.5, 1.5), Ground::obstacle) << top;
  }
  SmallWorld fine(0.02);
  fine.floor(0, 0, 2, 2).box(0.4, 0.4, 0, 0.6, 0.6, 0.04).box(1, 1, 0, 1.2, 1.2, 0.06);
  const MapSurvey survey = survey_of(fine);
  EXPECT_EQ(ground_at(survey, 0.5, 0.5), Ground::floor);
  EXPECT_EQ(ground_at(survey, 1.1, 1.1), Ground::obstacle);
}

TEST(MapSurvey, N10_finds_no_floor_where_there_is_none_and_blocks_where_voxels_float) {
  SmallWorld world;
  world.floor(0, 0, 4, 4).box(1, 1, 0.3, 1.05, 1.05, 0.35).box(2, 2, 0.8, 2.05, 2.05, 0.85);
  world.floor(5, 0, 6, 1);
  const MapSurvey survey = survey_of(world);
  EXPECT_EQ(ground_at(survey, 4.5, 0.5), Ground::none);
  EXPECT_EQ(ground_at(survey, 5.5, 0.5), Ground::floor);
  EXPECT_EQ(ground_at(survey, 1.02, 1.02), Ground::obstacle);
  EXPECT_EQ(ground_at(survey, 2.02, 2.02), Ground::floor);
}

TEST(MapSurvey, walks_a_ramp_if_climbing_is_allowed_and_it_is_not_as_steep_as_45_degrees) {
  for (const auto& [slope, walks] :
       {std::pair{0.2, true}, {0.5, true}, {0.8, true}, {1.0, false}, {1.5, false}}) {
    SmallWorld world = ramp_world(slope);
    const MapSurvey survey = survey_of(world, climbing(0.1));
    EXPECT_EQ(ground_at(survey, 4.5, 2.0) == Ground::floor, walks) << slope;
    EXPECT_EQ(ground_at(survey, 1.5, 2.0), Ground::floor) << slope;
    if (walks) {
      EXPECT_EQ(ground_at(survey, 7.5, 2.0), Ground::floor) << slope;
    }
    EXPECT_EQ(ground_at(survey_of(world, climbing(0.0)), 4.5, 2.0), Ground::obstacle) << slope;
  }
}

TEST(MapSurvey, walks_ramps_but_neither_kerbs_nor_pedestals_in_voxels_as_high_as_these) {
  SurveyConfig paper;
  paper.cell_size = 0.2;
  for (const SurveyConfig& config : {SurveyConfig{}, paper}) {
    for (const double slope : {1.0 / 24, 1.0 / 12, 0.2, 0.5, 0.8}) {
      SmallWorld world = ramp_world(slope);
      const MapSurvey survey = survey_of(world, config);
      EXPECT_EQ(ground_at(survey, 3.3, 2.0), Ground::floor) << slope;
      EXPECT_EQ(ground_at(survey, 4.5, 2.0), Ground::floor) << slope;
      EXPECT_EQ(ground_at(survey, 7.5, 2.0), Ground::floor) << slope;
    }
    for (const double rise : {0.05, 0.10, 0.15}) {
      SmallWorld world;  // a kerb with a pavement, a carton on that, and a pedestal
      world.floor(0, 0, 8, 4).box(4, 0, 0, 8, 4, rise).box(4.4, 1, rise, 4.8, 1.4, rise + 0.05);
      world.box(1, 1, 0, 1.8, 2, rise);
      const MapSurvey survey = survey_of(world, config);
      for (const auto& [x, y] : {std::pair{1.5, 1.5}, {4.1, 1.1}, {4.1, 3.1}, {6.1, 2.1}})
        EXPECT_EQ(ground_at(survey, x, y), Ground::obstacle) << rise << ' ' << x;
    }
  }
}

TEST(MapSurvey, climbs_a_step_of_one_voxel_where_voxels_cannot_show_five_centimetres) {
  SmallWorld world(0.08);
  world.floor(0, 0, 4, 4).box(2, 0, 0, 4, 4, 0.08).box(0.8, 0.8, 0, 1.2, 1.2, 0.16);
  const MapSurvey survey = survey_of(world);
  EXPECT_EQ(ground_at(survey, 3, 2), Ground::floor);
  EXPECT_EQ(ground_at(survey, 1, 1), Ground::obstacle);
  EXPECT_EQ(ground_at(survey_of(world, climbing(0.0)), 3, 2), Ground::obstacle);
}

TEST(MapSurvey, judges_slopes_alike_whichever_way_they_run) {
  for (const auto& [degrees, walks] : {std::pair{38.0, true}, {47.0, false}}) {
    for (const auto& [heading, climb] : {std::pair{0.0, 0.1},
                                         {0.4, 0.1},
                                         {navvi_types::kPi / 4, 0.1},
                                         {1.2, 0.1},
                                         {0.0, 0.04},
                                         {navvi_types::kPi / 4, 0.04},
                                         {1.5, 0.04}}) {
      SmallWorld world;
      world.floor(0, 0, 6, 6);
      const double slope = std::tan(navvi_types::radians(degrees));
      for (int i = 0; i < 120; ++i) {
        for (int j = 0; j < 120; ++j) {
          const double along =
              (0.05 * i - 3.0) * std::cos(heading) + (0.05 * j - 3.0) * std::sin(heading);
          const double top = 0.05 * std::ceil(std::min(along * slope, 1.5) / 0.05);
          if (top > 0.01) world.box(0.05 * i, 0.05 * j, 0, 0.05 * i + 0.05, 0.05 * j + 0.05, top);
        }
      }
      int floor = 0, all = 0;
      const MapSurvey survey = survey_of(world, climbing(climb));
      for (double s = 0.25; s * slope < 1.25; s += 0.05) {
        ++all;
        if (ground_at(survey, 3.0 + s * std::cos(heading), 3.0 + s * std::sin(heading)) ==
            Ground::floor)
          ++floor;
      }
      EXPECT_EQ(floor, walks ? all : 0) << degrees << ' ' << heading;
    }
  }
}

TEST(MapSurvey, climbs_no_step_higher_than_allowed_and_ends_the_upper_side_before_the_edge) {
  SmallWorld world = ramp_world(0.3);
  const MapSurvey survey = survey_of(world, climbing(0.1));
  EXPECT_EQ(ground_at(survey, 8.0, 2.0), Ground::floor);       // on the deck, 0.9 m up
  EXPECT_EQ(ground_at(survey, 8.975, 2.0), Ground::obstacle);  // the deck's last cell
  EXPECT_EQ(ground_at(survey, 9.025, 2.0), Ground::floor);     // the floor below it
  SmallWorld step;
  step.floor(0, 0, 4, 4).box(2, 0, 0, 4, 4, 0.2);
  EXPECT_EQ(ground_at(survey_of(step, climbing(0.15)), 3, 2), Ground::obstacle);
  EXPECT_EQ(ground_at(survey_of(step, climbing(0.2)), 3, 2), Ground::floor);
  EXPECT_EQ(ground_at(survey_of(step, climbing(0.2)), 2.02, 2), Ground::floor);
}

TEST(MapSurvey, takes_the_lowest_large_floor_or_the_one_it_is_told) {
  SmallWorld world;
  world.floor(0, 0, 4, 4).box(0, 0, 3.0, 4, 4, 3.1).box(1, 1, -1, 1.2, 1.2, -0.9);
  EXPECT_NEAR(survey_of(world).floor_height, 0.0, 1e-9);
  SurveyConfig upper;
  upper.floor_height = 3.0;
  EXPECT_NEAR(survey_of(world, upper).floor_height, 3.1, 1e-9);
  upper.floor_height = 2.0;
  EXPECT_EQ(survey_map(world.voxels(), upper).error,
            "the map shows no floor within 0.25 m of 2.00 m (floor_height), but at z = 3.10 m "
            "(16.0 m^2), z = 0.00 m (16.0 m^2), z = -0.90 m (0.0 m^2)");
}

TEST(MapSurvey, takes_the_level_on_which_the_robot_stands) {
  SmallWorld slab;  // of 8 x 8 m on a plane that shows more around it, with a pallet
  slab.floor(-6, -6, 6, 6).box(-4, -4, 0, 4, 4, 0.05).box(1, 1, 0.05, 2, 2, 0.15);
  EXPECT_NEAR(survey_of(slab).floor_height, 0.0, 1e-9) << "by area alone";
  SurveyConfig config;
  for (const auto& [stands_at, floor] :
       {std::pair{0.05, 0.05}, {0.04, 0.05}, {0.0, 0.0}, {-0.02, 0.0}, {0.15, 0.05}, {3.0, 0.0}}) {
    config.stands_at = stands_at;
    EXPECT_NEAR(survey_of(slab, config).floor_height, floor, 1e-9) << stands_at;
  }
  config.stands_at = 0.0;
  config.floor_height = 0.05;
  EXPECT_NEAR(survey_of(slab, config).floor_height, 0.05, 1e-9) << "a given height comes first";
}

TEST(MapSurvey, N10_refuses_maps_that_are_empty_or_too_large) {
  EXPECT_EQ(survey_map(Voxels{"", 0.05, {}}, {}).error, "the map has no occupied voxel");
  Voxels wide{"", 0.05, {{0, 0, 32768, 0, 1}, {65000, 65000, 32768, 0, 1}}};
  EXPECT_EQ(survey_map(wide, {}).error,
            "the map spreads over 4225 million columns of voxels; 50 million are allowed, as with "
            "voxels of 0.46 m (octomap/resolution of the simulator)");
  Voxels tall{"", 0.05, {{32768, 32768, 0, 0, 1}, {32768, 32768, 65000, 0, 1}}};
  EXPECT_EQ(survey_map(tall, {}).error, "the map is 65001 voxels tall; 30000 are allowed");
  Voxels layered{"", 0.05, {}};  // a few kB of a message
  for (int i = 0; i < 27 * 27 * 5; ++i)
    layered.octets.push_back({static_cast<std::uint16_t>(256 * (i % 27)),
                              static_cast<std::uint16_t>(256 * (i / 27 % 27)),
                              static_cast<std::uint16_t>(256 * (i / 27 / 27)), 7, 15});
  EXPECT_EQ(survey_map(layered, {}).error,
            "the map has 238 million runs of voxels in its columns; 200 million are allowed");
  Voxels stacked{"", 0.05, {}};  // 26 kB of a message: 11 storeys of 205 x 205 m
  for (int i = 0; i < 32 * 32 * 11; ++i)
    stacked.octets.push_back({static_cast<std::uint16_t>(128 * (i % 32)),
                              static_cast<std::uint16_t>(128 * (i / 32 % 32)),
                              static_cast<std::uint16_t>(128 * (i / 32 / 32)), 6, 15});
  EXPECT_EQ(survey_map(stacked, {}).error,
            "the map stacks more runs of voxels in its columns than the 4 million that are allowed "
            "with 11264 nodes that hold leaves");
  Voxels full{"", 0.05, {{0, 0, 0, 15, 255}}};
  EXPECT_FALSE(survey_map(full, {}).error.empty());
}

TEST(MapSurvey, takes_a_hall_of_300_m_in_voxels_of_5_cm) {
  Voxels hall{"", 0.05, {}};
  for (int i = 0; i < 188 * 188; ++i)  // of 1.6 m
    hall.octets.push_back({static_cast<std::uint16_t>(29760 + 32 * (i % 188)),
                           static_cast<std::uint16_t>(29760 + 32 * (i / 188)), 32736, 4, 255});
  hall.octets.push_back({32768, 32768, 32768, 0, 1});
  const MapSurvey survey = survey_map(hall, {});
  ASSERT_EQ(survey.error, "");
  EXPECT_EQ(survey.columns, 6016);
  EXPECT_EQ(survey.rows, 6016);
  EXPECT_EQ(ground_at(survey, 0.01, 0.01), Ground::obstacle);
  EXPECT_EQ(ground_at(survey, 0.06, 0.01), Ground::floor);
  EXPECT_EQ(ground_at(survey, 150.0, -150.0), Ground::floor);
}

TEST(MapSurvey, takes_solid_storeys_of_a_few_large_leaves_above_each_other) {
  Voxels house{"", 0.05, {}};
  for (int i = 0; i < 8 * 8 * 4; ++i)  // of 51 x 51 m
    house.octets.push_back({static_cast<std::uint16_t>(32768 + 128 * (i % 8)),
                            static_cast<std::uint16_t>(32768 + 128 * (i / 8 % 8)),
                            static_cast<std::uint16_t>(32768 + 128 * (i / 64)), 6, 15});
  const MapSurvey survey = survey_map(house, {});
  ASSERT_EQ(survey.error, "");
  EXPECT_EQ(survey.columns, 1024);
  EXPECT_EQ(ground_at(survey, 20.01, 20.01), Ground::floor);
}

TEST(MapSurvey, takes_a_ground_of_100_m_that_is_10_m_thick) {
  Voxels ground{"", 0.05, {}};
  const auto fill = [&](int level, int bottom, int top) {  // 2048 voxels wide, of leaves alike
    const int side = 2 << level;
    for (int x = 0; x < 2048; x += side)
      for (int y = 0; y < 2048; y += side)
        for (int z = bottom; z < top; z += side)
          ground.octets.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                   static_cast<std::uint16_t>(z), static_cast<std::uint8_t>(level),
                                   255});
  };
  fill(3, 32768 - 208, 32768 - 192);
  fill(5, 32768 - 192, 32768 - 128);
  fill(6, 32768 - 128, 32768);
  const MapSurvey survey = survey_map(ground, {});
  ASSERT_EQ(survey.error, "");
  EXPECT_NEAR(survey.floor_height, 0.0, 1e-9);
}

TEST(MapSurvey, takes_a_coarse_cell_for_floor_only_if_all_of_it_is) {
  SmallWorld world;
  world.floor(0, 0, 4, 4).box(1.0, 1.0, 0, 1.05, 1.05, 0.5);
  SurveyConfig config;
  config.cell_size = 0.2;
  const MapSurvey survey = survey_of(world, config);
  EXPECT_EQ(survey.columns, 20);
  EXPECT_EQ(ground_at(survey, 1.1, 1.1), Ground::obstacle);
  EXPECT_EQ(ground_at(survey, 0.9, 0.9), Ground::floor);
  config.cell_size = 0.15;  // 4 m are no whole number of such cells
  EXPECT_EQ(ground_at(survey_of(world, config), 3.97, 2.0), Ground::none);
}

SurveyConfig whole_cells(double cell_size) {
  SurveyConfig config;
  config.cell_size = cell_size;
  config.margin = 0.0;
  return config;
}

OccupancyGrid grid_of(int width, int height, double resolution) {
  OccupancyGrid grid;
  grid.width = width;
  grid.height = height;
  grid.resolution = resolution;
  grid.cells.assign(static_cast<std::size_t>(width * height), 0);
  return grid;
}

TEST(OccupancyGrid, is_floor_where_free_and_nothing_where_unknown) {
  OccupancyGrid grid = grid_of(5, 2, 0.1);
  grid.origin = {-0.2, 0.3};
  grid.cells = {0, 19, 20, 65, 66, 100, -1, 0, 0, 0};
  const MapSurvey survey = read_grid(grid, whole_cells(0.0));
  ASSERT_EQ(survey.error, "");
  EXPECT_EQ(survey.low.x, -2);
  EXPECT_EQ(survey.low.y, 3);
  const std::vector<Ground> expected{
      Ground::floor,    Ground::floor, Ground::none,  Ground::none,  Ground::obstacle,
      Ground::obstacle, Ground::none,  Ground::floor, Ground::floor, Ground::floor};
  EXPECT_TRUE(survey.ground == Bands<Ground>(5, 2, expected.data()));
}

TEST(OccupancyGrid, is_laid_on_the_lattice_so_that_nothing_blocked_becomes_free) {
  std::mt19937 random(1);
  for (int round = 0; round < 30; ++round) {
    OccupancyGrid grid = grid_of(24, 17, 0.05 + 0.01 * (round % 4));
    grid.origin = {0.001 * static_cast<double>(random() % 1000) - 0.5, 0.37 * round - 3.0};
    for (auto& cell : grid.cells) cell = random() % 4 == 0 ? std::int8_t{100} : std::int8_t{0};
    const MapSurvey survey = read_grid(grid, whole_cells(round % 2 == 0 ? 0.0 : 0.1));
    ASSERT_EQ(survey.error, "");
    for (int probe = 0; probe < 2000; ++probe) {
      const double u = static_cast<double>(random() % 10000) / 10000,
                   v = static_cast<double>(random() % 10000) / 10000;
      const int x = static_cast<int>(u * grid.width), y = static_cast<int>(v * grid.height);
      if (grid.cells[static_cast<std::size_t>(y * grid.width + x)] == 0) continue;
      ASSERT_EQ(ground_at(survey, grid.origin.x + u * grid.width * grid.resolution,
                          grid.origin.y + v * grid.height * grid.resolution),
                Ground::obstacle);
    }
  }
}

TEST(OccupancyGrid, lies_as_it_was_turned) {
  std::mt19937 random(1);
  for (const double yaw : {0.3, M_PI / 2, -2.0, 3.1}) {
    OccupancyGrid grid = grid_of(40, 30, 0.1);
    grid.origin = {1.03, -0.52};
    grid.yaw = yaw;
    for (int i = 0; i < 15; ++i) grid.cells[static_cast<std::size_t>(random() % 1200)] = 100;
    const MapSurvey survey = read_grid(grid, whole_cells(0.1));
    ASSERT_EQ(survey.error, "");
    int floor = 0, free = 0;
    for (int row = 1; row < 29; ++row)
      for (int column = 1; column < 39; ++column) {
        const Point at = grid.origin + 0.1 * (column + 0.5) * Point{std::cos(yaw), std::sin(yaw)} +
                         0.1 * (row + 0.5) * Point{-std::sin(yaw), std::cos(yaw)};
        const Ground found = ground_at(survey, at.x, at.y);
        const bool blocked = grid.cells[static_cast<std::size_t>(row * 40 + column)] == 100;
        EXPECT_TRUE(!blocked || found == Ground::obstacle) << yaw << " " << row << " " << column;
        free += !blocked;
        floor += found == Ground::floor;
      }
    EXPECT_GT(floor, 0.75 * free) << yaw;
  }
}

TEST(OccupancyGrid, is_refused_in_a_sentence_if_anything_is_wrong_with_it) {
  const auto error = [](auto change) {
    OccupancyGrid grid = grid_of(4, 3, 0.05);
    change(grid);
    return read_grid(grid, {}).error;
  };
  EXPECT_EQ(error([](OccupancyGrid&) {}), "");
  EXPECT_EQ(error([](OccupancyGrid& g) { g.width = 0; }), "the occupancy grid has no cells");
  EXPECT_EQ(error([](OccupancyGrid& g) { g.cells.pop_back(); }),
            "the occupancy grid holds 11 cells where 4 x 3 are announced");
  EXPECT_EQ(error([](OccupancyGrid& g) { g.cells[3] = 101; }),
            "the occupancy grid holds the value 101; -1 and 0 to 100 are allowed");
  EXPECT_EQ(error([](OccupancyGrid& g) {
              g.cells.assign(12000, 0);
              g.width = 12000;
              g.height = 1;
              g.yaw = 0.8;
            }),
            "the occupancy grid is turned, and has more than 50 million cells along the axes of map");
  for (const double far : {500e3, -500e3, 1e300})
    EXPECT_FALSE(error([far](OccupancyGrid& g) { g.origin = {far, 0.0}; }).empty()) << far;
  EXPECT_EQ(
      error([](OccupancyGrid& g) {
        g.origin = {-500e3, 2.0};
      }),
      "the map reaches 500 km from the origin of map; at most 10 km are allowed, so choose an "
      "origin near it");
  for (const double bad : {0.0, -1.0, 1e-9, std::nan("")})
    EXPECT_FALSE(error([bad](OccupancyGrid& g) { g.resolution = bad; }).empty());
  EXPECT_FALSE(error([](OccupancyGrid& g) { g.yaw = std::nan(""); }).empty());
  EXPECT_FALSE(error([](OccupancyGrid& g) { g.origin.x = std::nan(""); }).empty());
  EXPECT_FALSE(error([](OccupancyGrid& g) { g.width = g.height = 1 << 30; }).empty());
}

TEST(MapSurvey, is_the_same_from_the_levels_around_the_floor_alone) {
  std::mt19937 random(7);
  const auto at = [&](int most) { return 0.05 * static_cast<double>(random() % most); };
  for (int round = 0; round < 40; ++round) {
    SmallWorld world;
    world.floor(0, 0, 3, 3).box(2, 2, 0.2, 3, 3, 0.25).box(2, 0, 3, 3, 1, 3.05);
    for (int i = 0; i < 30; ++i) {
      const double x = at(50), y = at(50), z = at(60);
      world.box(x, y, z, x + 0.05 + at(8), y + 0.05 + at(8), z + 0.05 + at(8));
    }
    Voxels near = world.voxels();
    const std::vector<std::int8_t> all = world.bytes();
    SurveyConfig low = climbing(0.0), high = low, elsewhere = low, again = low;
    low.floor_height = 0.02;
    see_ground(near, low);
    high.robot_height = 1.5;
    high.stands_at = 0.0;
    elsewhere.stands_at = 9.0;
    again.stands_at = 0.02;
    again.cell_size = 0.1;
    for (const SurveyConfig& config : {low, high, elsewhere, again}) {
      const MapSurvey wanted = survey_map({all.data(), all.size(), true, "OcTree", 0.05}, config);
      const MapSurvey got = survey_map(near, config);
      ASSERT_EQ(got.error, "");
      ASSERT_EQ(got.floor_height, wanted.floor_height);
      ASSERT_TRUE(got.ground == wanted.ground) << "round " << round;
    }
  }
}

}  // namespace
}  // namespace navvi_floor
