#include "cues/cue_config.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

namespace navvi_feedback::cues {
namespace {

TEST(CuePolicyConfig, refuses_what_it_does_not_know) {
  CuePolicyConfig config;
  for (const char* text : {"stuck_time: -1", "route: {rounding: up}", "near: {distance: .nan}",
                           "wording: {directions: compass}", "chatter: 1"})
    EXPECT_THROW(navvi_config::read(config, YAML::Load(text), "test"), navvi_config::ConfigError)
        << text;
}

TEST(CuePolicyConfig, floors_the_hours_in_the_papers_profile) {
  const std::string file = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/paper.yaml";
  CuePolicyConfig config;
  navvi_config::read(config, navvi_config::load_yaml(file)["cues"], file);
  EXPECT_EQ(config.route.rounding, "floor");
  EXPECT_FALSE(config.near.obstacles);
}

}  // namespace
}  // namespace navvi_feedback::cues
