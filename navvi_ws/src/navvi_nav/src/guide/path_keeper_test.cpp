#include "guide/path_keeper.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_nav::guide {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A path of 13 m, and ways around what cuts it.
class Holding : public testing::Test {
 protected:
  static Conflict conflict(Conflict::State state, double time_to_meeting = 10.0) {
    Conflict out;
    out.state = state;
    out.at = 4.0;
    out.cut = Conflict::Cut{1, 4.0};
    out.time_to_meeting = time_to_meeting;
    out.time_to_collision = state == Conflict::State::crossing ? 4.0 : 1.0;
    return out;
  }
  /// A search for any reason found a path (if it is not empty), while the robot sees its way-point.
  static PathKeeper::Choice choice(double time, const PathKeeper::Candidate& followed,
                                   const PathKeeper::Candidate& fresh) {
    PathKeeper::Choice out;
    out.time = time;
    out.reason = Guidance::Replan::path_carved;
    out.found = fresh.path.empty() ? plan::PlanStatus::no_route : plan::PlanStatus::found;
    out.followed = followed;
    out.fresh = fresh;
    out.sees_waypoint = out.way_is_free = true;
    return out;
  }
  /// Asks every 0.5 s. \returns s for which a path is kept after a search
  double kept(const Path& fresh, const Conflict& now) {
    PathKeeper keeper(config_);
    double time = 10.0;
    while (time < 30.0 && keeper.decide(choice(time, {followed_, now}, {fresh, {}}))) time += 0.5;
    return time - 10.0;
  }
  const Path followed_ = {{0, 0}, {5, 0}, {5, 8}};
  const Path longer_ = {{0, 0}, {5, -6}, {12, 0}, {5, 8}};
  const Path back_ = {{0, 0}, {-1.5, 0.5}, {5, 8}};
  const Path slight_ = {{0, 0}, {5, 0}, {6, 4}, {5, 8}};
  PathKeeperConfig config_;
};

TEST_F(Holding, waits_for_what_crosses_whatever_else_there_is) {
  for (const Path& fresh : {longer_, back_, slight_, Path{}})
    EXPECT_DOUBLE_EQ(kept(fresh, conflict(Conflict::State::crossing)), config_.hold_time);
}

TEST_F(Holding, stays_behind_what_drives_on_ahead_as_long_as_nothing_would_be_hit) {
  for (const auto state : {Conflict::State::crossing, Conflict::State::oncoming}) {
    Conflict ahead = conflict(state, 3.0);
    ahead.time_to_collision = kNever;
    EXPECT_DOUBLE_EQ(kept(slight_, ahead), 20.0);  // as long as it was asked
    PathKeeper keeper(config_);
    EXPECT_TRUE(keeper.update(0.0, ahead));
    EXPECT_TRUE(keeper.update(60.0, ahead));
    ahead.hits_waiting = true;
    EXPECT_LT(kept(slight_, ahead), 20.0);
  }
}

TEST_F(Holding, evades_what_comes_only_when_it_is_close) {
  for (const Path& fresh : {longer_, back_, slight_, Path{}})
    EXPECT_DOUBLE_EQ(kept(fresh, conflict(Conflict::State::oncoming, 10.0)),
                     20.0);  // as long as it was asked
  for (const Path& fresh : {back_, slight_, Path{}})
    EXPECT_DOUBLE_EQ(kept(fresh, conflict(Conflict::State::oncoming, 3.0)), 0.0);
}

TEST_F(Holding, leads_nobody_a_long_way_round_at_once_for_what_comes) {
  EXPECT_DOUBLE_EQ(kept(longer_, conflict(Conflict::State::oncoming, 3.0)), config_.hold_time);
  config_.hold_detour = 50.0;
  EXPECT_DOUBLE_EQ(kept(longer_, conflict(Conflict::State::oncoming, 3.0)), 0.0);
}

TEST_F(Holding, changes_nothing_while_somebody_waits_in_safety) {
  Conflict waited = conflict(Conflict::State::oncoming, 3.0);
  waited.wait_for = Blocker{1, 2.0, std::nullopt};
  EXPECT_DOUBLE_EQ(kept(slight_, waited), config_.hold_time);
  waited.hits_waiting = true;
  waited.time_to_collision = 2.0;
  EXPECT_DOUBLE_EQ(kept(slight_, waited), 0.0);
}

