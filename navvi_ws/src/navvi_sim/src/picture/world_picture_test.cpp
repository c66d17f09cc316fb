#include "picture/world_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "generate/layout.hpp"

namespace navvi_sim::picture {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++found;
  return found;
}

scenario::StartAndGoal somewhere() {
  return {{{1.0, 2.0}, 0.5}, {4.0, 2.0}, 3.0, {{1.0, 2.0}, {4.0, 2.0}}};
}

TEST(WorldPicture, names_the_world_its_classes_start_goal_and_scale) {
  const WorldDescription world = generate::layout("my hall", generate::LayoutConfig{}, 1);
  const std::string svg = world_picture(world, somewhere(), "seed 1");
  for (const char* word : {"<svg", "my hall", "seed 1", ">start<", ">goal<", ">5 m<", "shelf (",
                           "forklift (1, 1 moving", "pallet robot (", "worker (", "dock door",
                           "route, and a stop", "a way with room", "</svg>"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  EXPECT_EQ(count(svg, "<svg"), 1u);
  EXPECT_EQ(count(svg, "data-area=\""), 1u);
}

TEST(WorldPicture, draws_the_guide_path_and_its_turns_instead_of_its_own_way) {
  const WorldDescription world = generate::layout("my hall", generate::LayoutConfig{}, 1);
  const std::string without = world_picture(world, somewhere(), "");
  const std::string svg =
      world_picture(world, somewhere(), "", {{{1.0, 2.0}, {2.0, 3.0}, {4.0, 2.0}}, {{2.0, 3.0}}});
  const std::string turn = "r=\"5\" fill=\"#ffffff\" stroke=\"#9b00d3\"";
  EXPECT_EQ(count(without, turn), 0u);
  EXPECT_EQ(count(svg, turn), 2u);  // on the map and in the legend
  EXPECT_EQ(svg.find("a way with room"), std::string::npos);
  EXPECT_NE(svg.find("guide path, and a turn"), std::string::npos);
  EXPECT_EQ(count(svg, "<path"), count(without, "<path"));
}

TEST(WorldPicture, draws_every_standing_thing_in_the_colour_of_its_class) {
  WorldDescription world;
  world.name = "two";
  for (const double x : {-3.0, 3.0}) {
    Thing thing;
    thing.name = x < 0 ? "a" : "b";
    thing.thing_class = x < 0 ? ThingClass::shelf : ThingClass::box;
    thing.pose.translation().x() = x;
    thing.shapes.push_back({Box{{1.0, 1.0, 1.0}}});
    world.things.push_back(thing);
  }
  const std::string svg = world_picture(world, std::nullopt, "");
  EXPECT_EQ(count(svg, "fill=\"#7d9bbd\""), 2u);  // in the map and in the legend
  EXPECT_EQ(count(svg, "fill=\"#f2cf3b\""), 2u);
  EXPECT_EQ(svg.find("goal"), std::string::npos);
}

TEST(WorldPicture, leaves_out_what_a_shelf_covers) {
  generate::LayoutConfig empty, full;
  empty.fill = 0.0;
  full.fill = 1.0;
  EXPECT_EQ(count(world_picture(generate::layout("a", empty, 1), std::nullopt, ""), "<path"),
            count(world_picture(generate::layout("a", full, 1), std::nullopt, ""), "<path"));
}

Thing box(const std::string& name, ThingClass thing_class, const Eigen::Vector3d& centre,
          const Eigen::Vector3d& size) {
  Thing thing;
  thing.name = name;
  thing.thing_class = thing_class;
  thing.pose.translation() = centre;
  thing.shapes = {{Box{size}}};
  return thing;
}

TEST(WorldPicture, shows_what_hangs_by_its_outline_alone) {
  auto house = std::make_shared<Mesh>();  // floor, half a wall, and a roof
  house->vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 3}, {4, 0, 3}, {0, 4, 3}};
  house->triangles = {{0, 1, 2}, {0, 1, 4}, {3, 4, 5}};
  for (const auto& [x, y] : {std::pair{2.0F, 1.0F}, {2.2F, 1.0F}, {2.1F, 1.2F}})  // and a post
    for (const float z : {0.0F, 2.0F}) house->vertices.emplace_back(x, y, z);
  for (const auto& [a, b] : {std::pair{6U, 8U}, {8U, 10U}, {10U, 6U}}) {
    house->triangles.push_back({a, b, b + 1});
    house->triangles.push_back({a, b + 1, a + 1});
  }
  Thing mesh = box("house", ThingClass::other, {0, 0, 0}, {1, 1, 1});
  mesh.shapes = {{std::shared_ptr<const Mesh>(house)}};
  Thing frame = box("door frame", ThingClass::wall, {0, 8, 1}, {0.2, 0.2, 2.0});
  frame.shapes.push_back(
      {Box{{1.2, 0.2, 0.2}}, Eigen::Isometry3d(Eigen::Translation3d(0, 0.7, 1))});
  const WorldDescription world{
      "roofed",
      0.0,
      {box("ground", ThingClass::floor, {0, 0, -0.5}, {30, 30, 1}),
       box("roof", ThingClass::other, {0, 0, 5}, {20, 20, 0.1}),
       box("mat", ThingClass::other, {3, 3, 0.01}, {1, 1, 0.02}), mesh, frame}};
  const std::string svg = world_picture(world, std::nullopt, "");
  // Roof, the mesh's roof, and the lintel.
  EXPECT_EQ(count(svg, "stroke-dasharray=\"4 4\""), 3u) << svg;
  EXPECT_EQ(count(svg, "fill=\"#d3c8aa\" stroke=\"#6b6350\" stroke-width=\"1"), 1u);
  EXPECT_EQ(count(svg, "evenodd"), 1u);           // both are the mesh's post
  EXPECT_EQ(count(svg, "fill=\"#f4f3ee\""), 3u);  // ground, mat, the mesh's floor
}

