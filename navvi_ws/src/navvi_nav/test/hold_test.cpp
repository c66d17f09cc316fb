#include "navvi_nav/hold.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_nav {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A path of 13 m, and ways around what cuts it.
class Holding : public testing::Test {
 protected:
  static Way way(Way::State state, double meets_in = 10.0) {
    Way way;
    way.state = state;
    way.at = 4.0;
    way.meets_in = meets_in;
    way.hits_in = state == Way::State::clears ? kNever : 1.0;
    return way;
  }
  /// Asks every 0.5 s. \returns s for which a path is kept after a search
  double kept(const Path& fresh, const Way& way) {
    Hold hold(config_);
    double time = 10.0;
    while (time < 30.0 && hold.keeps(time, {followed_, way}, {fresh, {}})) time += 0.5;
    return time - 10.0;
  }
  const Path followed_ = {{0, 0}, {5, 0}, {5, 8}};
  const Path longer_ = {{0, 0}, {5, -6}, {12, 0}, {5, 8}};
  const Path back_ = {{0, 0}, {-1.5, 0.5}, {5, 8}};
  const Path slight_ = {{0, 0}, {5, 0}, {6, 4}, {5, 8}};
  HoldConfig config_;
};

TEST_F(Holding, waits_for_what_crosses_whatever_else_there_is) {
  for (const Path& fresh : {longer_, back_, slight_, Path{}})
    EXPECT_DOUBLE_EQ(kept(fresh, way(Way::State::clears)), config_.hold_time);
}

TEST_F(Holding, evades_what_comes_only_when_it_is_close) {
  for (const Path& fresh : {longer_, back_, slight_, Path{}})
    EXPECT_DOUBLE_EQ(kept(fresh, way(Way::State::comes, 10.0)), 20.0);  // as long as it was asked
  for (const Path& fresh : {back_, slight_, Path{}})
    EXPECT_DOUBLE_EQ(kept(fresh, way(Way::State::comes, 3.0)), 0.0);
}

TEST_F(Holding, leads_nobody_a_long_way_round_at_once_for_what_comes) {
  EXPECT_DOUBLE_EQ(kept(longer_, way(Way::State::comes, 3.0)), config_.hold_time);
  config_.hold_detour = 50.0;
  EXPECT_DOUBLE_EQ(kept(longer_, way(Way::State::comes, 3.0)), 0.0);
}

TEST_F(Holding, changes_nothing_while_somebody_waits_in_safety) {
  Way waited = way(Way::State::comes, 3.0);
  waited.wait = Way::Wait{1, 2.0, -1.0};
  EXPECT_DOUBLE_EQ(kept(slight_, waited), config_.hold_time);
  waited.hits_waiting = true;
  waited.hits_in = 2.0;
  EXPECT_DOUBLE_EQ(kept(slight_, waited), 0.0);
}

TEST_F(Holding, does_not_wait_for_what_stands) {
  EXPECT_DOUBLE_EQ(kept(longer_, way(Way::State::stands)), 0.0);
  EXPECT_DOUBLE_EQ(kept({}, way(Way::State::stands)), 0.0);
}

TEST_F(Holding, waits_anew_once_the_path_was_free) {
  Hold hold(config_);
  const Way crossed = way(Way::State::clears);
  ASSERT_TRUE(hold.waits(0.0, crossed));
  ASSERT_TRUE(hold.waits(5.0, crossed));
  ASSERT_FALSE(hold.waits(5.5, Way{}));
  EXPECT_TRUE(hold.waits(6.0, crossed));
  EXPECT_TRUE(hold.waits(13.5, crossed));
  EXPECT_FALSE(hold.waits(14.5, crossed));
}

TEST_F(Holding, makes_a_person_wait_only_for_what_crosses_right_before_them) {
  const Hold hold(config_);
  Way crossed = way(Way::State::clears);
  EXPECT_FALSE(hold.must_wait(crossed));  // who goes on runs into nothing
  crossed.wait = Way::Wait{1, 2.0, 1.5};
  EXPECT_TRUE(hold.must_wait(crossed));
  crossed.wait->at = 8.0;
  EXPECT_FALSE(hold.must_wait(crossed));
  crossed.wait->at = 2.0;
  crossed.state = Way::State::stands;  // what else there may be
  EXPECT_TRUE(hold.must_wait(crossed));
}

TEST_F(Holding, evades_what_runs_into_who_waits_if_there_is_a_safer_way) {
  Way crossed = way(Way::State::clears);
  crossed.wait = Way::Wait{1, 2.0, 1.5};
  crossed.hits_waiting = true;
  crossed.hits_in = 2.0;
  EXPECT_DOUBLE_EQ(kept(slight_, crossed), 0.0);
  EXPECT_DOUBLE_EQ(kept({}, crossed), config_.hold_time);
}

TEST_F(Holding, keeps_what_was_just_chosen_unless_something_would_be_run_into) {
  for (const double hits_in : {kNever, 4.0, 2.0}) {
    Hold hold(config_);
    Way cut = way(Way::State::stands);
    cut.hits_in = hits_in;
    const auto kept = [&](double time) {
      return hold.keeps(time, {followed_, cut}, {longer_, {}});
    };
    EXPECT_FALSE(kept(10.0));
    hold.chose(10.0);
    EXPECT_EQ(kept(10.5), hits_in > config_.hold_choice);
    EXPECT_EQ(kept(12.9), hits_in > config_.hold_choice);
    EXPECT_FALSE(kept(13.1));
  }
}

TEST_F(Holding, leads_nobody_before_something_that_moves) {
  Hold hold(config_);
  Way before;
  before.hits_in = 2.0;
  Way cut = way(Way::State::comes, 3.0);
  cut.hits_in = 3.5;
  EXPECT_TRUE(hold.keeps(10.0, {followed_, cut}, {slight_, before}));
  cut.hits_in = 1.5;
  EXPECT_FALSE(hold.keeps(10.0, {followed_, cut}, {slight_, before}));
}

TEST_F(Holding, never_waits_with_no_time_to) {
  config_.hold_time = 0.0;
  EXPECT_DOUBLE_EQ(kept(longer_, way(Way::State::clears)), 0.0);
  Hold hold(config_);
  EXPECT_FALSE(hold.waits(0.0, way(Way::State::clears)));
  Way crossed = way(Way::State::clears);
  crossed.wait = Way::Wait{1, 2.0, 1.5};
  EXPECT_FALSE(hold.must_wait(crossed));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
