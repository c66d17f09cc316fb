#include "navvi_sim/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "description/solid_mesh.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"

namespace navvi_sim::scenario {
namespace {

Thing thing(const std::string& name, ThingClass thing_class, const Eigen::Vector3d& centre,
            const Eigen::Vector3d& size) {
  Thing result;
  result.name = name;
  result.thing_class = thing_class;
  result.pose.translation() = centre;
  result.shapes.push_back({Box{size}, Eigen::Isometry3d::Identity()});
  return result;
}

WorldDescription ground(double length, double width) {
  WorldDescription world;
  world.name = "ground";
  world.things = {thing("ground", ThingClass::floor, {0.0, 0.0, -0.05}, {length, width, 0.1})};
  return world;
}

/// 16 x 8 m of floor, cut in two by a wall at x = 0 with a door of `door` m at its southern end.
WorldDescription two_rooms(double door) {
  WorldDescription world = ground(16.0, 8.0);
  world.things.push_back(
      thing("wall", ThingClass::wall, {0.0, door / 2.0, 1.0}, {0.2, 8.0 - door, 2.0}));
  return world;
}

class ScenarioIn : public testing::Test {
 protected:
  void enter(WorldDescription world) {
    world_ = std::move(world);
    voxels_ = occupancy::voxels_of(world_, occupancy::OccupancyConfig{});
  }
  StartAndGoal draw(std::uint64_t seed, const std::optional<Pose2>& start = std::nullopt,
                    const std::optional<Eigen::Vector2d>& goal = std::nullopt) {
    return draw_scenario(world_, voxels_, ScenarioConfig{}, seed, start, goal);
  }
  WorldDescription world_;
  navvi_floor::Voxels voxels_;
};

TEST_F(ScenarioIn, is_the_same_for_the_same_seed_and_another_for_another) {
  enter(two_rooms(2.0));
  const StartAndGoal one = draw(7);
  const StartAndGoal again = draw(7);
  const StartAndGoal other = draw(8);
  EXPECT_EQ(one.start.position.x(), again.start.position.x());
  EXPECT_EQ(one.start.yaw, again.start.yaw);
  EXPECT_EQ(one.goal, again.goal);
  EXPECT_NE(one.goal, other.goal);
}

TEST_F(ScenarioIn, keeps_clear_of_things_and_goes_far) {
  enter(two_rooms(2.0));
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const StartAndGoal scenario = draw(seed);
    EXPECT_GE(scenario.route_length, 10.0);
    for (const Eigen::Vector2d& place : {scenario.start.position, scenario.goal}) {
      EXPECT_LT(std::abs(place.x()), 8.0 - 0.5 + 0.05);
      EXPECT_LT(std::abs(place.y()), 4.0 - 0.5 + 0.05);
      if (place.y() > -2.0) {
        EXPECT_GT(std::abs(place.x()), 0.1 + 0.5 - 0.05);
      }
    }
  }
}

TEST_F(ScenarioIn, never_leads_through_a_wall) {
  enter(two_rooms(0.0));
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const StartAndGoal scenario = draw(seed);
    EXPECT_GT(scenario.start.position.x() * scenario.goal.x(), 0.0) << "seed " << seed;
  }
}

TEST_F(ScenarioIn, takes_a_given_start_and_goal_as_they_are) {
  enter(two_rooms(2.0));
  const StartAndGoal scenario = draw(1, Pose2{{-5.0, 1.0}, 0.5}, Eigen::Vector2d(5.0, 1.0));
  EXPECT_EQ(scenario.start.yaw, 0.5);
  EXPECT_EQ(scenario.goal, Eigen::Vector2d(5.0, 1.0));
  EXPECT_GT(scenario.route_length, 10.0);
}

