#include "navvi_sim/read/world_source.hpp"

#include <gtest/gtest.h>

#include "generate/layout_config.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

TEST(WorldSource, takes_every_world_that_ships) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(NAVVI_SIM_DIR) / "worlds")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_NO_THROW(static_cast<void>(load_world({entry.path().string()}))) << entry.path();
  }
  EXPECT_GE(files, 3);
}

TEST(WorldSource, knows_presets_by_name_and_nothing_else) {
  for (const generate::Preset& known : generate::presets())
    EXPECT_EQ(load_world({known.name, "", 3}).world.name, known.name);
  for (const char* spec : {"", "Warehouse", "office", "a.txt", "/", "missing.yaml", "missing.sdf"})
    EXPECT_THROW(static_cast<void>(load_world({spec, "", 3})), WorldError) << spec;
}

TEST(WorldSource, takes_a_file_whose_name_is_nothing_but_the_ending) {
  const fs::path folder = fs::path(testing::TempDir()) / "only_an_ending";
  fs::create_directories(folder);
  const fs::path file = folder / ".world";
  fs::copy_file(fs::path(NAVVI_SIM_DIR) / "worlds/small_room.world", file,
                fs::copy_options::overwrite_existing);
  EXPECT_NO_THROW(static_cast<void>(load_world({file.string()})));
}

TEST(WorldSource, splits_folders_at_colons) {
  EXPECT_TRUE(folders("").empty());
  EXPECT_EQ(folders("/::/tmp:").size(), 2U);
}

}  // namespace
}  // namespace navvi_sim::read
