#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {
namespace {

TEST(PersonConfig, every_default_lies_in_its_own_range) {
  for (const auto& row : navvi_config::table<SimulatedOperatorConfig>()) {
    SimulatedOperatorConfig config;
    EXPECT_NO_THROW(navvi_config::read(
        config, navvi_config::read_words({row.key + ":=" + row.default_value}), "its own default"))
        << row.key;
  }
}

}  // namespace
}  // namespace navvi_people::people