TEST_F(Holding, does_not_wait_for_what_stands) {
  EXPECT_DOUBLE_EQ(kept(longer_, conflict(Conflict::State::stationary)), 0.0);
  EXPECT_DOUBLE_EQ(kept({}, conflict(Conflict::State::stationary)), 0.0);
}

TEST_F(Holding, waits_anew_once_the_path_was_free) {
  PathKeeper keeper(config_);
  const Conflict crossed = conflict(Conflict::State::crossing);
  ASSERT_TRUE(keeper.update(0.0, crossed));
  ASSERT_TRUE(keeper.update(5.0, crossed));
  ASSERT_FALSE(keeper.update(5.5, Conflict{}));
  EXPECT_TRUE(keeper.update(6.0, crossed));
  EXPECT_TRUE(keeper.update(13.5, crossed));
  EXPECT_FALSE(keeper.update(14.5, crossed));
}

TEST_F(Holding, makes_a_person_wait_only_for_what_crosses_right_before_them) {
  const PathKeeper keeper(config_);
  Conflict crossed = conflict(Conflict::State::crossing);
  EXPECT_FALSE(keeper.must_wait(crossed));  // who goes on runs into nothing
  crossed.wait_for = Blocker{1, 2.0, 1.5};
  EXPECT_TRUE(keeper.must_wait(crossed));
  crossed.wait_for->at = 8.0;
  EXPECT_FALSE(keeper.must_wait(crossed));
  crossed.wait_for->at = 2.0;
  crossed.state = Conflict::State::stationary;  // what else there may be
  EXPECT_TRUE(keeper.must_wait(crossed));
}

TEST_F(Holding, evades_what_runs_into_who_waits_if_there_is_a_safer_way) {
  Conflict crossed = conflict(Conflict::State::crossing);
  crossed.wait_for = Blocker{1, 2.0, 1.5};
  crossed.hits_waiting = true;
  crossed.time_to_collision = 2.0;
  EXPECT_DOUBLE_EQ(kept(slight_, crossed), 0.0);
  EXPECT_DOUBLE_EQ(kept({}, crossed), config_.hold_time);
}

TEST_F(Holding, keeps_what_was_just_chosen_unless_something_would_be_run_into) {
  for (const double hits_in : {kNever, 4.0, 2.0}) {
    PathKeeper keeper(config_);
    Conflict cut = conflict(Conflict::State::stationary);
    cut.time_to_collision = hits_in;
    const auto kept = [&](double time) {
      return keeper.decide(choice(time, {followed_, cut}, {longer_, {}}));
    };
    EXPECT_FALSE(kept(10.0));
    keeper.chose(10.0);
    EXPECT_EQ(kept(10.5), hits_in > config_.kHoldChoice);
    EXPECT_EQ(kept(12.9), hits_in > config_.kHoldChoice);
    EXPECT_FALSE(kept(13.1));
  }
}

TEST_F(Holding, leaves_what_was_just_chosen_only_for_what_is_safer_or_where_all_is_closed) {
  Conflict soon = conflict(Conflict::State::stationary);
  soon.time_to_collision = 2.0;
  Conflict later = soon;
  PathKeeper keeper(config_);
  keeper.chose(10.0);
  for (const double hits_in : {2.5, 2.9, 3.1, kNever}) {
    later.time_to_collision = hits_in;
    EXPECT_EQ(keeper.decide(choice(10.5, {followed_, soon}, {slight_, later})), hits_in < 3.0);
  }
  for (const auto found : {plan::PlanStatus::no_route, plan::PlanStatus::closed,
                           plan::PlanStatus::retreat}) {
    PathKeeper::Choice out = choice(10.5, {followed_, soon}, {slight_, {}});
    out.found = found;
    EXPECT_FALSE(keeper.decide(out));
  }
}

TEST_F(Holding, leads_nobody_before_something_that_moves) {
  PathKeeper keeper(config_);
  Conflict before;
  before.time_to_collision = 2.0;
  Conflict cut = conflict(Conflict::State::oncoming, 3.0);
  cut.time_to_collision = 3.5;
  EXPECT_TRUE(keeper.decide(choice(10.0, {followed_, cut}, {slight_, before})));
  cut.time_to_collision = 1.5;
  EXPECT_FALSE(keeper.decide(choice(10.0, {followed_, cut}, {slight_, before})));
}

