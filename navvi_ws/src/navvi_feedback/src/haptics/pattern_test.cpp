#include "haptics/pattern.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace navvi_feedback::haptics {
namespace {

constexpr double kStep = 0.02;  // s

constexpr Pattern kAll[] = {Pattern::assisted, Pattern::rerouted,     Pattern::arrived,  Pattern::no_sound,
                            Pattern::stuck,        Pattern::stopped,  Pattern::halt,
                            Pattern::hit_obstacle, Pattern::hit_shelf};

std::vector<std::pair<double, double>> play(PatternPlayer& player) {
  std::vector<std::pair<double, double>> felt;
  while (const auto rumble = player.update(kStep)) felt.emplace_back(rumble->left, rumble->right);
  return felt;
}

std::vector<std::pair<double, double>> play(Pattern pattern, Zone side = Zone::center) {
  PatternPlayer player;
  player.begin(pattern, side);
  return play(player);
}

TEST(Pattern, begins_at_once_and_ends_within_two_seconds_with_a_rest) {
  for (const Pattern pattern : kAll) {
    const auto felt = play(pattern);
    ASSERT_GE(felt.size(), 10U) << navvi_types::to_string(pattern);
    EXPECT_LE(static_cast<double>(felt.size()) * kStep, 2.0) << navvi_types::to_string(pattern);
    EXPECT_EQ(felt.back(), std::make_pair(0.0, 0.0)) << navvi_types::to_string(pattern);
    if (pattern == Pattern::no_sound || pattern == Pattern::assisted) continue;  // it begins softly
    EXPECT_GT(felt[0].first, 0.0) << navvi_types::to_string(pattern);
  }
}

TEST(Pattern, no_two_feel_the_same_and_each_has_a_name) {
  std::set<std::vector<std::pair<double, double>>> felt;
  std::set<std::string> names;
  for (const Pattern pattern : kAll) {
    felt.insert(play(pattern));
    names.insert(navvi_types::to_string(pattern));
  }
  EXPECT_EQ(felt.size(), std::size(kAll));
  EXPECT_EQ(names.size(), std::size(kAll));
}

TEST(Pattern, a_hit_is_felt_on_its_side) {
  for (const auto& [left, right] : play(Pattern::hit_shelf, Zone::left)) EXPECT_EQ(right, 0.0);
  for (const auto& [left, right] : play(Pattern::hit_obstacle, Zone::right)) EXPECT_EQ(left, 0.0);
}

TEST(Pattern, the_more_urgent_one_is_felt) {
  PatternPlayer player;
  player.begin(Pattern::rerouted);
  (void)player.update(kStep);
  player.begin(Pattern::hit_shelf);
  EXPECT_EQ(player.playing(), Pattern::hit_shelf);
  EXPECT_EQ(player.update(kStep)->left, 1.0);
  player.begin(Pattern::arrived);
  EXPECT_EQ(player.playing(), Pattern::hit_shelf);
  play(player);
  EXPECT_FALSE(player.playing());
  player.begin(Pattern::arrived);
  EXPECT_EQ(player.playing(), Pattern::arrived);
}

}  // namespace
}  // namespace navvi_feedback::haptics