TEST(WorldPicture, shows_the_walls_of_a_floor_as_walls_and_whole) {
  Thing office = box("office", ThingClass::floor, {0, 0, 0}, {30, 20, 0.02});
  office.shapes.push_back(
      {Box{{20.0, 0.2, 2.0}}, Eigen::Isometry3d(Eigen::Translation3d(0, 8, 1))});
  const WorldDescription world{"office", 0.01, {office}};
  const std::string svg = world_picture(world, somewhere(), "");
  EXPECT_EQ(count(svg, "fill=\"#4a4a4a\""), 1u);
  const auto height = [](const std::string& of) {
    const std::size_t at = of.find("height=\"");
    return std::stod(of.substr(at + 8));
  };
  office.shapes.pop_back();
  EXPECT_GT(height(svg), height(world_picture({"bare", 0.01, {office}}, somewhere(), "")));
}

TEST(WorldPicture, is_not_shrunk_by_a_thing_that_lies_far_from_all_others) {
  WorldDescription world{
      "far", 0.0, {box("ground", ThingClass::floor, {0, 0, -0.5}, {300, 300, 1})}};
  for (int i = 0; i < 40; ++i)
    world.things.push_back(
        box("near", ThingClass::box, {i % 8 - 4.0, i / 8 - 4.0, 0.5}, {0.3, 0.3, 1}));
  const std::string near = world_picture(world, std::nullopt, "");
  EXPECT_EQ(near.find("beyond"), std::string::npos);
  world.things.push_back(box("far", ThingClass::box, {125, 0, 0.5}, {1, 1, 1}));
  const std::string svg = world_picture(world, std::nullopt, "");
  EXPECT_NE(svg.find("one thing lies beyond the picture"), std::string::npos);
  EXPECT_EQ(svg.substr(0, svg.find('>')), near.substr(0, near.find('>')));
  const scenario::StartAndGoal there{{{0, 0}, 0}, {125, 2}, 0.0, {}};
  EXPECT_EQ(world_picture(world, there, "").find("beyond"), std::string::npos);
}

TEST(WorldPicture, cannot_be_broken_by_a_name) {
  WorldDescription world = generate::layout("<script>&\x01\"", generate::LayoutConfig{}, 1);
  const std::string svg = world_picture(world, std::nullopt, "</svg>");
  EXPECT_EQ(count(svg, "</svg>"), 1u);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  EXPECT_EQ(svg.find('\x01'), std::string::npos);
}

TEST(WorldPicture, shows_meshes_and_things_that_lie_askew) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  mesh->triangles = {{0, 1, 2}, {0, 1, 3}};
  Thing thing;
  thing.name = "odd";
  thing.pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 1, 0).normalized()));
  thing.shapes = {
      {std::shared_ptr<const Mesh>(mesh)}, {Box{{1, 2, 3}}}, {Cylinder{0.2, 2.0}}, {Sphere{0.3}}};
  WorldDescription world{"odd", 0.0, {thing}};
  const std::string svg = world_picture(world, std::nullopt, "");
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find("other (1)"), std::string::npos);
  EXPECT_NO_THROW(static_cast<void>(world_picture({"empty", 0.0, {}}, std::nullopt, "")));
}

}  // namespace
}  // namespace navvi_sim::picture