TEST_F(ScenarioIn, is_drawn_inside_a_house_and_not_in_the_ring_of_floor_around) {
  WorldDescription world = ground(40.0, 40.0);
  for (const double side : {-1.0, 1.0}) {
    world.things.push_back(thing("a", ThingClass::wall, {0, 4 * side, 1}, {8.2, 0.2, 2.0}));
    world.things.push_back(thing("b", ThingClass::wall, {4 * side, 1, 1}, {0.2, 6.0, 2.0}));
  }
  enter(world);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const StartAndGoal scenario = draw(seed);
    EXPECT_LT(scenario.start.position.cwiseAbs().maxCoeff(), 4.1) << seed;
    EXPECT_LT(scenario.goal.cwiseAbs().maxCoeff(), 4.1) << seed;
    EXPECT_EQ(scenario.note, "");
    EXPECT_LT(draw(seed, Pose2{{-10.0, 0.0}, 0.0}).goal.cwiseAbs().maxCoeff(), 4.1) << seed;
  }
  EXPECT_EQ(draw(1, Pose2{{-10.0, 0.0}, 0.0}).note,
            "the start lies outside of everything that stands in this world");
}

TEST_F(ScenarioIn, is_5_m_long_or_more_beside_a_small_thing_where_the_floor_has_it) {
  WorldDescription world = ground(14.0, 14.0);
  world.things.push_back(thing("can", ThingClass::other, {0, 0, 0.1}, {0.1, 0.1, 0.2}));
  enter(world);
  for (std::uint64_t seed = 0; seed < 20; ++seed) EXPECT_GE(draw(seed).route_length, 5.0) << seed;
  world.things[0] = ground(4.0, 4.0).things[0];
  enter(world);
  EXPECT_NE(draw(1).note.find("too near for a trial"), std::string::npos);
  EXPECT_GE(draw(1).route_length, 1.0);
  world.things[0] = ground(1.3, 1.3).things[0];
  world.things.pop_back();
  enter(world);
  EXPECT_THROW(static_cast<void>(draw(1)), WorldError);
}

TEST_F(ScenarioIn, is_drawn_in_the_furnished_part_of_a_floor_that_is_cut_in_two) {
  WorldDescription world = ground(60.0, 60.0);
  for (const double side : {-1.0, 1.0}) {
    world.things.push_back(thing("a", ThingClass::wall, {0, 6 * side, 1}, {12.2, 0.2, 2.0}));
    world.things.push_back(thing("b", ThingClass::wall, {6 * side, 0, 1}, {0.2, 12.2, 2.0}));
  }
  world.things.push_back(thing("table", ThingClass::other, {2, 1, 0.4}, {1.0, 1.0, 0.8}));
  enter(world);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    EXPECT_LT(draw(seed).start.position.cwiseAbs().maxCoeff(), 6.0) << seed;
    EXPECT_LT(draw(seed).goal.cwiseAbs().maxCoeff(), 6.0) << seed;
  }
}

/// A box from (-x, -y) to (x, y) as a closed mesh of 2 m.
void add_shell(Mesh& mesh, double x, double y) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Mesh shell = prism_mesh({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, 2.0).value();
  mesh.vertices.insert(mesh.vertices.end(), shell.vertices.begin(), shell.vertices.end());
  for (const auto& [a, b, c] : shell.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
}

WorldDescription ground_with(std::shared_ptr<const Mesh> mesh, double yaw) {
  WorldDescription world = ground(14.0, 14.0);
  Thing block = thing("block", ThingClass::other, {0, 0, 0}, {1, 1, 1});
  block.pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  block.shapes[0].geometry = std::move(mesh);
  world.things.push_back(block);
  return world;
}

TEST_F(ScenarioIn, is_not_drawn_inside_of_a_closed_block) {
  const auto inside = [](const Eigen::Vector2d& place, double yaw) {
    return (Eigen::Rotation2Dd(-yaw) * place).cwiseAbs().maxCoeff() < 4.0;
  };
  for (const double yaw : {0.0, 0.3}) {
    auto shell = std::make_shared<Mesh>();
    add_shell(*shell, 4.0, 4.0);
    enter(ground_with(shell, yaw));
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const StartAndGoal scenario = draw(seed);
      EXPECT_FALSE(inside(scenario.start.position, yaw)) << seed << " " << yaw;
      EXPECT_FALSE(inside(scenario.goal, yaw)) << seed << " " << yaw;
    }
    EXPECT_EQ(draw(1, Pose2{{0.0, 0.0}, 0.0}, Eigen::Vector2d(1.0, 0.0)).note,
              "start and goal are 1 m apart, too near for a trial");
  }
}

