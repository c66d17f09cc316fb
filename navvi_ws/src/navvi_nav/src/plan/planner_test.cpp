#include "plan/planner.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "small_world.hpp"
#include "smooth/turns.hpp"
#include "temp_folder.hpp"

namespace navvi_nav::plan {
namespace {

constexpr double kRadius = 0.35;
constexpr double kTolerance = 1e-6;

Planner planner_on(SmallWorld& world) {
  Planner planner{PlannerConfig{}};
  EXPECT_EQ(planner.set_map(world.voxels()).error, "");
  return planner;
}

/// A path that begins nearer to something than the radius must not lead nearer to it.
void expect_clear(const Path& path, const SmallWorld& map, const std::vector<Cylinder>& cylinders) {
  const Point start = path.front();
  for (const Point point : points_along(path, 0.01)) {
    for (const auto& block : map.blocks()) {
      const double least = std::min(kRadius, distance_to(block, start));
      ASSERT_GE(distance_to(block, point), least - kTolerance) << point.x << " " << point.y;
    }
    for (const Cylinder& cylinder : cylinders) {
      const double least = std::min(cylinder.radius + kRadius, distance(cylinder.center, start));
      ASSERT_GE(distance(cylinder.center, point), least - kTolerance);
    }
  }
}

TEST(Planner, leads_round_a_closed_zone_and_to_nowhere_in_it) {
  const navvi_test::TempFolder folder;
  PlannerConfig config;
  config.mesh.zones = folder.write(
      "zones.yaml", "- {name: press, kind: keep_out, corners: [4, 1, 6, 1, 6, 5, 4, 5]}\n"
                    "- {name: lane, kind: slow, speed: 0.4, corners: [0, 0, 10, 0, 10, 1, 0, 1]}\n");
  SmallWorld world;
  world.room(10, 8);
  Planner planner{config};
  ASSERT_EQ(planner.set_map(world.voxels()).error, "");
  const Plan plan = planner.plan({2, 3}, {8, 3});
  ASSERT_EQ(plan.status, PlanStatus::found);
  for (const Point point : points_along(plan.path, 0.01))
    ASSERT_GE(distance_to({4, 1, 6, 5}, point), kRadius - kTolerance) << point.x << " " << point.y;
  EXPECT_EQ(planner.plan({2, 3}, {5, 3}).refusal, Guidance::Refusal::inside_obstacle);
}

TEST(Planner, says_that_there_is_no_map) {
  EXPECT_EQ(Planner(PlannerConfig{}).plan({0, 0}, {1, 1}).status, PlanStatus::no_map);
}

TEST(Planner, N3_tells_the_refusals_apart) {
  Planner planner =
      planner_on(SmallWorld().room(12, 6).box(6, 0, 0, 6.1, 6, 1).box(2, 2, 0, 3, 3, 1));
  EXPECT_EQ(planner.plan({1, 1}, {2.5, 2.5}).refusal, Guidance::Refusal::inside_obstacle);
  EXPECT_EQ(planner.plan({1, 1}, {3.2, 2.5}).refusal, Guidance::Refusal::inside_obstacle);
  EXPECT_EQ(planner.plan({1, 1}, {40, 2}).refusal, Guidance::Refusal::off_the_map);
  EXPECT_EQ(planner.plan({1, 1}, {1e9, 2}).refusal, Guidance::Refusal::off_the_map);
  EXPECT_EQ(planner.plan({1, 1}, {9, 3}).refusal, Guidance::Refusal::unreachable);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Plan plan = planner.plan({1, 1}, {bad, 3});
    EXPECT_EQ(plan.status, PlanStatus::refused);
    EXPECT_EQ(plan.refusal, Guidance::Refusal::not_finite);
  }
  EXPECT_EQ(planner.plan({1, 1}, {5, 5}).status, PlanStatus::found);
}

TEST(Planner, N3_calls_a_goal_not_seen_where_nothing_is_known_and_not_where_something_stands) {
  Planner planner =
      planner_on(SmallWorld().floor(0, 0, 6, 6).box(4, 4, 0, 5, 5, 1).floor(9, 0, 10, 6));
  EXPECT_EQ(planner.plan({2, 2}, {7.5, 3}).refusal, Guidance::Refusal::not_seen);
  EXPECT_EQ(planner.plan({2, 2}, {5.8, 2}).refusal, Guidance::Refusal::not_seen)
      << "on the last floor that is seen";
  EXPECT_EQ(planner.plan({2, 2}, {4.5, 4.5}).refusal, Guidance::Refusal::inside_obstacle);
  EXPECT_EQ(planner.plan({2, 2}, {3.8, 4.5}).refusal, Guidance::Refusal::inside_obstacle);
  EXPECT_EQ(planner.plan({2, 2}, {40, 2}).refusal, Guidance::Refusal::off_the_map);
  EXPECT_EQ(planner.plan({2, 2}, {5.3, 2}).status, PlanStatus::found);
}

TEST(Planner, leads_toward_a_goal_that_is_not_seen_only_where_that_is_asked_for) {
  SmallWorld world;
  world.floor(0, 0, 6, 6).box(4, 4, 0, 5, 5, 1).floor(9, 0, 10, 6);
  Planner planner = planner_on(world);
  for (const Point goal : {Point{7.5, 3}, Point{40, 3}}) {
    const Plan refused = planner.plan({2, 2}, goal);
    EXPECT_EQ(refused.status, PlanStatus::refused);
    const Plan plan = planner.plan({2, 2}, goal, {}, true);
    ASSERT_EQ(plan.status, PlanStatus::found);
    EXPECT_TRUE(plan.ends_short);
    EXPECT_EQ(plan.refusal, refused.refusal);
    EXPECT_NEAR(distance(plan.path.back(), {5.65, 3}), 0.0, 0.1) << "not on the island";
    expect_clear(plan.path, world, {});
  }
  EXPECT_EQ(planner.plan({2, 2}, {4.5, 4.5}, {}, true).refusal, Guidance::Refusal::inside_obstacle);
  EXPECT_FALSE(planner.plan({2, 2}, {5, 2}, {}, true).ends_short);
  EXPECT_EQ(planner.plan({30, 2}, {40, 3}, {}, true).status, PlanStatus::off_mesh);
}

TEST(Planner, keeps_the_end_of_the_path_that_is_followed_unless_half_a_metre_is_gained) {
  Planner planner = planner_on(SmallWorld().floor(0, 0, 6, 6));
  const Point goal{40, 3};
  const Path followed{{2, 3}, {5.3, 3}};
  EXPECT_EQ(planner.plan({2, 3}, goal, followed, true).path.back(), followed.back());
  const Path behind{{2, 3}, {5.0, 3}};
  EXPECT_GT(planner.plan({2, 3}, goal, behind, true).path.back().x, 5.5);
  const Path beside_the_floor{{2, 3}, {5.9, 3}};
  EXPECT_LT(planner.plan({2, 3}, goal, beside_the_floor, true).path.back().x, 5.7);
}

TEST(Planner, N4_says_off_mesh_where_no_path_can_begin) {
  SmallWorld world;
  world.room(12, 8).box(2, 2, 0, 6, 6, 1);
  Planner planner = planner_on(world);
  EXPECT_EQ(planner.plan({4, 4}, {1, 1}).status, PlanStatus::off_mesh);
  const Plan snapped = planner.plan({1.75, 4}, {1, 1});  // touches the box
  ASSERT_EQ(snapped.status, PlanStatus::found);
  expect_clear(snapped.path, world, {});
}

TEST(Planner, cuts_no_holes_before_something_needs_them_and_then_those_of_the_latest) {
  Planner planner =
      planner_on(SmallWorld().room(12, 4).box(6, 0, 0, 6.2, 1.5, 1).box(6, 2.5, 0, 6.2, 4, 1));
  PlanRequest request;
  for (const Point place : {Point{3, 2}, Point{6.1, 2}}) {
    request.obstacles = {{1, place, 0.5, {}}};
    EXPECT_FALSE(planner.answer(request).plan);
    EXPECT_TRUE(planner.nav_mesh().carved().empty());
  }
  EXPECT_EQ(planner.plan({2, 2}, {10, 2}).status, PlanStatus::no_route);
  ASSERT_EQ(planner.nav_mesh().carved().size(), 1U);
  request.obstacles.clear();
  request.show_mesh = true;
  EXPECT_TRUE(planner.answer(request).navmesh);
  EXPECT_TRUE(planner.nav_mesh().carved().empty());
}

TEST(Planner, calls_a_route_closed_by_a_cylinder_no_route_not_unreachable) {
  Planner planner =
      planner_on(SmallWorld().room(12, 4).box(6, 0, 0, 6.2, 1.5, 1).box(6, 2.5, 0, 6.2, 4, 1));
  EXPECT_EQ(planner.plan({2, 2}, {10, 2}).status, PlanStatus::found);
  planner.carve({{7, {6.1, 2.0}, 0.3, {}}});
  EXPECT_EQ(planner.plan({2, 2}, {10, 2}).status, PlanStatus::no_route);
  planner.carve({{7, {10, 2}, 0.3, {}}});
  EXPECT_EQ(planner.plan({2, 2}, {10, 2}).status, PlanStatus::no_route);
  planner.carve({});
  EXPECT_EQ(planner.plan({2, 2}, {10, 2}).status, PlanStatus::found);
}

TEST(Planner, ends_exactly_at_the_goal_even_in_the_last_cell_before_a_wall) {
  SmallWorld world;
  world.room(8, 8);
  Planner planner = planner_on(world);
  const Point goal{0.46, 4.0};
  const Plan plan = planner.plan({4, 4}, goal);
  ASSERT_EQ(plan.status, PlanStatus::found);
  EXPECT_TRUE(plan.path.back() == goal);
  expect_clear(plan.path, world, {});
}

TEST(Planner, N5_survives_start_and_goal_in_one_place) {
  SmallWorld world;
  world.room(8, 8);
  const Plan plan = planner_on(world).plan({4, 4}, {4, 4});
  EXPECT_EQ(plan.status, PlanStatus::found);
}

/// A corridor 2 m wide and 12 m long, with a place to step aside at its left end.
SmallWorld corridor() {
  SmallWorld world;
  world.room(14, 6).box(2.5, 0, 0, 13.9, 2, 1).box(2.5, 4, 0, 13.9, 6, 1);
  return world;
}

Plan answer(Planner& planner, const std::vector<Cylinder>& obstacles, Point start, Point goal,
            const std::vector<Cylinder>& predicted = {},
            const std::vector<Cylinder>& swept_area = {}) {
  PlanRequest request;
  request.obstacles = obstacles;
  request.predicted = predicted;
  request.swept_area = swept_area;
  request.start = start;
  request.goal = goal;
  return planner.answer(request).plan.value_or(Plan{});
}

TEST(Planner, tells_a_way_that_only_moving_things_close_from_one_that_is_none) {
  SmallWorld world = corridor();
  Planner planner = planner_on(world);
  for (const Point at : {Point{7, 3}, Point{12.8, 3}, Point{4.6, 3}}) {
    const std::vector<Cylinder> obstacles{{1, at, 0.9, {}}};
    const Plan plan = answer(planner, obstacles, {4.2, 3}, {12.8, 3});
    EXPECT_EQ(plan.status, PlanStatus::closed) << at.x;
    EXPECT_NEAR(length_of(plan.path), 8.6, 0.1);
    EXPECT_EQ(planner.nav_mesh().carved().size(), 1U);
  }
  world.box(8, 2, 0, 8.1, 4, 1);
  planner.set_map(world.voxels());
  EXPECT_EQ(answer(planner, {}, {4.2, 3}, {12.8, 3}).refusal, Guidance::Refusal::unreachable);
}

TEST(Planner, steps_aside_to_the_nearest_place_off_the_ground_that_is_needed) {
  SmallWorld world = corridor();
  Planner planner = planner_on(world);
  std::vector<Cylinder> ground;
  for (double x = 0.5; x < 6.5; x += 0.5) ground.push_back({1, {x, 3}, 0.75, {}});
  const Plan plan = planner.retreat(ground, {4.5, 3});
  ASSERT_EQ(plan.status, PlanStatus::retreat);
  EXPECT_LT(length_of(plan.path), 4.0);
  for (const Cylinder& one : ground)
    EXPECT_GE(distance(one.center, plan.path.back()), one.radius + kRadius + 0.2 - kTolerance);
  for (double x = 6.5; x < 13.5; x += 0.5) ground.push_back({1, {x, 3}, 0.75, {}});
  ground.push_back({1, {1.3, 3}, 3.0, {}});
  EXPECT_EQ(planner.retreat(ground, {4.5, 3}).status, PlanStatus::no_route);
}

TEST(Planner, answers_with_a_retreat_only_where_obstacles_close_the_path_and_there_is_room) {
  SmallWorld world = corridor();
  Planner planner = planner_on(world);
  const std::vector<Cylinder> blocks{{1, {7, 3}, 0.9, {}}};
  std::vector<Cylinder> swept;
  for (double x = 0.5; x < 6.5; x += 0.5) swept.push_back({1, {x, 3}, 0.75, {}});
  EXPECT_EQ(answer(planner, {}, {4.5, 3}, {12.8, 3}, {}, swept).status, PlanStatus::found);
  const Plan retreat = answer(planner, blocks, {4.5, 3}, {12.8, 3}, {}, swept);
  EXPECT_EQ(retreat.status, PlanStatus::retreat);
  EXPECT_EQ(retreat.path, planner.retreat(swept, {4.5, 3}).path);
  swept.push_back({1, {7, 3}, 9.0, {}});
  EXPECT_EQ(answer(planner, blocks, {4.5, 3}, {12.8, 3}, {}, swept).status, PlanStatus::closed);
}

TEST(Planner, avoids_where_obstacles_will_be_only_if_there_is_another_path) {
  Planner planner = planner_on(SmallWorld().room(14, 8).box(4, 3.5, 0, 10, 4.5, 1));
  const std::vector<Cylinder> below{{1, {7, 2}, 1.3, {}}};
  const std::vector<Cylinder> above{{2, {7, 6}, 1.3, {}}};
  const auto leads_above = [](const Plan& plan) {
    return std::any_of(plan.path.begin(), plan.path.end(), [](Point at) { return at.y > 4.5; });
  };
  EXPECT_FALSE(leads_above(answer(planner, {}, {2, 3}, {12, 3})));
  EXPECT_TRUE(leads_above(answer(planner, {}, {2, 3}, {12, 3}, below)));
  const Plan both = answer(planner, above, {2, 3}, {12, 3}, below);
  EXPECT_EQ(both.status, PlanStatus::found);
  EXPECT_FALSE(leads_above(both));
  EXPECT_EQ(planner.nav_mesh().carved().size(), 1U);
}

TEST(Planner, keeps_the_radius_in_the_papers_profile_too) {
  PlannerConfig config;
  config.mesh.cell_size = 0.2;
  config.mesh.whole_cell_erosion = true;
  config.mesh.contour_error = 0.0;
  config.smoothing.cost.preferred_clearance = 0.0;
  config.smoothing.enabled = false;
  int found = 0;
  for (unsigned seed = 0; seed < 15; ++seed) {
    RandomWorld world(seed);
    Planner planner(config);
    ASSERT_EQ(planner.set_map(world.map.voxels()).error, "");
    planner.carve(world.cylinders);
    const Plan plan = planner.plan(world.start, world.goal);
    if (plan.status != PlanStatus::found) continue;
    ++found;
    expect_clear(plan.path, world.map, world.cylinders);
    EXPECT_LE(length_of(plan.path), plan.shortest + 1e-9);
  }
  EXPECT_GE(found, 3);
}

/// Open cells that edges join to the one at `from`.
bool joined_by_cells(const map::Floor& floor, map::Cell from, map::Cell to) {
  std::set<std::pair<int, int>> seen{{from.x, from.y}};
  std::vector<map::Cell> waiting{from};
  while (!waiting.empty()) {
    const map::Cell at = waiting.back();
    waiting.pop_back();
    for (const map::Cell next : {map::Cell{at.x + 1, at.y}, map::Cell{at.x - 1, at.y},
                                 map::Cell{at.x, at.y + 1}, map::Cell{at.x, at.y - 1}})
      if (floor.open(next) && seen.insert({next.x, next.y}).second) waiting.push_back(next);
  }
  return seen.count({to.x, to.y}) > 0;
}

TEST(Planner, finds_a_route_wherever_open_cells_join_start_and_goal) {
  for (unsigned seed = 100; seed < 125; ++seed) {
    RandomWorld world(seed);
    Planner planner = planner_on(world.map);
    const map::Floor& floor = *planner.nav_mesh().shared_floor();
    const map::Cell from = floor.cell_at(world.start), to = floor.cell_at(world.goal);
    if (!floor.open(from) || !floor.open(to)) continue;
    const PlanStatus status = planner.plan(world.start, world.goal).status;
    if (joined_by_cells(floor, from, to))
      EXPECT_EQ(status, PlanStatus::found) << seed;
    else  // finer cells may join them
      EXPECT_TRUE(status == PlanStatus::found || status == PlanStatus::refused) << seed;
  }
}

std::size_t turns_of(const Path& path) { return smooth::turns_of(path, 1.0).size() - 1; }

TEST(Planner, finds_the_same_paths_wherever_the_map_lies) {
  std::mt19937 random(7);
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  map::OccupancyGrid grid{240, 240, 0.1, {0.0, 0.0}, 0.0, {}};
  grid.cells.assign(240 * 240, 0);
  for (int box = 0; box < 28; ++box) {
    const int left = draw(220), low = draw(220), width = 5 + draw(30), height = 5 + draw(30);
    for (int y = low; y < std::min(240, low + height); ++y)
      for (int x = left; x < std::min(240, left + width); ++x)
        grid.cells[static_cast<std::size_t>(240 * y + x)] = 100;
  }
  const Point away{9900.0, -9900.0};
  Planner here((PlannerConfig()));
  ASSERT_EQ(here.set_map(grid).error, "");
  grid.origin = away;
  Planner there((PlannerConfig()));
  ASSERT_EQ(there.set_map(grid).error, "");
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    const Point from{0.1 * draw(240), 0.1 * draw(240)};
    const Point to{0.1 * draw(240), 0.1 * draw(240)};
    const Plan near = here.plan(from, to);
    const Plan far = there.plan(from + away, to + away);
    ASSERT_EQ(near.status, far.status) << round;
    if (near.status != PlanStatus::found) continue;
    ++found;
    EXPECT_NEAR(near.shortest, far.shortest, 1e-6) << round;
  }
  EXPECT_GT(found, 50);
}

