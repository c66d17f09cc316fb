#include <gtest/gtest.h>

#include "small_world.hpp"
#include "temp_folder.hpp"

namespace navvi_nav::tool {
namespace {

using navvi_test::Answer;

/// Two rooms, of which the left one has a box in its middle.
class NavmeshTool : public testing::Test {
 protected:
  NavmeshTool() {
    SmallWorld world;
    world.room(10, 6).box(7, 0, 0, 7.1, 6, 1).box(3, 2, 0, 4, 4, 1);
    octomap::OcTree tree = world.tree();
    tree.writeBinary(path("map.bt"));
  }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  static Answer ask(const std::string& words) {
    return navvi_test::run(std::string(NAVMESH_TOOL) + " " + words);
  }

 private:
  navvi_test::TempFolder folder_;
};

TEST_F(NavmeshTool, prints_a_mesh_and_what_is_drawn_of_it) {
  const Answer answer = ask(path("map.bt") + " drawing:=true 'cylinders:=[5.5,3,0.4]'");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_EQ(answer.text.rfind("{\"map\": ", 0), 0U) << answer.text;
  EXPECT_NE(answer.text.find("\"components\": 2, "), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("\"ground\": [\""), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("....##....."), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("\"mesh\": [[0, [["), std::string::npos) << answer.text;
  const Answer map = ask(path("map.bt") + " drawing:=true stage:=map");
  EXPECT_NE(map.text.find("\"mesh\": []"), std::string::npos) << map.text;
}

TEST_F(NavmeshTool, answers_a_query_and_says_why_it_cannot) {
  const Answer found = ask(path("map.bt") + " 'from:=[1,1]' 'to:=[6,1]'");
  EXPECT_EQ(found.code, 0) << found.text;
  EXPECT_NE(found.text.find("\"shortest way m\": 5.000000, \"guide path m\": 5.000, \"path\": "
                            "[[1.00, 1.00], "),
            std::string::npos)
      << found.text;
  const Answer apart = ask(path("map.bt") + " 'from:=[1,3]' 'to:=[8,3]'");
  EXPECT_EQ(apart.code, 1);
  EXPECT_NE(apart.text.find("\"refusal\": \"no floor joins the goal with the robot"),
            std::string::npos)
      << apart.text;
}

TEST_F(NavmeshTool, refuses_several_goals_where_one_cannot_be_reached) {
  const Answer found = ask(path("map.bt") + " 'from:=[1,1]' 'to:=[6,1,2,1]'");
  EXPECT_NE(found.text.find("\"shortest way m\": 5.000000"), std::string::npos) << found.text;
  const Answer apart = ask(path("map.bt") + " 'from:=[1,1]' 'to:=[6,1,8,3,2,1]'");
  EXPECT_EQ(apart.code, 1);
  EXPECT_NE(apart.text.find("\"refused m\": [8.000000, 3.000000]"), std::string::npos)
      << apart.text;
}

TEST_F(NavmeshTool, refuses_what_it_cannot_do_in_a_sentence) {
  std::ofstream(path("bad.yaml")) << "colour: red\n";
  for (const std::string& words :
       {std::string(), path("none.bt"), path("map.svg"), path("map.bt") + " 'from:=[1,2]'",
        path("map.bt") + " 'from:=[1]' 'to:=[2]'", path("map.bt") + " 'from:=[1,1]' 'to:=[2,1,3]'",
        path("map.bt") + " 'cylinders:=[1,2,-1]'", path("map.bt") + " 'cylinders:=[1,2]'",
        path("map.bt") + " 'from:=[1,x]' 'to:=[2,3]'", path("map.bt") + " colour:=red",
        path("map.bt") + " more", path("bad.yaml"), path("."), path("map.bt") + " stage:=paint",
        path("map.bt") + " config:=" + path("bad.yaml"),
        path("map.bt") + " config:=" + path("none.yaml")}) {
    const Answer answer = ask(words);
    EXPECT_EQ(answer.code, 2) << words;
    EXPECT_EQ(answer.text.rfind("navmesh: ", 0), 0U) << answer.text;
    EXPECT_EQ(answer.text.substr(answer.text.size() - 2), ".\n") << answer.text;
    EXPECT_EQ(answer.text.find(".."), std::string::npos) << answer.text;
  }
}

/// The corridor of a real building, scanned; its floor is rough by a voxel of 0.08 m. The Debian
/// package liboctomap-dev has it.
TEST_F(NavmeshTool, leads_along_the_corridor_of_a_building_that_was_scanned) {
  const std::string scan = "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt";
  if (!std::filesystem::exists(scan)) GTEST_SKIP() << scan << " is not on this machine";
  const Answer answer = ask(scan + " 'from:=[0,0]' 'to:=[20,0]'");
  EXPECT_EQ(answer.code, 0) << answer.text;
  const std::size_t at = answer.text.find("\"guide path m\": ");
  ASSERT_NE(at, std::string::npos) << answer.text;
  EXPECT_LT(std::stod(answer.text.substr(at + 16)), 21.0);
}

}  // namespace
}  // namespace navvi_nav::tool
