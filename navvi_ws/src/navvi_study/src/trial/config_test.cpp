#include <gtest/gtest.h>

#include <filesystem>
#include <navvi_config/reader.hpp>

#include "trial/trial_node_config.hpp"

namespace navvi_study::trial {
namespace {

TEST(Config, every_file_that_ships_is_read) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CONFIG_FOLDER)) {
    TrialNodeConfig config;
    EXPECT_NO_THROW(navvi_config::read(config, navvi_config::load_yaml(entry.path()),
                                       entry.path().filename().string()));
    ++files;
  }
  EXPECT_EQ(files, 2);
}

TEST(Config, refuses_what_it_does_not_know) {
  TrialNodeConfig config;
  for (const char* text : {"limits: 1", "limit: -1", "require: [smell]", "once: maybe"}) {
    EXPECT_THROW(navvi_config::read(config, YAML::Load(text), "a test"), navvi_config::ConfigError)
        << text;
  }
}

}  // namespace
}  // namespace navvi_study::trial
