#include "read/sdf_own.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "navvi_sim/read/world_source.hpp"
#include "temp_folder.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

class SdfOwn : public testing::Test {
 protected:
  LoadedWorld read(const std::string& text) const {
    return load_world({folder_.write("a.sdf", text)});
  }

  navvi_test::TempFolder folder_;
};

TEST_F(SdfOwn, is_read_with_care) {
  std::ostringstream all;
  all << std::ifstream(fs::path(NAVVI_SIM_DIR) / "worlds/crossing.sdf").rdbuf();
  const std::string good = all.str();
  const std::vector<std::pair<std::string, std::string>> changes{
      {"<navvi:class>shelf<", "<navvi:class>ghost<"},
      {"<navvi:class>shelf<", "<navvi:class><"},
      {"loop=\"true\"", "loop=\"maybe\""},
      {"loop=\"true\"", ""},
      {"delay=\"0\"", "delay=\"nan\""},
      {"speed=\"0.7\"", "speed=\"fast\""},
      {"yields=\"true\"", "yields=\"true\" haste=\"1\""},
      {"<navvi:waypoint pause=\"2\"", "<navvi:waypoint pause=\"inf\""},
      {"<navvi:waypoint pause=\"2\"", "<navvi:point pause=\"4\""},
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
