#include "description/validate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace navvi_sim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const Mesh> triangle(std::uint32_t last, float x) {
  Mesh mesh;
  mesh.vertices = {{x, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
  mesh.triangles = {{0, 1, last}};
  return std::make_shared<const Mesh>(mesh);
}

WorldDescription good_world() {
  WorldDescription world;
  world.name = "good";
  Thing floor;
  floor.name = "floor";
  floor.thing_class = ThingClass::floor;
  floor.shapes.push_back({Box{{2.0, 2.0, 0.1}}, Eigen::Isometry3d::Identity()});
  Thing mover;
  mover.name = "mover";
  mover.thing_class = ThingClass::worker;
  mover.shapes.push_back({Cylinder{0.2, 1.0}, Eigen::Isometry3d::Identity()});
  mover.shapes.push_back({Sphere{0.2}, Eigen::Isometry3d::Identity()});
  mover.shapes.push_back({triangle(2, 0.0F), Eigen::Isometry3d::Identity()});
  mover.route = Route{{{{0.0, 0.0}}, {{1.0, 0.0}}}};
  world.things = {floor, mover};
  return world;
}

using Damage = std::function<void(WorldDescription&)>;

Damage shape(std::size_t thing, std::size_t index, const Geometry& geometry) {
  return [=](WorldDescription& w) { w.things[thing].shapes[index].geometry = geometry; };
}

const std::vector<std::pair<const char*, Damage>>& damages() {
  static const std::vector<std::pair<const char*, Damage>> all{
      {"no things", [](auto& w) { w.things.clear(); }},
      {"no floor", [](auto& w) { w.things[0].thing_class = ThingClass::box; }},
      {"floor height not finite", [](auto& w) { w.floor_height = kNan; }},
      {"empty name", [](auto& w) { w.things[0].name.clear(); }},
      {"same name", [](auto& w) { w.things[1].name = "floor"; }},
      {"no shapes", [](auto& w) { w.things[1].shapes.clear(); }},
      {"position NaN", [](auto& w) { w.things[1].pose.translation().x() = kNan; }},
      {"position infinite", [](auto& w) { w.things[1].pose.translation().z() = kInfinity; }},
      {"position far away", [](auto& w) { w.things[1].pose.translation().y() = 1e6; }},
      {"rotation that scales", [](auto& w) { w.things[1].pose.linear() *= 2.0; }},
      {"rotation that mirrors", [](auto& w) { w.things[1].pose.linear().col(0) *= -1.0; }},
      {"shape's rotation NaN", [](auto& w) { w.things[1].shapes[0].pose.linear()(0, 0) = kNan; }},
      {"box size 0", shape(0, 0, Box{{1.0, 0.0, 1.0}})},
      {"box size NaN", shape(0, 0, Box{{1.0, kNan, 1.0}})},
      {"box of 1 km", shape(0, 0, Box{{1000.0, 1.0, 1.0}})},
      {"radius negative", shape(1, 0, Cylinder{-0.1, 1.0})},
      {"length infinite", shape(1, 0, Cylinder{0.1, kInfinity})},
      {"sphere of nothing", shape(1, 1, Sphere{0.0})},
      {"mesh index too high", shape(1, 2, triangle(3, 0.0F))},
      {"mesh vertex NaN", shape(1, 2, triangle(2, std::nanf("")))},
      {"no mesh", shape(1, 2, std::shared_ptr<const Mesh>())},
      {"route of one way-point", [](auto& w) { w.things[1].route->waypoints.pop_back(); }},
      {"route to nowhere",
       [](auto& w) { w.things[1].route->waypoints[1].at = w.things[1].route->waypoints[0].at; }},
      {"way-point's pause", [](auto& w) { w.things[1].route->waypoints[1].pause = -1.0; }},
      {"way-point's speed", [](auto& w) { w.things[1].route->waypoints[1].speed = kNan; }},
      {"route's delay", [](auto& w) { w.things[1].route->delay = 1e9; }},
      {"way-point NaN", [](auto& w) { w.things[1].route->waypoints[1].at.x() = kNan; }},
      {"speed 0", [](auto& w) { w.things[1].route->speed = 0.0; }},
      {"speed too high", [](auto& w) { w.things[1].route->speed = 100.0; }},
      {"floor on a route", [](auto& w) { w.things[0].route = w.things[1].route; }},
  };
  return all;
}

TEST(Validate, takes_a_good_world) { EXPECT_NO_THROW(validate(good_world())); }

TEST(Validate, refuses_each_damage_with_a_sentence_on_what_is_allowed) {
  for (const auto& [name, damage] : damages()) {
    WorldDescription world = good_world();
    damage(world);
    try {
      validate(world);
      ADD_FAILURE() << name << " was taken";
    } catch (const WorldError& error) {
      EXPECT_GT(std::string(error.what()).size(), 20U) << name;
      EXPECT_NE(std::string(error.what()).find('\''), std::string::npos) << error.what();
    }
  }
}

TEST(WorldHash, changes_with_any_number_and_only_then) {
  const std::string hash = world_hash(good_world());
  EXPECT_EQ(hash.size(), 16U);
  EXPECT_EQ(world_hash(good_world()), hash);
  const std::vector<Damage> changes{
      [](auto& w) { w.floor_height = 1e-9; },
      [](auto& w) { w.things[1].name = "other"; },
      [](auto& w) { w.things[1].pose.translation().x() += 1e-12; },
      [](auto& w) { w.things[1].thing_class = ThingClass::box; },
      [](auto& w) { w.things[1].route->speed = 1.1; },
      [](auto& w) { w.things[1].route.reset(); },
      shape(1, 2, triangle(2, 0.5F)),
      shape(1, 1, Sphere{0.21}),
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    WorldDescription world = good_world();
    changes[i](world);
    EXPECT_NE(world_hash(world), hash) << "change " << i;
  }
}

}  // namespace
}  // namespace navvi_sim
