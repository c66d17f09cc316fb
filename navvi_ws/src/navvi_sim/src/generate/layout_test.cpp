#include "generate/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <navvi_floor/map_survey.hpp>
#include <set>

#include "description/validate.hpp"
#include "navvi_sim/live/world.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "scenario/floor_ways.hpp"
#include "traffic/lanes.hpp"
#include "traffic/traffic.hpp"
#include "warehouse.hpp"

namespace navvi_sim::generate {
namespace {

// ---- Two hundred and forty layouts: every preset, in its own size, in the smallest hall, and in
// large ones.

struct Case {
  std::string name;
  LayoutConfig config;
  std::uint64_t seed;
};

/// Asks for no more of what is counted than a hall of that size has room for.
LayoutConfig sized(LayoutConfig config, double length, double width) {
  const double share = length * width / (config.length * config.width);
  const double lanes = std::floor((length - config.aisle) / (2.3 + config.aisle)) + 1.0;
  config.length = length;
  config.width = width;
  if (width < 15.0) {
    config.bays = 1;
    config.cross_aisle = std::min(config.cross_aisle, 2.4);
    config.door = std::min(config.door, 2.0);
  }
  config.docks = std::min(config.docks, static_cast<int>(lanes));
  config.walls = std::min(config.walls, static_cast<int>(lanes) - 1);
  for (int* count : {&config.forklifts, &config.pallet_robots, &config.walking_workers,
                     &config.standing_workers})
    *count = share < 0.5 ? 0 : std::min(300, static_cast<int>(0.7 * share * *count + 0.5));
  return config;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (std::uint64_t seed = 0; seed < 240; ++seed) {
    const Preset& known = presets()[seed % presets().size()];
    const std::uint64_t round = seed / presets().size();
    LayoutConfig config = known.config;
    if (round % 8 == 1) config = sized(config, 10.0, 10.0);
    if (round % 8 == 2) config = sized(config, 61.7, 33.3);
    if (round == 3) config = sized(config, 120.0, 90.0);
    if (round == 4) config = sized(config, 300.0, 300.0);
    all.push_back({known.name + " " + std::to_string(seed), config, seed});
  }
  return all;
}

WorldDescription built(const Case& one) { return layout(one.name, one.config, one.seed); }

// ---- Exact overlap of what layouts are made of: upright boxes, cylinders and spheres.

struct Body {
  std::size_t thing;
  double bottom, top;  ///< m
  Polygon corners;     ///< of a box
  Eigen::Vector2d centre;
  double radius;  ///< m, of a cylinder or sphere; 0 for a box
  [[nodiscard]] Eigen::AlignedBox2d bounds() const {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : corners) box.extend(corner);
    const Eigen::Vector2d reach(radius, radius);
    if (corners.empty()) box.extend(centre - reach).extend(centre + reach);
    return box;
  }
  /// m, from a point to its rim; less than 0 within what is round.
  [[nodiscard]] double away(const Eigen::Vector2d& point) const {
    return radius > 0.0 ? (point - centre).norm() - radius : distance(point, corners);
  }
};

Body body(std::size_t index, const Thing& thing, const Shape& shape) {
  const Eigen::Isometry3d pose = thing.pose * shape.pose;
  Body result{index, 0.0, 0.0, {}, pose.translation().head<2>(), 0.0};
  double half = 0.0;
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    half = box->size.z() / 2.0;
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      result.corners.emplace_back(
          (pose * Eigen::Vector3d(x * box->size.x(), y * box->size.y(), 0.0)).head<2>());
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    half = cylinder->length / 2.0;
    result.radius = cylinder->radius;
  } else {
    half = result.radius = std::get<Sphere>(shape.geometry).radius;
  }
  result.bottom = pose.translation().z() - half;
  result.top = pose.translation().z() + half;
  return result;
}

/// By more than a micrometre.
bool overlap(const Body& a, const Body& b) {
  constexpr double kTouch = 1e-6;
  if (a.top < b.bottom + kTouch || b.top < a.bottom + kTouch) return false;
  if (a.radius > 0.0) return b.away(a.centre) < a.radius - kTouch;
  if (b.radius > 0.0) return a.away(b.centre) < b.radius - kTouch;
  Polygon inner = a.corners;
  for (Eigen::Vector2d& corner : inner) corner += 2.0 * kTouch * (a.centre - corner).normalized();
  return navvi_sim::overlap(inner, b.corners, 0.0);
}