/// Racks of 10 x 2 m with aisles of 2 m, in cells of 0.2 m. \param margin  cells round them
map::OccupancyGrid field_of_racks(int columns, int rows, int margin) {
  map::OccupancyGrid grid;
  grid.width = columns * 60 - 10 + 2 * margin;
  grid.height = rows * 20 - 10 + 2 * margin;
  grid.resolution = 0.2;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const bool wall = x == 0 || y == 0 || x == grid.width - 1 || y == grid.height - 1;
      const bool rack = x >= margin && x < grid.width - margin && (x - margin) % 60 < 50 &&
                        y >= margin && y < grid.height - margin && (y - margin) % 20 < 10;
      grid.cells.push_back(wall || rack ? 100 : 0);
    }
  }
  return grid;
}

TEST(Planner, leads_round_a_field_of_racks_rather_than_in_steps_through_it) {
  struct Field {
    map::OccupancyGrid grid;
    Point start, goal;
    double shortest;
  };
  for (const Field& field : {Field{field_of_racks(5, 10, 20), {2, 2}, {64, 44}, 89.7},
                             Field{field_of_racks(20, 40, 100), {10, 16}, {266, 180}, 357.5}}) {
    PlannerConfig config;
    Planner planner(config);
    ASSERT_EQ(planner.set_map(field.grid).error, "");
    const Plan plan = planner.plan(field.start, field.goal);
    ASSERT_EQ(plan.status, PlanStatus::found);
    EXPECT_LE(turns_of(plan.path), 2U);
    EXPECT_NEAR(plan.shortest, field.shortest, 1.0);
    EXPECT_LE(length_of(plan.path), config.smoothing.kMaxStretch * plan.shortest);
    config.smoothing.enabled = false;
    Planner shortest(config);
    ASSERT_EQ(shortest.set_map(field.grid).error, "");
    EXPECT_GE(turns_of(shortest.plan(field.start, field.goal).path), 10U);
  }
}

