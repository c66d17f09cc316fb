#include "navvi_nav/way.hpp"

#include <gtest/gtest.h>

#include "navvi_nav/moving_thing.hpp"

namespace navvi_nav {
namespace {

/// A path of 20 m along x, and what moves about it.
class Ahead : public testing::Test {
 protected:
  [[nodiscard]] Way judge(const std::vector<Cylinder>& obstacles, double pace = 0.7) const {
    return WayAhead(config_).judge({{0, 0}, {20, 0}}, obstacles, pace);
  }
  static Cylinder forklift(Point center, Point velocity) { return {7, center, 0.5, velocity}; }
  WayConfig config_;
};

TEST_F(Ahead, is_free_without_anything_and_without_a_path) {
  EXPECT_EQ(judge({}).state, Way::State::free);
  EXPECT_EQ(WayAhead(config_).judge({}, {forklift({0, 0}, {})}, 0.7).state, Way::State::free);
}

TEST_F(Ahead, tells_what_crosses_from_what_stands) {
  const Way crosses = judge({forklift({5, 0.2}, {0, 1.0})});
  EXPECT_EQ(crosses.state, Way::State::clears);
  EXPECT_NEAR(crosses.at, 4.2, 0.05);
  EXPECT_FALSE(crosses.wait);  // it is gone before the robot is there
  EXPECT_EQ(judge({forklift({5, 0.2}, {})}).state, Way::State::stands);
  EXPECT_EQ(judge({forklift({5, 0.2}, {0, 0.05})}).state, Way::State::stands);
}

TEST_F(Ahead, foresees_what_is_about_to_cross) {
  EXPECT_EQ(judge({forklift({5, -1.5}, {0, 1.0})}).state, Way::State::clears);
  EXPECT_EQ(judge({forklift({5, -4.0}, {0, 1.0})}).state, Way::State::free);
  EXPECT_EQ(judge({forklift({5, -1.5}, {0, -1.0})}).state, Way::State::free);
}

TEST_F(Ahead, takes_what_moved_for_what_will_move_on_until_it_has_stood_for_long) {
  Cylinder pauses = forklift({8, 0}, {});
  EXPECT_EQ(judge({pauses}).state, Way::State::stands);  // never seen to move
  for (const double stood : {0.0, 4.0, 9.0}) {           // it is 7.2 m, 10 s, away
    pauses.stood = stood;
    const Way way = judge({pauses});
    EXPECT_EQ(way.state, Way::State::comes) << stood;
    EXPECT_NEAR(way.meets_in, 10.2, 0.1);
    EXPECT_FALSE(way.wait);
  }
  pauses.stood = 11.0;
  EXPECT_EQ(judge({pauses}).state, Way::State::stands);
  pauses.stood = 1.0;
  pauses.center.x = 4.0;
  EXPECT_EQ(judge({pauses}).state, Way::State::comes);
  pauses.stood = 5.5;  // it is 4.6 s away
  EXPECT_EQ(judge({pauses}).state, Way::State::stands);
  EXPECT_TRUE(WayAhead(config_).foreseen({{0, 0}, {20, 0}}, {pauses}, 0.7).empty());
}

TEST_F(Ahead, takes_what_crosses_too_slowly_for_what_stays) {
  EXPECT_EQ(judge({forklift({5, -0.75}, {0, 0.25})}).state, Way::State::comes);
}

TEST_F(Ahead, tells_what_comes_along_the_path_from_what_goes_on_ahead) {
  EXPECT_EQ(judge({forklift({8, 0}, {-1.0, 0})}).state, Way::State::comes);
  EXPECT_EQ(judge({forklift({4, 0}, {1.2, 0})}).state, Way::State::clears);
  EXPECT_FALSE(judge({forklift({4, 0}, {1.2, 0})}).wait);
  EXPECT_EQ(judge({forklift({3, 0}, {0.3, 0})}, 1.0).state, Way::State::comes);  // runs into it
}

TEST_F(Ahead, is_as_bad_as_the_worst_and_as_near_as_the_nearest) {
  Cylinder near = forklift({4, 0.2}, {0, 1.0});
  near.id = 3;
  const Way way = judge({forklift({9, 0}, {}), near});
  EXPECT_EQ(way.state, Way::State::stands);
  EXPECT_NEAR(way.at, 3.2, 0.05);
}

TEST_F(Ahead, tells_to_wait_for_what_would_be_run_into_and_not_where_it_would_run_into_one) {
  const Way way = judge({forklift({2.5, -2.5}, {0, 1.0})});
  ASSERT_TRUE(way.wait);
  EXPECT_EQ(way.wait->by, 7U);
  EXPECT_NEAR(way.wait->at, 2.0, 0.4);
  EXPECT_GT(way.wait->clears_in, 2.0);
  EXPECT_FALSE(judge({forklift({2.5, -2.5}, {0, 3.0})}).wait);  // gone by then
  EXPECT_FALSE(judge({forklift({9.0, -2.5}, {0, 1.0})}).wait);
  Cylinder other = forklift({0, 3}, {0, -1.0});
  other.id = 8;
  EXPECT_FALSE(way.hits_waiting);
  EXPECT_TRUE(judge({forklift({2.5, -2.5}, {0, 1.0}), other}).hits_waiting);
}

TEST_F(Ahead, foresees_where_what_comes_will_be_until_it_is_met) {
  const std::vector<Cylinder> comes{forklift({11, 0}, {-1.0, 0})};
  const auto then = WayAhead(config_).foreseen({{0, 0}, {20, 0}}, comes, 0.7);
  ASSERT_GE(then.size(), 2U);
  double nearest = 11.0;
  for (const Cylinder& cylinder : then) {
    EXPECT_EQ(cylinder.id, comes[0].id);
    EXPECT_LE(nearest - cylinder.center.x, 1.0 + 1e-9);
    EXPECT_GT(cylinder.center.x, 1.5);
    nearest = cylinder.center.x;
  }
  EXPECT_TRUE(
      WayAhead(config_).foreseen({{0, 0}, {20, 0}}, {forklift({5, 0.2}, {0, 1.0})}, 0.7).empty());
}

TEST_F(Ahead, foresees_few_places_of_what_is_tiny_or_fast) {
  for (const double speed : {0.3, 1.0, 1000.0}) {
    Cylinder tiny = forklift({4.5, 0}, {-speed, 0});
    tiny.radius = 1e-9;
    EXPECT_LE(WayAhead(config_).foreseen({{0, 0}, {20, 0}}, {tiny}, 0.7).size(), 65U);
  }
}

TEST_F(Ahead, lets_nobody_wait_where_they_are_run_into_sooner_than_if_they_went_on) {
  const Way way = judge({forklift({-4, 0}, {1.5, 0})});
  EXPECT_TRUE(way.hits_waiting);
  EXPECT_LT(way.hits_in, 6.0);
  EXPECT_FALSE(way.wait);
}

TEST_F(Ahead, foresees_where_what_comes_from_behind_goes_on) {
  const auto foreseen = [&](double behind) {
    return WayAhead(config_).foreseen({{0, 0}, {20, 0}}, {forklift({-behind, 0}, {1.5, 0})}, 0.7);
  };
  EXPECT_TRUE(foreseen(7.0).empty());  // it may still turn off
  const auto then = foreseen(4.0);
  const auto ahead = [](const Cylinder& one) { return one.center.x > 1.0; };
  EXPECT_TRUE(std::any_of(then.begin(), then.end(), ahead));
  for (const Cylinder& one : then) EXPECT_GT(std::abs(one.center.x), 0.9 + 0.5);
}

TEST_F(Ahead, judges_a_long_thing_by_what_it_fills_and_as_one) {
  const MovingThing along{{7, {8, 1.3}, 1.35, {-1.0, 0}}, M_PI, 2.4, 1.1};
  EXPECT_EQ(judge(cylinders_of({along}, 1)).state, Way::State::comes);
  EXPECT_EQ(judge(cylinders_of({along}, 4)).state, Way::State::free);  // it passes beside
  const MovingThing across{{7, {3, -2.0}, 1.35, {0, 0.8}}, M_PI / 2, 2.4, 1.1};
  const Way way = judge(cylinders_of({across}, 4));
  ASSERT_TRUE(way.wait);
  EXPECT_GT(way.wait->clears_in, (2.0 + 1.2 + 0.35) / 0.8);  // its end has left, too
  EXPECT_EQ(way.wait->by, 7U);
}

TEST_F(Ahead, does_not_look_beyond_its_range) {
  EXPECT_EQ(judge({forklift({15, 0}, {})}).state, Way::State::free);
  config_.look_ahead = 30.0;
  EXPECT_EQ(judge({forklift({15, 0}, {})}).state, Way::State::stands);
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