std::vector<Body> bodies(const WorldDescription& world) {
  std::vector<Body> all;
  for (std::size_t i = 0; i < world.things.size(); ++i)
    if (world.things[i].thing_class != ThingClass::floor)
      for (const Shape& shape : world.things[i].shapes)
        all.push_back(body(i, world.things[i], shape));
  std::sort(all.begin(), all.end(), [](const Body& a, const Body& b) {
    return a.bounds().min().x() < b.bounds().min().x();
  });
  return all;
}

/// Calls `visit` with each pair of bodies of different things whose bounds meet, from west to east.
template <typename Visit>
void for_each_near_pair(const std::vector<Body>& sorted, const Visit& visit) {
  std::vector<Eigen::AlignedBox2d> bounds;
  double widest = 0.0;
  for (const Body& one : sorted) {
    bounds.push_back(one.bounds());
    widest = std::max(widest, bounds.back().sizes().x());
  }
  // Rows of 8 m, so that a large hall is not swept from wall to wall.
  std::map<long, std::vector<std::size_t>> rows;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (auto row = std::lround(std::floor(bounds[i].min().y() / 8.0));
         static_cast<double>(row) * 8.0 <= bounds[i].max().y(); ++row)
      rows[row].push_back(i);
  for (const auto& [row, members] : rows)
    for (std::size_t i = 0; i < members.size(); ++i)
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        if (bounds[members[j]].min().x() > bounds[members[i]].max().x()) break;
        if (sorted[members[i]].thing != sorted[members[j]].thing &&
            bounds[members[i]].intersects(bounds[members[j]]))
          visit(sorted[members[i]], sorted[members[j]]);
      }
}

// ---- The ground that routes sweep.

const std::map<ThingClass, std::pair<double, double>> kExtent{
    // half width, turning radius
    {ThingClass::forklift, {0.5, 1.347}},
    {ThingClass::pallet_robot, {0.35, 0.5711}},
    {ThingClass::worker, {0.24, 0.24}}};

/// Whatever a mover touches on its route: a strip along each line, and a disc at each way-point.
std::vector<Body> swept(std::size_t index, const Thing& mover) {
  const auto [half, radius] = kExtent.at(mover.thing_class);
  std::vector<Body> ground;
  const auto& places = mover.route->waypoints;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d from = places[i].at;
    const Eigen::Vector2d to = places[(i + 1) % places.size()].at;
    ground.push_back({index, 0.0, 2.2, {}, from, radius});
    const Eigen::Vector2d along = (to - from).normalized();
    const Eigen::Vector2d side = half * Eigen::Vector2d(-along.y(), along.x());
    ground.push_back({index,
                      0.0,
                      2.2,
                      {from - side, to - side, to + side, from + side},
                      (from + to) / 2.0,
                      0.0});
  }
  return ground;
}

TEST(Layouts, two_hundred_and_forty_are_valid_and_nothing_overlaps_or_stands_outside) {
  for (const Case& one : cases()) {
    const WorldDescription world = built(one);
    ASSERT_NO_THROW(validate(world)) << one.name;
    for_each_near_pair(bodies(world), [&](const Body& a, const Body& b) {
      ASSERT_FALSE(overlap(a, b)) << world.things[a.thing].name << " and "
                                  << world.things[b.thing].name << " in " << one.name << " at "
                                  << a.centre.transpose();
    });
    const Eigen::Vector2d half(one.config.length / 2.0 + 1e-6, one.config.width / 2.0 + 1e-6);
    const Eigen::AlignedBox2d hall(-half, half);
    for (const Body& inner : bodies(world)) {
      const std::string& name = world.things[inner.thing].name;
      const bool is_hall = name.rfind("wall_", 0) == 0 || name.rfind("dock_door", 0) == 0;
      ASSERT_TRUE((is_hall && name.rfind("wall_inner", 0) != 0) || hall.contains(inner.bounds()))
          << name << " in " << one.name;
    }
  }
}