TEST_F(Holding, never_waits_with_no_time_to) {
  config_.hold_time = 0.0;
  EXPECT_DOUBLE_EQ(kept(longer_, conflict(Conflict::State::crossing)), 0.0);
  PathKeeper keeper(config_);
  EXPECT_FALSE(keeper.update(0.0, conflict(Conflict::State::crossing)));
  Conflict crossed = conflict(Conflict::State::crossing);
  crossed.wait_for = Blocker{1, 2.0, 1.5};
  EXPECT_FALSE(keeper.must_wait(crossed));
}

TEST_F(Holding, tells_to_wait_until_it_has_been_clear_for_a_while) {
  PathKeeper keeper(config_);
  Conflict crossed = conflict(Conflict::State::crossing);
  crossed.wait_for = Blocker{1, 2.0, 1.5};
  EXPECT_FALSE(keeper.waits_for());
  static_cast<void>(keeper.update(10.0, crossed));
  ASSERT_TRUE(keeper.waits_for());
  EXPECT_EQ(keeper.waits_for()->by, 1U);
  static_cast<void>(keeper.update(10.4, Conflict{}));
  EXPECT_TRUE(keeper.waits_for());
  static_cast<void>(keeper.update(10.6, Conflict{}));
  EXPECT_FALSE(keeper.waits_for());
}

TEST_F(Holding, names_what_closes_the_only_path_once_it_is_near_or_comes) {
  const PathKeeper keeper(config_);
  using State = Conflict::State;
  EXPECT_FALSE(keeper.blocker(std::nullopt, State::oncoming));
  EXPECT_FALSE(keeper.blocker(Conflict::Cut{7, 5.0}, State::stationary));
  EXPECT_TRUE(keeper.blocker(Conflict::Cut{7, 5.0}, State::oncoming));
  const auto near = keeper.blocker(Conflict::Cut{7, 2.5}, State::stationary);
  ASSERT_TRUE(near);
  EXPECT_EQ(near->by, 7U);
  EXPECT_EQ(near->at, 2.5);
  EXPECT_FALSE(near->time_to_clear);
}

TEST_F(Holding, wants_to_evade_what_comes_or_hits_either_way) {
  EXPECT_FALSE(PathKeeper(config_).evades(conflict(Conflict::State::crossing)));
  EXPECT_TRUE(PathKeeper(config_).evades(conflict(Conflict::State::oncoming)));
  Conflict either = conflict(Conflict::State::stationary);
  EXPECT_FALSE(PathKeeper(config_).evades(either));
  either.hits_waiting = true;
  EXPECT_TRUE(PathKeeper(config_).evades(either));
  config_.hold_time = 0.0;
  EXPECT_FALSE(PathKeeper(config_).evades(either));
}

/// A path of 14 m with nothing on it, and what a search may find.
class Keeping : public testing::Test {
 protected:
  bool keeps(plan::PlanStatus found, const Path& fresh,
             Guidance::Replan reason = Guidance::Replan::period) {
    choice_.time += 2.0;
    choice_.reason = reason;
    choice_.found = found;
    choice_.fresh.path = fresh;
    return keeper_.decide(choice_);
  }
  Keeping() {
    choice_.followed.path = round_;
    choice_.sees_waypoint = choice_.way_is_free = true;
  }
  PathKeeper keeper_{PathKeeperConfig{}};
  PathKeeper::Choice choice_;
  const Path straight_{{2, 5}, {14, 5}};
  const Path round_{{2, 5}, {2, 1}, {14, 1}, {14, 5}};
  const Path less_round_{{2, 5}, {2, 1.5}, {14, 1.5}, {14, 5}};
};

TEST_F(Keeping, keeps_a_path_that_is_hardly_longer) {
  const PathKeeper& keeper = keeper_;
  const auto on = [](double length) { return Path{{0, 0}, {length, 0}}; };
  EXPECT_FALSE(keeper.shorter(on(10.0), on(9.5)));
  EXPECT_FALSE(keeper.shorter(on(10.0), on(11.0)));
  EXPECT_TRUE(keeper.shorter(on(10.0), on(8.0)));
  EXPECT_FALSE(keeper.shorter(on(10.0), on(-8.0)));  // back
  EXPECT_TRUE(keeper.shorter(on(10.0), on(-4.0)));
  EXPECT_FALSE(keeper.shorter(on(10.0), {}));
}