TEST(Planner, prefers_a_wide_way_to_a_slit_that_saves_little) {
  const auto passes_slit = [](double width) {
    SmallWorld world;
    world.room(16, 10 + width).box(7, 0.1, 0, 8, 6, 1).box(7, 6 + width, 0, 8, 6.5 + width, 1);
    const Plan plan = planner_on(world).plan({2, 6.4}, {13, 6.4});
    EXPECT_EQ(plan.status, PlanStatus::found);
    return std::all_of(plan.path.begin(), plan.path.end(), [](Point at) { return at.y < 7.2; });
  };
  EXPECT_FALSE(passes_slit(0.9));
  EXPECT_TRUE(passes_slit(1.8));
}

TEST(Planner, keeps_the_corners_that_are_followed_unless_others_save_enough) {
  Planner planner = planner_on(SmallWorld().room(16, 10).box(6, 3.6, 0, 10, 6, 1));
  const Point start{2, 4.6};
  const Point goal{14, 4.6};
  const Path above{start, {5.4, 6.9}, {10.6, 6.9}, goal};
  const auto leads_above = [](const Plan& plan) {
    return std::any_of(plan.path.begin(), plan.path.end(), [](Point at) { return at.y > 5.5; });
  };
  EXPECT_FALSE(leads_above(planner.plan(start, goal)));
  EXPECT_EQ(planner.plan(start, goal, above).path, above);
  EXPECT_FALSE(leads_above(planner.plan(start, {14, 2}, above)));  // another goal
  EXPECT_FALSE(leads_above(planner.plan(start, goal, {start, {5.4, 9}, {10.6, 9}, goal})));
  planner.carve({{1, {8, 7.5}, 1.2, {}}});
  EXPECT_FALSE(leads_above(planner.plan(start, goal, above)));
  planner.carve({{1, {3.7, 5.7}, 0.4, {}}});  // in the first leg: the corners after it are kept
  const Path round = planner.plan(start, goal, above).path;
  ASSERT_GE(round.size(), 4U);
  EXPECT_EQ(Path(round.end() - 3, round.end()), Path(above.end() - 3, above.end()));
}