TEST(Layouts, of_two_hundred_and_forty_no_route_touches_what_stands_or_where_another_waits) {
  for (const Case& one : cases()) {
    const WorldDescription world = built(one);
    std::vector<Body> all;
    for (std::size_t i = 0; i < world.things.size(); ++i) {
      const Thing& thing = world.things[i];
      if (thing.thing_class == ThingClass::floor) continue;
      if (thing.route) {
        for (Body& ground : swept(i, thing)) all.push_back(std::move(ground));
      } else {
        for (const Shape& shape : thing.shapes) all.push_back(body(i, thing, shape));
      }
    }
    std::sort(all.begin(), all.end(), [](const Body& a, const Body& b) {
      return a.bounds().min().x() < b.bounds().min().x();
    });
    for_each_near_pair(all, [&](const Body& a, const Body& b) {
      const Thing& thing_a = world.things[a.thing];
      const Thing& thing_b = world.things[b.thing];
      const auto is_start = [](const Thing& thing, const Body& ground) {
        return thing.route && ground.radius > 0.0 &&
               ground.centre == thing.pose.translation().head<2>();
      };
      const bool matters = thing_a.route.has_value() != thing_b.route.has_value() ||
                           is_start(thing_a, a) || is_start(thing_b, b);
      ASSERT_FALSE(matters && overlap(a, b))
          << thing_a.name << " and " << thing_b.name << " in " << one.name << " at "
          << a.centre.transpose() << " and " << b.centre.transpose();
    });
  }
}

TEST(Layouts, of_two_hundred_and_forty_every_mover_has_a_lane_with_a_place_to_wait) {
  for (const Case& one : cases())
    ASSERT_NO_THROW(static_cast<void>(traffic::lay_lanes(built(one), {}))) << one.name;
}

TEST(Layouts, of_two_hundred_and_forty_each_has_a_start_connected_to_a_goal) {
  for (const Case& one : cases()) {
    if (one.config.length > 130.0) continue;
    const WorldDescription world = built(one);
    scenario::ScenarioConfig drawing;
    drawing.min_route = 0.4 * one.config.length;
    const occupancy::OccupancyConfig voxels{one.config.length > 50.0 ? 0.2 : 0.1};
    const scenario::StartAndGoal scenario =
        scenario::draw_scenario(world, occupancy::voxels_of(world, voxels), drawing, one.seed);
    EXPECT_GE(scenario.route_length, drawing.min_route) << one.name;
  }
}

TEST(Layouts, of_the_greatest_size_have_a_map_that_navigation_takes_at_the_finest_that_it_needs) {
  LayoutConfig config = *preset("narrow");
  config.length = config.width = 300.0;
  config.aisle = 1.4;
  config.fill = 1.0;
  const occupancy::OccupancyMap map =
      occupancy::occupancy_of(layout("full", config, 1), occupancy::OccupancyConfig{});
  EXPECT_EQ(map.resolution(), 0.05);
  EXPECT_GT(map.stream().size(), 40'000'000U);
  EXPECT_LT(map.stream().size(), 64U * 1024U * 1024U);
}

/// What is driven on, at the robot's height and lower.
void expect_same_floor(const WorldDescription& world, double voxel) {
  const navvi_floor::Voxels boxes = occupancy::voxels_of(world, {voxel});
  const navvi_floor::Voxels tree = occupancy::voxels_of(occupancy::occupancy_of(world, {voxel}));
  EXPECT_FALSE(boxes.boxes.empty());
  for (const double height : {navvi_types::kHeadroom, voxel}) {
    navvi_floor::SurveyConfig how;
    how.robot_height = height;
    const navvi_floor::MapSurvey one = navvi_floor::survey_map(boxes, how);
    const navvi_floor::MapSurvey other = navvi_floor::survey_map(tree, how);
    EXPECT_EQ(one.error, other.error);
    EXPECT_EQ(one.levels, other.levels);
    EXPECT_EQ(one.floor_height, other.floor_height);
    EXPECT_TRUE(one.low.x == other.low.x && one.low.y == other.low.y);
    EXPECT_TRUE(one.ground == other.ground);
  }
}

TEST(Layouts, show_the_same_floor_by_their_boxes_as_by_their_map) {
  for (const Preset& known : presets())
    for (std::uint64_t seed = 0; seed < 5; ++seed)
      expect_same_floor(layout(known.name, known.config, seed), 0.05);
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    if (one.config.length <= 50.0) expect_same_floor(built(one), 0.1);
  }
}

