#include "navvi_nav/lockstep/navigation.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

#include "small_world.hpp"

namespace navvi_nav::lockstep {
namespace {

using navvi_types::Guidance;

/// A room of 8 x 6 m, a robot at its left end, and a goal at its right.
class InARoom : public testing::Test {
 protected:
  InARoom() { navigation_.set_map(SmallWorld().room(8, 6).bytes(), "OcTree", 0.05); }
  /// One beat. \returns the state that is published, if any
  std::optional<Guidance::State> beat() {
    time_ += 0.05;
    navigation_.set_pose({{1.5, 3}, 0.0}, 0.0, time_);
    navigation_.set_obstacles({}, time_);
    const std::optional<Guidance> guidance = navigation_.update(time_);
    if (!guidance) return std::nullopt;
    EXPECT_EQ(guidance->seq, ++published_);
    return guidance->state;
  }
  Navigation navigation_{NavigationConfig{}};
  double time_ = 0.0;
  std::uint32_t published_ = 0;
};

TEST_F(InARoom, answers_a_request_at_the_next_beat) {
  EXPECT_EQ(beat(), Guidance::State::no_map);
  EXPECT_FALSE(navigation_.has_map());
  EXPECT_EQ(beat(), Guidance::State::no_goal);
  EXPECT_TRUE(navigation_.has_map());
  navigation_.set_goal({6.5, 3});
  EXPECT_FALSE(beat());  // undecided
  EXPECT_EQ(beat(), Guidance::State::following);
}

TEST(NavigationConfig, is_copied_with_its_values) {
  NavigationConfig config;
  navvi_config::read(config, navvi_config::read_words({"replan/period:=3"}), "test");
  NavigationConfig copy(config);
  NavigationConfig assigned;
  assigned = config;
  for (NavigationConfig* one : {&copy, &assigned}) {
    const auto rows =
        navvi_config::table_of([&](navvi_config::Visitor& visit) { one->describe(visit); });
    const auto row = std::find_if(rows.begin(), rows.end(), [](const navvi_config::Row& candidate) {
      return candidate.key == "replan/period";
    });
    ASSERT_NE(row, rows.end());
    EXPECT_EQ(std::stod(row->default_value), 3.0);
  }
}

}  // namespace
}  // namespace navvi_nav::lockstep
