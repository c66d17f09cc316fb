#include "navvi_nav/hold.hpp"

#include <gtest/gtest.h>

namespace navvi_nav {
namespace {

/// A path of 13 m, and ways around what cuts it.
class Holding : public testing::Test {
 protected:
  static Way way(Way::State state, double meets_in = 10.0) {
    return {state, 4.0, meets_in, std::nullopt};
  }
  /// Asks every 0.5 s. \returns s for which a path is kept after a search
  double kept(const Path& fresh, const Way& way) {
    Hold hold(config_);
    double time = 10.0;
    while (time < 30.0 && hold.keeps(time, way, followed_, fresh)) time += 0.5;
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

TEST_F(Holding, leads_nobody_back_for_what_comes_from_afar_but_takes_another_way) {
  EXPECT_DOUBLE_EQ(kept(back_, way(Way::State::comes, 10.0)), config_.hold_time);
  EXPECT_DOUBLE_EQ(kept({}, way(Way::State::comes, 10.0)), config_.hold_time);
  EXPECT_DOUBLE_EQ(kept(back_, way(Way::State::comes, 3.0)), 0.0);
  EXPECT_DOUBLE_EQ(kept(slight_, way(Way::State::comes, 10.0)), 0.0);
  EXPECT_DOUBLE_EQ(kept(longer_, way(Way::State::comes, 10.0)), 0.0);
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
  crossed.state = Way::State::stands;  // waiting for the one does not help with the other
  EXPECT_FALSE(hold.must_wait(crossed));
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