TEST(Planner, has_a_better_path_the_more_work_it_may_do_and_a_whole_one_without_any) {
  std::vector<double> costs;  // m, of all paths, by the work
  for (const double effort : {0.0, 10.0, 30.0, 95.0}) {
    PlannerConfig config;
    config.smoothing.effort = effort;
    costs.push_back(0.0);
    for (unsigned seed = 0; seed < 20; ++seed) {
      RandomWorld world(seed);
      Planner planner(config);
      ASSERT_EQ(planner.set_map(world.map.voxels()).error, "");
      planner.carve(world.cylinders);
      const Plan plan = planner.plan(world.start, world.goal);
      if (plan.status != PlanStatus::found) continue;
      expect_clear(plan.path, world.map, world.cylinders);
      EXPECT_LE(length_of(plan.path), std::max(config.smoothing.kMaxStretch * plan.shortest,
                                               plan.shortest + config.smoothing.kMaxDetour) +
                                          0.1);
      EXPECT_TRUE(plan.path == planner.plan(world.start, world.goal).path);
      const NavMesh& mesh = planner.nav_mesh();
      const smooth::GuideCost cost(config.smoothing.cost, mesh.mesh(), mesh.space(), kRadius);
      const double own = cost.of(plan.path);
      if (std::isfinite(own)) costs.back() += own;  // no start or goal off the mesh
    }
  }
  for (std::size_t i = 1; i < costs.size(); ++i) EXPECT_GT(costs[i - 1], costs[i]);
}