TEST(Layouts, of_every_preset_cut_no_place_off_where_the_robot_has_room) {
  for (const Preset& known : presets())
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const navvi_floor::Voxels voxels = occupancy::voxels_of(
          layout(known.name, known.config, seed), occupancy::OccupancyConfig{0.1});
      constexpr double kRoom = 0.5;  // m: the robot's radius and a margin
      const scenario::FloorWays grid(
          scenario::floor_of(voxels, 0.0, navvi_types::kHeadroom, kRoom));
      const scenario::FloorWays::Cells free = grid.cells_clear_by(kRoom);
      ASSERT_FALSE(free.empty());
      const scenario::FloorWays::Ways ways = grid.ways_from(free.front(), kRoom);
      for (const std::size_t cell : free)
        ASSERT_TRUE(std::isfinite(ways.length[cell]))
            << grid.centre(cell).transpose() << " in " << known.name << ' ' << seed;
    }
}

TEST(Layouts, live_for_two_minutes_in_which_all_that_moves_gets_on_and_enters_nothing) {
  for (const Preset& known : presets())
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const WorldDescription description = layout(known.name, known.config, seed);
      std::vector<Body> standing;
      for (const Body& one : bodies(description))
        if (!description.things[one.thing].route) standing.push_back(one);
      const scenario::StartAndGoal scenario = scenario::draw_scenario(
          description, occupancy::voxels_of(description, occupancy::OccupancyConfig{0.1}), {},
          seed);
      live::World world(description, {}, scenario.start, seed);
      std::vector<double> way(world.now().movers.size(), 0.0);
      for (int step = 0; step < 12000; ++step) {
        ASSERT_EQ(world.step({}), live::World::Status::running);
        for (std::size_t i = 0; i < way.size(); ++i)
          way[i] += 0.01 * world.now().movers[i].thing.velocity.norm();
        if (step % 100 != 0) continue;
        for (const MoverState& mover : world.now().movers) {
          Thing thing = description.things[mover.thing.id];
          thing.pose = mover.pose;
          for (const Shape& shape : thing.shapes) {
            const Body part = body(mover.thing.id, thing, shape);
            const Eigen::AlignedBox2d bounds = part.bounds();
            for (const Body& other : standing)
              ASSERT_FALSE(bounds.intersects(other.bounds()) && overlap(part, other))
                  << thing.name << " in " << description.things[other.thing].name << " at "
                  << world.now().time << " s in " << known.name << ' ' << seed;
          }
        }
      }
      for (std::size_t i = 0; i < way.size(); ++i)
        EXPECT_GE(way[i], 10.0) << description.things[world.now().movers[i].thing.id].name << " in "
                                << known.name << ' ' << seed;
    }
}

TEST(Layouts, of_every_preset_start_and_end_a_route_where_no_mover_comes) {
  for (const Preset& known : presets())
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const WorldDescription world = layout(known.name, known.config, seed);
      const scenario::StartAndGoal scenario = scenario::draw_scenario(
          world, occupancy::voxels_of(world, occupancy::OccupancyConfig{0.1}), {}, seed);
      EXPECT_GE(scenario.route_length, 10.0);
      traffic::Traffic traffic(world, {}, seed);
      for (int step = 0; step < 3000; ++step) {
        traffic.step({{1e4, 1e4}, 0.35}, {}, 0.1);
        for (std::size_t i = 0; i < traffic.size(); ++i) {
          const Thing& thing = world.things[traffic.thing(i)];
          const Pose2& place = traffic.mover(i).place();
          const Footprint print = footprint_of(thing, tilt_of(thing.pose));
          for (const Eigen::Vector2d& end : {scenario.start.position, scenario.goal}) {
            const Eigen::Vector2d seen = Eigen::Rotation2Dd(-place.yaw) * (end - place.position);
            if (seen.norm() > print.radius + 0.65) continue;
            ASSERT_GT(distance(seen, print.hull), 0.6)
                << thing.name << " at " << place.position.transpose() << " in " << known.name << ' '
                << seed;
          }
        }
      }
    }
}

