#include "read/sdf_writer.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "generate/layout.hpp"
#include "navvi_sim/read/world_source.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

class SdfWriter : public testing::Test {
 protected:
  SdfWriter() {
    std::string pattern = (fs::temp_directory_path() / "navvi_sdf_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~SdfWriter() override { fs::remove_all(folder_); }

  LoadedWorld read(const std::string& text) const {
    const fs::path file = folder_ / "a.sdf";
    std::ofstream(file) << text;
    return load_world({file.string()});
  }

  fs::path folder_;
};

void expect_same(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const std::string& who) {
  EXPECT_LT((a.matrix() - b.matrix()).cwiseAbs().maxCoeff(), 1e-9) << who;
}

void expect_same(const Route& a, const Route& b, const std::string& who) {
  ASSERT_EQ(a.waypoints.size(), b.waypoints.size()) << who;
  for (std::size_t i = 0; i < a.waypoints.size(); ++i) {
    EXPECT_EQ(a.waypoints[i].at, b.waypoints[i].at) << who;
    EXPECT_EQ(a.waypoints[i].pause, b.waypoints[i].pause) << who;
    EXPECT_EQ(a.waypoints[i].speed, b.waypoints[i].speed) << who;
  }
  EXPECT_EQ(a.speed, b.speed) << who;
  EXPECT_EQ(a.loop, b.loop) << who;
  EXPECT_EQ(a.delay, b.delay) << who;
  EXPECT_EQ(a.yields, b.yields) << who;
}

void expect_same(const Geometry& a, const Geometry& b, const std::string& who) {
  ASSERT_EQ(a.index(), b.index()) << who;
  if (const auto* box = std::get_if<Box>(&a)) {
    EXPECT_EQ(box->size, std::get<Box>(b).size) << who;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&a)) {
    EXPECT_EQ(cylinder->radius, std::get<Cylinder>(b).radius) << who;
    EXPECT_EQ(cylinder->length, std::get<Cylinder>(b).length) << who;
  } else {
    EXPECT_EQ(std::get<Sphere>(a).radius, std::get<Sphere>(b).radius) << who;
  }
}

void expect_same(const WorldDescription& a, const WorldDescription& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_NEAR(a.floor_height, b.floor_height, 1e-9);
  ASSERT_EQ(a.things.size(), b.things.size());
  for (std::size_t i = 0; i < a.things.size(); ++i) {
    const Thing& one = a.things[i];
    const Thing& other = b.things[i];
    EXPECT_EQ(one.name, other.name);
    EXPECT_EQ(one.thing_class, other.thing_class) << one.name;
    expect_same(one.pose, other.pose, one.name);
    ASSERT_EQ(one.shapes.size(), other.shapes.size()) << one.name;
    for (std::size_t k = 0; k < one.shapes.size(); ++k) {
      expect_same(one.shapes[k].geometry, other.shapes[k].geometry, one.name);
      expect_same(one.shapes[k].pose, other.shapes[k].pose, one.name);
      EXPECT_EQ(one.shapes[k].look, other.shapes[k].look) << one.name;
    }
    ASSERT_EQ(one.route.has_value(), other.route.has_value()) << one.name;
    if (one.route) expect_same(*one.route, *other.route, one.name);
  }
}

TEST_F(SdfWriter, writes_every_layout_so_that_it_reads_back_the_same) {
  for (const generate::Preset& known : generate::presets())
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const WorldDescription world = generate::layout(known.name, known.config, seed);
      const LoadedWorld back = read(to_sdf(world));
      expect_same(world, back.world);
      for (const std::string& note : back.notes)
        EXPECT_NE(note.find("light"), std::string::npos) << note;
    }
}

TEST_F(SdfWriter, writes_a_world_from_a_file) {
  const fs::path file = fs::path(NAVVI_SIM_DIR) / "worlds/crossing.sdf";
  const WorldDescription world = load_world({file.string(), "", 2}).world;
  expect_same(world, read(to_sdf(world)).world);
}

TEST_F(SdfWriter, keeps_odd_names_poses_and_routes) {
  WorldDescription world = generate::layout("a <b> & \"c\"", *generate::preset("training"), 1);
  for (int i = 0; i < 12; ++i) {
    Thing thing;
    thing.name = "wall & <" + std::to_string(i) + ">";  // by its name it would be a wall
    thing.thing_class = ThingClass::worker;
    thing.pose.translation() = Eigen::Vector3d(0.1 * i, 1e-7, 1.0 / 3.0);
    // Straight up and straight down, where roll and yaw are one, come round as well.
    thing.pose.rotate(Eigen::AngleAxisd(i * kPi / 6.0, Eigen::Vector3d::UnitY()) *
                      Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d(1, 2, 3).normalized()));
    Eigen::Isometry3d askew = thing.pose;
    askew.translation() = Eigen::Vector3d(0.0, 0.1, 0.0);
    thing.shapes = {{Sphere{0.1 + 0.01 * i}, askew, ThingClass::box}};
    world.things.push_back(thing);
  }
  Thing drone;  // over everything, so that nothing is in its way
  drone.name = "drone";
  drone.pose.translation() = Eigen::Vector3d(1.0, 2.0, 9.0);
  drone.shapes = {{Sphere{0.2}}};
  drone.route = Route{{{{1.0, 2.0}, 0.5, 0.25}, {{-1.0, 2.0}, 0.0, 0.0}}, 0.7, false, 3.0, false};
  world.things.push_back(drone);
  expect_same(world, read(to_sdf(world)).world);
}

TEST_F(SdfWriter, refuses_a_world_with_a_mesh_and_names_the_thing) {
  WorldDescription world = generate::layout("a", *generate::preset("training"), 1);
  world.things.back().shapes.front().geometry = std::make_shared<const Mesh>();
  try {
    static_cast<void>(to_sdf(world));
    ADD_FAILURE();
  } catch (const WorldError& error) {
    EXPECT_NE(std::string(error.what()).find(world.things.back().name), std::string::npos);
  }
}

TEST_F(SdfWriter, is_read_with_care_for_its_own_elements) {
  generate::LayoutConfig config = *generate::preset("training");
  config.walking_workers = 1;
  const std::string good = to_sdf(generate::layout("a", config, 1));
  const std::vector<std::pair<std::string, std::string>> changes{
      {"<navvi:class>worker<", "<navvi:class>ghost<"},
      {"<navvi:class>worker<", "<navvi:class><"},
      {"loop=\"true\"", "loop=\"maybe\""},
      {"loop=\"true\"", ""},
      {"delay=\"0\"", "delay=\"nan\""},
      {"speed=\"0.8\"", "speed=\"fast\""},
      {"yields=\"true\"", "yields=\"true\" haste=\"1\""},
      {"<navvi:waypoint pause=\"4\"", "<navvi:waypoint pause=\"inf\""},
      {"<navvi:waypoint pause=\"4\"", "<navvi:point pause=\"4\""},
  };
  for (const auto& [from, to] : changes) {
    std::string text = good;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    if (to.find("<navvi:point") == 0)
      text.replace(text.find("</navvi:waypoint>"), 17, "</navvi:point>");
    try {
      static_cast<void>(read(text));
      ADD_FAILURE() << to;
    } catch (const WorldError& error) {
      const std::string sentence = error.what();
      EXPECT_NE(sentence.find("a.sdf, line "), std::string::npos) << to << ": " << sentence;
    }
  }
}

}  // namespace
}  // namespace navvi_sim::read