/// The judge knows the boxes that the map was made of and the cylinders, not the mesh.
TEST(Planner, keeps_its_radius_and_its_bounds_on_ten_thousand_paths) {
  const PlannerConfig config;
  int paths = 0;
  double nearest = 10.0;
  for (unsigned seed = 0; paths < 10000; ++seed) {
    ASSERT_LT(seed, 200U);
    RandomWorld world(seed);
    Planner planner(config);
    ASSERT_EQ(planner.set_map(world.map.voxels()).error, "");
    planner.carve(world.cylinders);
    std::mt19937 random(seed);
    const auto pick = [&random](double size) {
      return 0.6 + size * static_cast<double>(random() % 1000) / 1000.0;
    };
    const auto room = [&world](Point at) {
      double least = 10.0;
      for (const auto& block : world.map.blocks()) least = std::min(least, distance_to(block, at));
      for (const Cylinder& one : world.cylinders)
        least = std::min(least, distance(one.center, at) - one.radius);
      return least;
    };
    for (int i = 0; i < 200; ++i) {
      const Plan plan = planner.plan({pick(18.8), pick(12.8)}, {pick(18.8), pick(12.8)});
      if (plan.status != PlanStatus::found || room(plan.path.front()) < kRadius) continue;
      ++paths;
      EXPECT_LE(length_of(plan.path), std::max(config.smoothing.kMaxStretch * plan.shortest,
                                               plan.shortest + config.smoothing.kMaxDetour) +
                                          0.1);
      EXPECT_GE(length_of(plan.path), plan.shortest - 0.1);
      for (const Point point : points_along(plan.path, 0.05))
        nearest = std::min(nearest, room(point));
    }
  }
  EXPECT_GE(nearest, kRadius - kTolerance);
}

}  // namespace
}  // namespace navvi_nav::plan