TEST_F(ScenarioIn, is_drawn_in_a_closed_mesh_that_is_a_room) {
  auto shell = std::make_shared<Mesh>();
  add_shell(*shell, 4.0, 4.0);
  WorldDescription furnished = ground_with(shell, 0.0);
  furnished.things.push_back(thing("table", ThingClass::other, {1.0, 1.0, 0.4}, {1.0, 1.0, 0.8}));
  add_shell(*shell, 5.0, 5.0);  // thick walls
  WorldDescription all_inside = ground_with(shell, 0.0);
  all_inside.things[0] = ground(7.0, 7.0).things[0];
  for (const WorldDescription& world : {furnished, ground_with(shell, 0.0), all_inside}) {
    enter(world);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const StartAndGoal scenario = draw(seed);
      EXPECT_LT(scenario.start.position.cwiseAbs().maxCoeff(), 4.0) << seed;
      EXPECT_EQ(scenario.note, "") << seed;
    }
  }
}

TEST_F(ScenarioIn, is_drawn_in_the_rooms_of_a_house_and_not_in_its_yard) {
  WorldDescription world =
      ground(40.0, 40.0);  // three wings around a yard that is open to the south
  const auto wall = [&](double x, double y, double length, double width) {
    world.things.push_back(thing("w", ThingClass::wall, {x, y, 1}, {length, width, 2.0}));
  };
  wall(0, 10, 20.2, 0.2), wall(0, 6, 12.0, 0.2);
  for (const double side : {-1.0, 1.0})
    wall(10 * side, 0, 0.2, 20.2), wall(6 * side, -2, 0.2, 16.0), wall(8 * side, -10, 4.0, 0.2);
  enter(world);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const StartAndGoal scenario = draw(seed);
    for (const Eigen::Vector2d& place : {scenario.start.position, scenario.goal})
      EXPECT_TRUE(std::abs(place.x()) > 6.0 || place.y() > 6.0) << seed;
  }
}

TEST_F(ScenarioIn, passes_on_a_goal_in_a_wall_and_refuses_a_start_there) {
  enter(two_rooms(2.0));
  EXPECT_EQ(draw(1, Pose2{{-5.0, 1.0}, 0.0}, Eigen::Vector2d(0.0, 1.0)).route_length, 0.0);
  EXPECT_EQ(draw(1, std::nullopt, Eigen::Vector2d(0.0, 1.0)).goal, Eigen::Vector2d(0.0, 1.0));
  for (const Pose2& start :
       {Pose2{{0.0, 1.0}, 0.0}, Pose2{{0.3, 1.0}, 0.0}, Pose2{{50.0, 1.0}, 0.0},
        Pose2{{std::numeric_limits<double>::quiet_NaN(), 0.0}, 0.0},
        Pose2{{-5.0, 0.0}, std::numeric_limits<double>::infinity()}})
    EXPECT_THROW(static_cast<void>(draw(1, start)), WorldError) << start.position.x();
}

