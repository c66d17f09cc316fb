#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "small_world.hpp"

namespace navvi_nav::tool {
namespace {

struct Answer {
  int code = -1;
  std::string text;  ///< both streams
};

/// Two rooms, of which the left one has a box in its middle.
class NavmeshTool : public testing::Test {
 protected:
  NavmeshTool() {
    std::string name = (std::filesystem::temp_directory_path() / "navvi_tool_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    SmallWorld world;
    world.room(10, 6).box(7, 0, 0, 7.1, 6, 1).box(3, 2, 0, 4, 4, 1);
    octomap::OcTree tree = world.tree();
    tree.writeBinary(path("map.bt"));
  }
  ~NavmeshTool() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  static Answer ask(const std::string& words) {
    Answer out;
    FILE* pipe = popen((std::string(NAVMESH_TOOL) + " " + words + " 2>&1").c_str(), "r");
    std::array<char, 256> part{};
    while (fgets(part.data(), static_cast<int>(part.size()), pipe) != nullptr)
      out.text += part.data();
    out.code = WEXITSTATUS(pclose(pipe));
    return out;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(NavmeshTool, gives_programs_the_path_as_json_or_why_there_is_none) {
  const auto json = [&](const std::string& words) {
    const Answer answer = ask(path("map.bt") + " --json " + path("a.json") + " " + words);
    std::ostringstream text;
    text << std::ifstream(path("a.json")).rdbuf();
    return std::to_string(answer.code) + " " + text.str();
  };
  const std::string found = json("--from 1,1 --to 6,1");
  EXPECT_EQ(found.rfind("0 {\"map\": ", 0), 0U) << found;
  EXPECT_NE(found.find("\"components\": 2, "), std::string::npos) << found;
  EXPECT_NE(found.find("\"guide path m\": 5.000, \"path\": [[1.00, 1.00], "), std::string::npos)
      << found;
  const std::string none = json("--from 1,1 --to 9,1");
  EXPECT_EQ(none.rfind("1 {", 0), 0U) << none;
  EXPECT_NE(none.find("\"refusal\": \""), std::string::npos) << none;
}

TEST_F(NavmeshTool, tells_what_a_mesh_is_like_and_draws_it) {
  const Answer answer =
      ask(path("map.bt") + " --picture " + path("map.svg") + " --cylinder 5.5,3,0.4");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find(", 2 components"), std::string::npos) << answer.text;
  std::ostringstream svg;
  svg << std::ifstream(path("map.svg")).rdbuf();
  EXPECT_EQ(svg.str().rfind("<svg", 0), 0U);
  EXPECT_NE(svg.str().find("<circle"), std::string::npos);
  for (const char* word : {">floor<", ">moving thing<", ">5 m<", ">0, 0<", "</svg>"})
    EXPECT_NE(svg.str().find(word), std::string::npos) << word;
}

TEST_F(NavmeshTool, answers_a_query_and_says_why_it_cannot) {
  const Answer found = ask(path("map.bt") + " --from 1,3 --to 6,3");
  EXPECT_EQ(found.code, 0) << found.text;
  EXPECT_NE(found.text.find("shortest    5."), std::string::npos) << found.text;
  const Answer apart = ask(path("map.bt") + " --from 1,3 --to 8,3");
  EXPECT_EQ(apart.code, 1);
  EXPECT_NE(apart.text.find("no floor joins the goal with the robot"), std::string::npos)
      << apart.text;
}

TEST_F(NavmeshTool, refuses_what_it_cannot_do_in_a_sentence) {
  std::ofstream(path("bad.yaml")) << "colour: red\n";
  for (const std::string& words :
       {std::string(), path("none.bt"), path("map.svg"), path("map.bt") + " --from 1,2",
        path("map.bt") + " --from 1 --to 2,3", path("map.bt") + " --cylinder 1,2,-1",
        path("map.bt") + " --from 1,x --to 2,3", path("map.bt") + " --colour",
        path("map.bt") + " more", path("bad.yaml"), path("."), path("map.bt") + " --picture",
        path("map.bt") + " --picture /nowhere/map.svg", path("map.bt") + " -o " + path("map.png"),
        path("map.bt") + " --config " + path("none.yaml")}) {
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
  const Answer answer = ask(scan + " --from 0,0 --to 20,0");
  EXPECT_EQ(answer.code, 0) << answer.text;
  const std::size_t at = answer.text.find("guide path  ");
  ASSERT_NE(at, std::string::npos) << answer.text;
  EXPECT_LT(std::stod(answer.text.substr(at + 12)), 21.0);
}

}  // namespace
}  // namespace navvi_nav::tool