TEST_F(Keeping, keeps_a_path_that_serves_and_leaves_it_for_one_that_is_much_shorter) {
  EXPECT_TRUE(keeps(plan::PlanStatus::found, less_round_));
  EXPECT_TRUE(keeps(plan::PlanStatus::no_route, {}));
  EXPECT_FALSE(keeps(plan::PlanStatus::found, straight_));
}

TEST_F(Keeping, leaves_a_path_for_a_new_goal_or_map_or_from_far_off_it) {
  EXPECT_FALSE(keeps(plan::PlanStatus::found, less_round_, Guidance::Replan::new_goal));
  EXPECT_FALSE(keeps(plan::PlanStatus::found, less_round_, Guidance::Replan::map_changed));
  choice_.strayed = true;
  EXPECT_FALSE(keeps(plan::PlanStatus::found, less_round_));
}

TEST_F(Keeping, leaves_a_path_that_is_cut_or_whose_way_point_is_out_of_sight) {
  choice_.sees_waypoint = false;
  EXPECT_FALSE(keeps(plan::PlanStatus::found, less_round_));
  choice_.sees_waypoint = true;
  choice_.way_is_free = false;
  EXPECT_FALSE(keeps(plan::PlanStatus::found, less_round_));
  choice_.way_is_free = true;
  choice_.followed.conflict.cut = Conflict::Cut{1, 4.0};
  EXPECT_FALSE(keeps(plan::PlanStatus::found, less_round_));
}

TEST_F(Keeping, leaves_a_free_path_for_one_on_which_something_is_hit_a_second_later) {
  const auto evades = [this](double followed, double fresh) {
    choice_.followed.conflict.hits_waiting = true;
    choice_.followed.conflict.time_to_collision = followed;
    choice_.fresh.conflict.time_to_collision = fresh;
    return !keeps(plan::PlanStatus::found, less_round_, Guidance::Replan::path_carved);
  };
  EXPECT_FALSE(evades(1.5, 1.5));
  EXPECT_FALSE(evades(1.5, 2.4));
  EXPECT_TRUE(evades(1.5, 2.6));
  EXPECT_TRUE(evades(1.5, kNever));
}

TEST_F(Keeping, keeps_a_path_that_was_closed_and_is_free_again) {
  choice_.mode = PathMode::closed;
  EXPECT_TRUE(keeps(plan::PlanStatus::found, less_round_));
  EXPECT_FALSE(keeps(plan::PlanStatus::found, straight_));
  choice_.followed.conflict.cut = Conflict::Cut{1, 4.0};
  EXPECT_FALSE(keeps(plan::PlanStatus::found, less_round_));
}

TEST_F(Keeping, keeps_a_closed_path_while_the_only_one_is_closed) {
  EXPECT_FALSE(keeps(plan::PlanStatus::closed, less_round_));
  choice_.mode = PathMode::closed;
  EXPECT_TRUE(keeps(plan::PlanStatus::closed, less_round_));
  EXPECT_FALSE(keeps(plan::PlanStatus::closed, straight_));
  EXPECT_FALSE(keeps(plan::PlanStatus::retreat, less_round_));
}

TEST_F(Keeping, keeps_a_retreat_until_it_is_cut_or_not_needed) {
  EXPECT_FALSE(keeps(plan::PlanStatus::retreat, {{2, 5}, {2, 7}}));
  choice_.mode = PathMode::retreat;
  EXPECT_TRUE(keeps(plan::PlanStatus::retreat, {{2, 5}, {2, 7}}));
  EXPECT_FALSE(keeps(plan::PlanStatus::closed, round_));
  EXPECT_FALSE(keeps(plan::PlanStatus::found, round_));
  choice_.followed.conflict.cut = Conflict::Cut{1, 1.0};
  EXPECT_FALSE(keeps(plan::PlanStatus::retreat, {{2, 5}, {2, 7}}));
}

}  // namespace
}  // namespace navvi_nav::guide