TEST(Layouts, are_the_same_for_the_same_seed_and_another_for_another) {
  std::set<std::string> hashes;
  for (const Case& one : cases()) {
    if (one.config.length > 130.0) continue;
    const std::string hash = world_hash(built(one));
    EXPECT_EQ(hash, world_hash(built(one))) << one.name;
    EXPECT_TRUE(hashes.insert(hash).second) << one.name;
    Case other = one;
    other.seed += 1000;
    EXPECT_NE(hash, world_hash(built(other))) << one.name;
  }
}

TEST(Layouts, have_every_number_of_things_that_was_asked_for) {
  for (const Preset& known : presets()) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const WorldDescription world = layout(known.name, known.config, seed);
      std::map<std::string, int> count;
      for (const Thing& thing : world.things) {
        ++count[std::string(to_string(thing.thing_class)) + (thing.route ? " on a route" : "")];
        if (thing.name.rfind("dock_door", 0) == 0) ++count["dock"];
      }
      EXPECT_EQ(count["forklift on a route"], known.config.forklifts);
      EXPECT_EQ(count["pallet_robot on a route"], known.config.pallet_robots);
      EXPECT_EQ(count["worker on a route"], known.config.walking_workers);
      EXPECT_EQ(count["worker"], known.config.standing_workers);
      EXPECT_EQ(count["dock"], known.config.docks);
    }
  }
}

TEST(Layouts, have_room_for_a_thousand_movers) {
  LayoutConfig config = *preset("busy");
  config.length = config.width = 300.0;
  config.bays = 8;
  config.docks = 40;
  config.forklifts = 100;
  config.pallet_robots = 200;
  config.walking_workers = 700;
  const WorldDescription world = layout("thousand", config, 1);
  EXPECT_EQ(std::count_if(world.things.begin(), world.things.end(),
                          [](const Thing& thing) { return thing.route.has_value(); }),
            1000);
  EXPECT_NO_THROW(validate(world));
}

TEST(Layouts, take_rows_blocks_and_bays_as_given) {
  LayoutConfig config = *preset("training");
  config.length = 40.0;
  config.width = 40.0;
  config.rows = 3;
  config.blocks = 2;
  config.bays = 4;
  const WorldDescription world = layout("given", config, 1);
  const auto racks =
      std::count_if(world.things.begin(), world.things.end(),
                    [](const Thing& thing) { return thing.thing_class == ThingClass::shelf; });
  EXPECT_EQ(racks, 3 * 2 * 2);
}

TEST(Layouts, keep_what_one_parameter_draws_when_another_changes) {
  const auto racks = [](const WorldDescription& world) {
    WorldDescription part;
    for (const Thing& thing : world.things)
      if (thing.thing_class == ThingClass::shelf) part.things.push_back(thing);
    return world_hash(part);
  };
  LayoutConfig config;
  const std::string before = racks(layout("a", config, 3));
  config.clutter = 0.3;
  config.walking_workers = 0;
  config.staged = 1.0;
  EXPECT_EQ(racks(layout("a", config, 3)), before);
}

TEST(Layouts, of_every_preset_name_their_places_and_a_robot_can_stand_in_each) {
  for (const Preset& known : presets()) {
    const WorldDescription world = layout(known.name, known.config, 3);
    const navvi_floor::Voxels voxels = occupancy::voxels_of(world, occupancy::OccupancyConfig{0.1});
    const scenario::FloorWays grid(scenario::floor_of(voxels, 0.0, navvi_types::kHeadroom, 0.5));
    const std::vector<Place> places = scenario::free_places_of(world, voxels, {});
    std::map<Place::Kind, int> count;
    for (const Place& place : places) {
      ++count[place.kind];
      EXPECT_TRUE(place.area.contains(place.at)) << known.name;
      EXPECT_GE(grid.clearance(grid.cell_at(place.at)), 0.5) << known.name;
    }
    EXPECT_EQ(count[Place::Kind::dock], known.config.docks) << known.name;
    EXPECT_GE(count[Place::Kind::aisle], 2) << known.name;
    EXPECT_GE(count[Place::Kind::cross_aisle], 2) << known.name;
    EXPECT_EQ(count[Place::Kind::room], known.config.walls > 0 ? known.config.walls + 1 : 0);
  }
}

}  // namespace
}  // namespace navvi_sim::generate
