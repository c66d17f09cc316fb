#include "read/yaml_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "generate/layout_config.hpp"
#include "navvi_sim/read/world_source.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

class YamlWorld : public testing::Test {
 protected:
  YamlWorld() {
    std::string pattern = (fs::temp_directory_path() / "navvi_yaml_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~YamlWorld() override { fs::remove_all(folder_); }

  std::string write(const std::string& text) const {
    std::ofstream(folder_ / "a.yaml") << text;
    return (folder_ / "a.yaml").string();
  }
  std::string sentence_of(const std::string& text) const {
    try {
      static_cast<void>(load_world(write(text), "", 1, {}));
    } catch (const WorldError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

constexpr const char* kGood = R"(name: room
things:
  - name: ground
    class: floor
    shapes: [{box: [8, 6, 0.1], pose: [0, 0, -0.05]}]
  - name: mover
    class: worker
    pose: [1, 2, 0, 0, 0, 1.5]
    shapes:
      - {cylinder: [0.24, 1.5], pose: [0, 0, 0.75]}
      - {sphere: 0.15, pose: [0, 0, 1.6]}
    route: {waypoints: [[1, 2], {at: [1, -2], pause: 4, speed: 0.2}],
            speed: 0.5, pause: 1.5, loop: false, delay: 3, yields: false}
)";

TEST_F(YamlWorld, has_every_number_where_it_was_written) {
  const WorldDescription world = read_yaml_world(write(kGood));
  EXPECT_EQ(world.name, "room");
  EXPECT_EQ(world.floor_height, 0.0);
  ASSERT_EQ(world.things.size(), 2U);
  EXPECT_EQ(world.things[0].thing_class, ThingClass::floor);
  EXPECT_EQ(std::get<Box>(world.things[0].shapes[0].geometry).size, Eigen::Vector3d(8, 6, 0.1));
  const Thing& mover = world.things[1];
  EXPECT_EQ(mover.pose.translation(), Eigen::Vector3d(1, 2, 0));
  EXPECT_NEAR(mover.pose.linear()(1, 0), std::sin(1.5), 1e-12);
  EXPECT_EQ(std::get<Cylinder>(mover.shapes[0].geometry).length, 1.5);
  EXPECT_EQ(std::get<Sphere>(mover.shapes[1].geometry).radius, 0.15);
  ASSERT_TRUE(mover.route.has_value());
  EXPECT_EQ(mover.route->waypoints[1].at, Eigen::Vector2d(1, -2));
  EXPECT_EQ(mover.route->speed, 0.5);
  EXPECT_EQ(mover.route->waypoints[0].pause, 1.5);
  EXPECT_EQ(mover.route->waypoints[0].speed, 0.0);
  EXPECT_EQ(mover.route->waypoints[1].pause, 4.0);
  EXPECT_EQ(mover.route->waypoints[1].speed, 0.2);
  EXPECT_FALSE(mover.route->loop);
  EXPECT_EQ(mover.route->delay, 3.0);
  EXPECT_FALSE(mover.route->yields);
}

TEST_F(YamlWorld, is_refused_with_file_and_line) {
  const std::vector<std::pair<std::string, std::string>> changes{
      {"name: room", "nam: room"},
      {"name: room", "name: room\nname: hall"},
      {"name: room", "name: [a]"},
      {"name: room", "name: room\nfloor_height: .nan"},
      {"things:", "stuff:"},
      {"class: floor", "class: carpet"},
      {"class: worker", "kind: worker"},
      {"[8, 6, 0.1]", "[8, 6]"},
      {"[8, 6, 0.1]", "[8, 6, low]"},
      {"[8, 6, 0.1]", "[8, 6, .inf]"},
      {"{sphere: 0.15,", "{ball: 0.15,"},
      {"{sphere: 0.15,", "{sphere: 0.15, box: [1, 1, 1],"},
      {"{sphere: 0.15,", "{sphere: [0.15],"},
      {"[1, 2, 0, 0, 0, 1.5]", "[1, 2, 0, 0]"},
      {"[1, 2], {at: [1, -2]", "1, {at: 3"},
      {"speed: 0.5", "speed: fast"},
      {"speed: 0.5", "haste: 0.5"},
      {"{at: [1, -2]", "{to: [1, -2]"},
      {"loop: false", "loop: never"},
      {"delay: 3", "delay: [3]"},
  };
  for (const auto& [from, to] : changes) {
    std::string text = kGood;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const std::string sentence = sentence_of(text);
    EXPECT_NE(sentence.find("a.yaml"), std::string::npos) << to << ": " << sentence;
    EXPECT_NE(sentence.find("line"), std::string::npos) << to << ": " << sentence;
  }
}

TEST_F(YamlWorld, is_refused_when_it_is_no_world) {
  for (const char* text : {"", "a", "[1, 2]", "name: a", "name: a\nthings: []",
                           "name: a\nthings: 3", "\tname: a", "name: 'a", "things:\n  - 3", "{{{"})
    EXPECT_NE(sentence_of(text), "") << text;
}

TEST_F(YamlWorld, is_held_to_the_limits_of_every_world) {
  std::string text = kGood;
  text.replace(text.find("[8, 6, 0.1]"), 11, "[8, 0, 0.1]");
  EXPECT_NE(sentence_of(text).find("'ground'"), std::string::npos) << sentence_of(text);
}

TEST(WorldSource, takes_every_world_that_ships) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(NAVVI_SIM_DIR) / "worlds")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_NO_THROW(static_cast<void>(load_world(entry.path().string(), "", 1, {})))
        << entry.path();
  }
  EXPECT_GE(files, 2);
}

TEST(WorldSource, knows_presets_by_name_and_nothing_else) {
  for (const generate::Preset& known : generate::presets())
    EXPECT_EQ(load_world(known.name, "", 3, {}).world.name, known.name);
  for (const char* spec : {"", "Warehouse", "office", "a.txt", "/", "missing.yaml", "missing.sdf"})
    EXPECT_THROW(static_cast<void>(load_world(spec, "", 3, {})), WorldError) << spec;
}

TEST(WorldSource, splits_folders_at_colons) {
  EXPECT_TRUE(folders("").empty());
  EXPECT_EQ(folders("/::/tmp:").size(), 2U);
}

}  // namespace
}  // namespace navvi_sim::read
