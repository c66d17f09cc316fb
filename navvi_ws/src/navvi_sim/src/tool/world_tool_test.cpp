// The program behind `./navvi world`, run as the command runs it.

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "temp_folder.hpp"

namespace {

namespace fs = std::filesystem;

using navvi_test::Answer;

class WorldTool : public testing::Test {
 protected:
  Answer run(const std::string& words) const {
    return navvi_test::run("cd " + folder_.string() + " && " + WORLD_TOOL + " " + words);
  }

  navvi_test::TempFolder folder_;
};

TEST_F(WorldTool, lists_the_worlds_that_have_a_name) {
  const Answer answer = run("list");
  EXPECT_EQ(answer.code, 0);
  for (const char* name : {"warehouse", "training", "easy", "busy", "narrow", "maze"})
    EXPECT_NE(answer.text.find('"' + std::string(name) + "\": \""), std::string::npos) << name;
}

TEST_F(WorldTool, prints_what_a_session_would_make_of_a_world) {
  std::ofstream(folder_ / "still.yaml") << "workers: standing\n";
  EXPECT_NE(run("check busy").text.find("\"worker on routes\": "), std::string::npos);
  const Answer answer = run("check busy config:=still.yaml seed:=2");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_EQ(answer.text.find("worker on routes"), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("\"world\": \"busy\", \"seed\": 2, "), std::string::npos);
  EXPECT_NE(answer.text.find("\"start x m, y m, yaw rad\": ["), std::string::npos);
  EXPECT_NE(answer.text.find("\"things\": []"), std::string::npos);
  EXPECT_EQ(answer.text.find("\"standing\": 0,"), std::string::npos) << answer.text;
  std::ofstream(folder_ / "plane.world")
      << "<sdf version='1.6'><world name='w'><include><uri>model://ground_plane</uri></include>"
         "</world></sdf>";
  EXPECT_NE(run("check plane.world").text.find("\"standing\": 0,"), std::string::npos);
}

TEST_F(WorldTool, prints_the_corners_of_all_things_to_be_drawn) {
  std::ofstream(folder_ / "a.world")
      << "<sdf version='1.6'><world name='w'>"
         "<model name='floor'><static>1</static><pose>0 0 -.1 0 0 0</pose><link name='l'>"
         "<collision name='c'><geometry><box><size>20 20 .2</size></box></geometry></collision>"
         "</link></model></world></sdf>";
  const Answer answer = run("check a.world drawing:=true");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find("{\"class\": \"floor\", \"at\": [0.000, 0.000], \"yaw\": 0.000000, "
                             "\"shapes\": [{\"class\": \"floor\", \"points\": "
                             "[[-10.0000, -10.0000, -0.2000], [10.0000, -10.0000, -0.2000], "),
            std::string::npos)
      << answer.text;
}

TEST_F(WorldTool, writes_the_octomap_by_the_library) {
  EXPECT_EQ(run("check training save:=a.bt octomap/resolution:=0.08").code, 0);
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary((folder_ / "a.bt").string()));
  EXPECT_NEAR(tree.getResolution(), 0.08, 1e-12);
  EXPECT_NE(folder_.text("a.bt").find("size " + std::to_string(tree.size()) + "\n"), std::string::npos);
  EXPECT_EQ(run("check training save:=b.ot octomap/resolution:=0.08").code, 0);
  std::unique_ptr<octomap::AbstractOcTree> read(
      octomap::AbstractOcTree::read((folder_ / "b.ot").string()));
  const auto* marked = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(marked, nullptr);
  EXPECT_EQ(marked->getNumLeafNodes(), tree.getNumLeafNodes());
  EXPECT_EQ(run("check training save:=/proc/a.bt").code, 2);
}

TEST_F(WorldTool, refuses_what_is_wrong_in_a_sentence_and_writes_nothing) {
  std::ofstream(folder_ / "bad.yaml") << "layout:\n  rows: 90\n";
  for (const char* words : {"",
                            "draw easy",
                            "check",
                            "check office",
                            "list easy",
                            "check easy more",
                            "check easy drawing:=maybe",
                            "check easy start:=foo",
                            "check easy goal:=1",
                            "check easy seed:=-1",
                            "check easy config:=none.yaml",
                            "check bad.yaml",
                            "check easy seed:=x",
                            "check easy seed:=1 seed:=2",
                            "check easy rows:=90",
                            "check easy sede:=1",
                            "check easy octomap:=1",
                            "check easy octomap/resolution:=0",
                            "check warehouse rows:=90",
                            "check easy start:=0,0",
                            "check easy scenario/min_route:=900"}) {
    const Answer answer = run(words);
    EXPECT_EQ(answer.code, 2) << words << ": " << answer.text;
    EXPECT_EQ(answer.text.rfind("navvi: ", 0), 0u) << words << ": " << answer.text;
  }
  EXPECT_NE(run("check bad.yaml").text.find("bad.yaml, line 2"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().filename(), "bad.yaml");
}

}  // namespace
