#include "guide/conflict_forecast.hpp"

#include <gtest/gtest.h>

#include "guide/cylinders.hpp"

namespace navvi_nav::guide {
namespace {

/// A path of 20 m along x, and what moves about it.
class Forecast : public testing::Test {
 protected:
  [[nodiscard]] Conflict forecast(const std::vector<Cylinder>& obstacles, double pace = 0.7) const {
    return ConflictForecast(config_).forecast({{0, 0}, {20, 0}}, obstacles, pace);
  }
  static Cylinder forklift(Point center, Point velocity) { return {7, center, 0.5, velocity}; }
  ConflictForecastConfig config_;
};

TEST_F(Forecast, is_clear_without_anything_and_without_a_path) {
  EXPECT_EQ(forecast({}).state, Conflict::State::clear);
  EXPECT_EQ(ConflictForecast(config_).forecast({}, {forklift({0, 0}, {})}, 0.7).state,
            Conflict::State::clear);
}

TEST_F(Forecast, tells_crossing_from_stationary) {
  const Conflict crosses = forecast({forklift({5, 0.2}, {0, 1.0})});
  EXPECT_EQ(crosses.state, Conflict::State::crossing);
  EXPECT_NEAR(crosses.at, 4.2, 0.05);
  EXPECT_FALSE(crosses.wait_for);  // it is gone before the robot is there
  EXPECT_EQ(forecast({forklift({5, 0.2}, {})}).state, Conflict::State::stationary);
  EXPECT_EQ(forecast({forklift({5, 0.2}, {0, 0.05})}).state, Conflict::State::stationary);
}

TEST_F(Forecast, foresees_what_is_about_to_cross) {
  EXPECT_EQ(forecast({forklift({5, -1.5}, {0, 1.0})}).state, Conflict::State::crossing);
  EXPECT_EQ(forecast({forklift({5, -4.0}, {0, 1.0})}).state, Conflict::State::clear);
  EXPECT_EQ(forecast({forklift({5, -1.5}, {0, -1.0})}).state, Conflict::State::clear);
}

TEST_F(Forecast, takes_what_moved_for_what_will_move_on_until_it_has_stood_for_long) {
  Cylinder pauses = forklift({8, 0}, {});
  EXPECT_EQ(forecast({pauses}).state, Conflict::State::stationary);  // never seen to move
  for (const double stood : {0.0, 4.0, 9.0}) {                       // it is 7.2 m, 10 s, away
    pauses.stood = stood;
    const Conflict conflict = forecast({pauses});
    EXPECT_EQ(conflict.state, Conflict::State::oncoming) << stood;
    EXPECT_NEAR(conflict.time_to_meeting, 10.2, 0.1);
    EXPECT_FALSE(conflict.wait_for);
  }
  pauses.stood = 11.0;
  EXPECT_EQ(forecast({pauses}).state, Conflict::State::stationary);
  pauses.stood = 1.0;
  pauses.center.x = 4.0;
  EXPECT_EQ(forecast({pauses}).state, Conflict::State::oncoming);
  pauses.stood = 5.5;  // it is 4.6 s away
  EXPECT_EQ(forecast({pauses}).state, Conflict::State::stationary);
  EXPECT_TRUE(ConflictForecast(config_).predicted({{0, 0}, {20, 0}}, {pauses}, 0.7).empty());
}

TEST_F(Forecast, takes_what_crosses_too_slowly_for_what_stays) {
  EXPECT_EQ(forecast({forklift({5, -0.75}, {0, 0.25})}).state, Conflict::State::oncoming);
}

TEST_F(Forecast, tells_what_comes_along_the_path_from_what_goes_on_ahead) {
  EXPECT_EQ(forecast({forklift({8, 0}, {-1.0, 0})}).state, Conflict::State::oncoming);
  EXPECT_EQ(forecast({forklift({4, 0}, {1.2, 0})}).state, Conflict::State::crossing);
  EXPECT_FALSE(forecast({forklift({4, 0}, {1.2, 0})}).wait_for);
  EXPECT_EQ(forecast({forklift({3, 0}, {0.3, 0})}, 1.0).state,
            Conflict::State::oncoming);  // runs into it
}

TEST_F(Forecast, is_as_bad_as_the_worst_and_as_near_as_the_nearest) {
  Cylinder near = forklift({4, 0.2}, {0, 1.0});
  near.id = 3;
  const Conflict conflict = forecast({forklift({9, 0}, {}), near});
  EXPECT_EQ(conflict.state, Conflict::State::stationary);
  EXPECT_NEAR(conflict.at, 3.2, 0.05);
}

TEST_F(Forecast, waits_for_what_would_be_hit_but_not_where_it_would_hit) {
  const Conflict conflict = forecast({forklift({2.5, -2.5}, {0, 1.0})});
  ASSERT_TRUE(conflict.wait_for);
  EXPECT_EQ(conflict.wait_for->by, 7U);
  EXPECT_NEAR(conflict.wait_for->at, 2.0, 0.4);
  EXPECT_GT(conflict.wait_for->time_to_clear, 2.0);
  EXPECT_FALSE(forecast({forklift({2.5, -2.5}, {0, 3.0})}).wait_for);  // gone by then
  EXPECT_FALSE(forecast({forklift({9.0, -2.5}, {0, 1.0})}).wait_for);
  Cylinder other = forklift({0, 3}, {0, -1.0});
  other.id = 8;
  EXPECT_FALSE(conflict.hits_waiting);
  EXPECT_TRUE(forecast({forklift({2.5, -2.5}, {0, 1.0}), other}).hits_waiting);
}

TEST_F(Forecast, foresees_where_what_comes_will_be_until_it_is_met) {
  const std::vector<Cylinder> comes{forklift({11, 0}, {-1.0, 0})};
  const auto then = ConflictForecast(config_).predicted({{0, 0}, {20, 0}}, comes, 0.7);
  ASSERT_GE(then.size(), 2U);
  double nearest = 11.0;
  for (const Cylinder& cylinder : then) {
    EXPECT_EQ(cylinder.id, comes[0].id);
    EXPECT_LE(nearest - cylinder.center.x, 1.0 + 1e-9);
    EXPECT_GT(cylinder.center.x, 1.5);
    nearest = cylinder.center.x;
  }
  EXPECT_TRUE(ConflictForecast(config_)
                  .predicted({{0, 0}, {20, 0}}, {forklift({5, 0.2}, {0, 1.0})}, 0.7)
                  .empty());
}

TEST_F(Forecast, foresees_few_places_of_what_is_tiny_or_fast) {
  for (const double speed : {0.3, 1.0, 1000.0}) {
    Cylinder tiny = forklift({4.5, 0}, {-speed, 0});
    tiny.radius = 1e-9;
    EXPECT_LE(ConflictForecast(config_).predicted({{0, 0}, {20, 0}}, {tiny}, 0.7).size(), 65U);
  }
}

TEST_F(Forecast, never_waits_where_waiting_is_hit_sooner_than_driving_on) {
  const Conflict conflict = forecast({forklift({-4, 0}, {1.5, 0})});
  EXPECT_TRUE(conflict.hits_waiting);
  EXPECT_LT(conflict.time_to_collision, 6.0);
  EXPECT_FALSE(conflict.wait_for);
}

TEST_F(Forecast, foresees_where_what_comes_from_behind_goes_on) {
  const auto foreseen = [&](double behind) {
    return ConflictForecast(config_).predicted({{0, 0}, {20, 0}},
                                               {forklift({-behind, 0}, {1.5, 0})}, 0.7);
  };
  EXPECT_TRUE(foreseen(7.0).empty());  // it may still turn off
  const auto then = foreseen(4.0);
  const auto ahead = [](const Cylinder& one) { return one.center.x > 1.0; };
  EXPECT_TRUE(std::any_of(then.begin(), then.end(), ahead));
  for (const Cylinder& one : then) EXPECT_GT(std::abs(one.center.x), 0.9 + 0.5);
}

TEST_F(Forecast, judges_a_long_thing_by_what_it_fills_and_as_one) {
  using navvi_types::ThingClass;
  const MovingThing along{7, ThingClass::forklift, {{8, 1.3}, kPi}, {-1.0, 0}, 1.35, 2.0, 2.4, 1.1};
  EXPECT_EQ(forecast(cylinders_of(along, 1)).state, Conflict::State::oncoming);
  EXPECT_EQ(forecast(cylinders_of(along, 4)).state, Conflict::State::clear);  // it passes beside
  const MovingThing across{7,  ThingClass::forklift, {{3, -2.0}, kPi / 2}, {0, 0.8}, 1.35, 2.0, 2.4,
                           1.1};
  const Conflict conflict = forecast(cylinders_of(across, 4));
  ASSERT_TRUE(conflict.wait_for);
  EXPECT_GT(conflict.wait_for->time_to_clear, (2.0 + 1.2 + 0.35) / 0.8);  // its end has left, too
  EXPECT_EQ(conflict.wait_for->by, 7U);
}

TEST_F(Forecast, tells_where_the_path_is_cut_now_and_whether_the_way_point_is_taken) {
  EXPECT_FALSE(forecast({forklift({5, 2}, {})}).cut);
  Cylinder far = forklift({9, 0}, {0, 1.0});
  far.id = 8;
  const Conflict conflict = forecast({far, forklift({5, 0.2}, {})});
  ASSERT_TRUE(conflict.cut);
  EXPECT_EQ(conflict.cut->by, 7U);
  EXPECT_NEAR(conflict.cut->at, 4.2, 0.05);
  EXPECT_FALSE(conflict.waypoint_taken);
  const auto taken = [&](Point next, Point at) {
    const Path path{{0, 0}, next, {20, 0}};
    return ConflictForecast(config_).forecast(path, {forklift(at, {})}, 0.7).waypoint_taken;
  };
  EXPECT_TRUE(taken({5, 0}, {5, 0.7}));
  EXPECT_FALSE(taken({5, 0}, {5, 0.9}));
  EXPECT_FALSE(taken({13, 0}, {13, 0}));  // beyond its range
}

TEST_F(Forecast, tells_whether_waiting_alone_or_driving_on_too_is_dangerous) {
  Conflict conflict;
  EXPECT_FALSE(conflict.hits_only_waiting() || conflict.hits_either_way());
  conflict.hits_waiting = true;
  EXPECT_TRUE(conflict.hits_only_waiting());
  EXPECT_FALSE(conflict.hits_either_way());
  conflict.time_to_collision = 2.0;
  EXPECT_FALSE(conflict.hits_only_waiting());
  EXPECT_TRUE(conflict.hits_either_way());
}

TEST_F(Forecast, does_not_look_beyond_its_range) {
  EXPECT_EQ(forecast({forklift({15, 0}, {})}).state, Conflict::State::clear);
  config_.look_ahead = 30.0;
  EXPECT_EQ(forecast({forklift({15, 0}, {})}).state, Conflict::State::stationary);
}

}  // namespace
}  // namespace navvi_nav::guide
