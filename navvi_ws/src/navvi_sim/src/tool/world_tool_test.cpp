// `./navvi world`, run as a person runs it.

#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

namespace {

namespace fs = std::filesystem;

struct Answer {
  int code;
  std::string text;
};

class WorldTool : public testing::Test {
 protected:
  WorldTool() {
    std::string pattern = (fs::temp_directory_path() / "navvi_tool_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~WorldTool() override { fs::remove_all(folder_); }

  Answer run(const std::string& words) const {
    const std::string command =
        "cd " + folder_.string() + " && " + WORLD_TOOL + " " + words + " 2>&1";
    Answer answer{-1, ""};
    FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> buffer{};
    while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
      answer.text.append(buffer.data(), count);
    answer.code = WEXITSTATUS(pclose(pipe));
    return answer;
  }
  std::string content(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  fs::path folder_;
};

TEST_F(WorldTool, lists_the_worlds_that_have_a_name) {
  const Answer answer = run("list");
  EXPECT_EQ(answer.code, 0);
  for (const char* name : {"warehouse", "training", "easy", "busy", "narrow", "maze"})
    EXPECT_NE(answer.text.find(name), std::string::npos) << name;
}

TEST_F(WorldTool, gives_programs_as_json_what_it_prints_for_people) {
  const Answer answer = run("check busy seed:=2 --json a.json");
  EXPECT_EQ(answer.code, 0) << answer.text;
  const std::string json = content("a.json");
  EXPECT_NE(json.find("\"world\": \"busy\", \"seed\": 2"), std::string::npos) << json;
  const auto at = answer.text.find("start ") + 6;
  EXPECT_NE(json.find(answer.text.substr(at, answer.text.find(',', at) - at)), std::string::npos);
  EXPECT_EQ(run("list --json b.json").code, 0);
  EXPECT_NE(content("b.json").find("\"training\": \""), std::string::npos);
  EXPECT_EQ(run("check easy --json /nowhere/a.json").code, 2);
}

TEST_F(WorldTool, writes_the_octomap_by_the_library) {
  const Answer plain = run("check training -o a.bt");
  EXPECT_EQ(plain.code, 0) << plain.text;
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary((folder_ / "a.bt").string()));
  EXPECT_EQ(run("check training -o b.ot").code, 0);
  std::unique_ptr<octomap::AbstractOcTree> read(
      octomap::AbstractOcTree::read((folder_ / "b.ot").string()));
  const auto* marked = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(marked, nullptr);
  EXPECT_EQ(marked->getNumLeafNodes(), tree.getNumLeafNodes());
  EXPECT_EQ(run("check training -o a.png").code, 2);
  EXPECT_EQ(run("check training -o /proc/a.bt").code, 2);
}

TEST_F(WorldTool, shows_a_world_as_a_picture_and_says_what_is_in_it) {
  const Answer answer = run("show easy seed:=3 forklifts:=2 scenario/min_route:=20");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find("2 forklift on routes"), std::string::npos) << answer.text;
  EXPECT_NE(content("easy.svg").find("forklift (2, 2 moving)"), std::string::npos);
  EXPECT_NE(content("easy.svg").find("seed 3"), std::string::npos);
}

TEST_F(WorldTool, tells_what_a_session_would_make_of_a_world_and_draws_nothing) {
  std::ofstream(folder_ / "still.yaml") << "workers: standing\n";
  EXPECT_NE(run("check busy").text.find("worker on routes"), std::string::npos);
  const Answer answer = run("check busy --config still.yaml seed:=2");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_EQ(answer.text.find("worker on routes"), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("seed 2"), std::string::npos) << answer.text;
  EXPECT_FALSE(fs::exists(folder_ / "busy.svg"));
}

TEST_F(WorldTool, saves_a_map_that_octomap_reads) {
  const Answer answer = run("check easy -o a.bt octomap/resolution:=0.08");
  EXPECT_EQ(answer.code, 0) << answer.text;
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary((folder_ / "a.bt").string()));
  EXPECT_NEAR(tree.getResolution(), 0.08, 1e-12);
  EXPECT_NE(content("a.bt").find("size " + std::to_string(tree.size()) + "\n"), std::string::npos);
  EXPECT_GT(tree.size(), 1000U);
}

TEST_F(WorldTool, refuses_what_is_wrong_in_a_sentence_and_writes_nothing) {
  std::ofstream(folder_ / "bad.yaml") << "layout:\n  rows: 90\n";
  for (const char* words : {"",
                            "draw easy",
                            "show",
                            "show office",
                            "show easy -o",
                            "show easy -o a.gif",
                            "show easy -o a.png",
                            "check easy -o a.svg",
                            "check easy start:=foo",
                            "check easy goal:=1",
                            "check easy seed:=-1",
                            "check easy --config",
                            "check easy --config none.yaml",
                            "check easy --colour",
                            "show bad.yaml",
                            "show easy seed",
                            "show easy seed:=x",
                            "show easy seed:=1 seed:=2",
                            "show easy rows:=90",
                            "show easy sede:=1",
                            "show easy octomap:=1",
                            "show easy octomap/resolution:=0",
                            "show warehouse rows:=90",
                            "show easy start:=0,0",
                            "show easy scenario/min_route:=900",
                            "list easy",
                            "show easy --json a.json"}) {
    const Answer answer = run(words);
    EXPECT_EQ(answer.code, 2) << words << ": " << answer.text;
    EXPECT_EQ(answer.text.rfind("navvi: ", 0), 0u) << words << ": " << answer.text;
  }
  EXPECT_NE(run("show bad.yaml").text.find("bad.yaml, line 2"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().filename(), "bad.yaml");
}

}  // namespace