TEST_F(ScenarioIn, names_the_thing_that_a_given_start_is_in) {
  WorldDescription world = two_rooms(2.0);
  world.things.push_back(thing("hall", ThingClass::other, {0.0, 0.0, 5.0}, {16.0, 8.0, 0.1}));
  world.things.push_back(thing("crate", ThingClass::box, {4.0, 0.0, 0.5}, {1.0, 1.0, 1.0}));
  enter(std::move(world));
  const auto sentence = [&](double x, double y) -> std::string {
    try {
      static_cast<void>(draw(1, Pose2{{x, y}, 0.0}));
    } catch (const WorldError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(sentence(4.0, 0.0).find("is in 'crate'"), std::string::npos) << sentence(4.0, 0.0);
  EXPECT_NE(sentence(0.0, 2.0).find("is in 'wall'"), std::string::npos) << sentence(0.0, 2.0);
  EXPECT_NE(sentence(30.0, 0.0).find("is off the floor"), std::string::npos);
  EXPECT_NE(sentence(30.0, 0.0).find("free floor, from (-8, -4) to (8, 4)"), std::string::npos)
      << sentence(30.0, 0.0);
}

TEST_F(ScenarioIn, starts_away_from_movers_and_looks_along_its_route) {
  WorldDescription world = two_rooms(2.0);
  Thing mover = thing("mover", ThingClass::forklift, {-4.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  mover.route = Route{{{{-4.0, 0.0}}, {{-4.0, 2.0}}}};
  world.things.push_back(mover);
  enter(world);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const StartAndGoal scenario = draw(seed);
    EXPECT_GE(std::hypot(scenario.start.position.x() + 4.0, scenario.start.position.y()), 2.0);
  }
  const StartAndGoal to_east = draw(3, std::nullopt, Eigen::Vector2d(-1.0, 2.0));
  EXPECT_LT(std::abs(to_east.start.yaw), kPi);
}

Thing shuttle(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Thing mover =
      thing("shuttle", ThingClass::pallet_robot, {from.x(), from.y(), 0.25}, {1.0, 0.8, 0.5});
  mover.route = Route{{{from}, {to}}};
  return mover;
}

TEST_F(ScenarioIn, is_drawn_off_the_lanes_of_what_moves_and_given_anywhere) {
  WorldDescription world = two_rooms(2.0);
  world.things.push_back(shuttle({-7.0, 2.0}, {-1.0, 2.0}));
  enter(world);
  const Eigen::Vector2d on_lane(-4.0, 2.0);
  // Seen from above the shuttle sweeps 0.4 m to each side, 0.64 m where it turns.
  const auto off_lane = [](const Eigen::Vector2d& place) {
    return place.x() > 0.0 || std::abs(place.y() - 2.0) > 0.4 + 0.35 + 0.25;
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const StartAndGoal scenario = draw(seed);
    EXPECT_TRUE(off_lane(scenario.start.position)) << seed;
    EXPECT_TRUE(off_lane(scenario.goal)) << seed;
    EXPECT_GE(scenario.route_length, 10.0);
    EXPECT_TRUE(off_lane(draw(seed, Pose2{{-4.0, 2.0}, 0.0}).goal)) << seed;
    const Pose2 start = draw(seed, std::nullopt, on_lane).start;
    EXPECT_TRUE(off_lane(start.position)) << seed;
  }
  EXPECT_EQ(draw(1, Pose2{{-4.0, 2.0}, 0.0}, on_lane).goal, on_lane);
}

TEST_F(ScenarioIn, is_drawn_on_the_lanes_where_there_is_nothing_else) {
  WorldDescription world = ground(20.0, 2.2);
  world.things.push_back(shuttle({-8.0, 0.0}, {8.0, 0.0}));
  enter(world);
  const StartAndGoal scenario = draw(1);
  EXPECT_GE(scenario.route_length, 10.0);
  EXPECT_GE(std::hypot(scenario.start.position.x() + 8.0, scenario.start.position.y()), 2.0);
}

TEST_F(ScenarioIn, is_refused_where_nothing_is_free) {
  WorldDescription world = ground(2.0, 2.0);
  world.things.push_back(thing("block", ThingClass::box, {0, 0, 0.5}, {1.9, 1.9, 1.0}));
  enter(world);
  EXPECT_THROW(static_cast<void>(draw(1)), WorldError);
}

TEST_F(ScenarioIn, has_the_length_that_was_asked_for) {
  enter(two_rooms(2.0));
  ScenarioConfig config;
  config.min_route = 12.0;
  config.max_route = 14.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const StartAndGoal scenario = draw_scenario(world_, voxels_, config, seed);
    EXPECT_GE(scenario.route_length, 12.0);
    EXPECT_LE(scenario.route_length, 14.0);
    EXPECT_LE((scenario.goal - scenario.start.position).norm(), scenario.route_length + 1e-3);
  }
}

TEST_F(ScenarioIn, is_refused_in_a_sentence_where_no_route_is_as_asked_for) {
  enter(two_rooms(2.0));
  ScenarioConfig too_long, contrary;
  too_long.min_route = 100.0;
  contrary.min_route = 10.0;
  contrary.max_route = 5.0;
  for (const ScenarioConfig& config : {too_long, contrary}) {
    try {
      static_cast<void>(draw_scenario(world_, voxels_, config, 1));
      ADD_FAILURE();
    } catch (const WorldError& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
}

}  // namespace
}  // namespace navvi_sim::scenario
