#include "cues/near_cues.hpp"

#include <gtest/gtest.h>

#include "near_cues_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

TEST_F(NearCuesTest, says_nothing_where_nothing_is_near) {
  EXPECT_EQ(pass(1.0, {}), Sides{});
  EXPECT_EQ(pass(1.0, {shelf(1.01, kLeft)}), Sides{});
}

TEST_F(NearCuesTest, says_once_that_a_shelf_or_wall_is_within_a_metre_and_on_which_side) {
  EXPECT_EQ(pass(5.0, {shelf(0.99, kLeft)}), Sides{Side::left});
  EXPECT_EQ(Content(last_), Content(CueKind::near, About::shelf));
  EXPECT_FALSE(last_.priority);
  EXPECT_EQ(pass(1.0, {{ThingClass::wall, 1, 0.5, kRight, false}}), Sides{Side::right});
  EXPECT_EQ(Content(last_), Content(CueKind::near, About::wall));
}

TEST_F(NearCuesTest, says_nothing_new_while_the_gap_trembles_on_the_border) {
  Sides said;
  for (int i = 0; i < 100; ++i)
    for (const Side side : pass(0.1, {shelf(i % 2 == 0 ? 0.98 : 1.15, kLeft)}))
      said.push_back(side);
  EXPECT_EQ(said, Sides{Side::left});
}

TEST_F(NearCuesTest, says_it_once_more_when_the_shelf_is_close) {
  pass(1.0, {shelf(0.9, kLeft)});
  EXPECT_EQ(Content(last_), Content(CueKind::near, About::shelf));
  EXPECT_EQ(pass(5.0, {shelf(0.3, kLeft)}), Sides{Side::left});
  EXPECT_EQ(Content(last_), Content(CueKind::close, About::shelf));
  pass(5.0, {});
  pass(1.0, {{ThingClass::wall, 1, 0.3, kRight, false}});
  EXPECT_EQ(Content(last_), Content(CueKind::close, About::wall));
}

TEST_F(NearCuesTest, says_both_sides_of_a_narrow_aisle_one_after_the_other) {
  const std::vector<NearThing> aisle = {shelf(0.8, kLeft), shelf(0.9, kRight)};
  EXPECT_EQ(pass(1.0, aisle), Sides{Side::left});
  EXPECT_EQ(pass(1.0, aisle), Sides{Side::right});
}

TEST_F(NearCuesTest, waits_for_the_voice_unless_the_robot_runs_into_it) {
  now_.voice_busy = true;
  EXPECT_EQ(pass(1.0, {shelf(0.9, kAhead)}), Sides{});
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(0.1, {shelf(0.9, kAhead)}), Sides{Side::ahead});
  EXPECT_EQ(last_.priority, Priority::message);
}

TEST_F(NearCuesTest, names_what_is_behind_only_while_the_robot_drives_back_and_nothing_passed) {
  const NearThing worker{ThingClass::worker, 3, 0.6, kBehind, true};
  const NearThing box{ThingClass::box, 4, 0.6, kLeft, false};
  for (const std::vector<NearThing>& things : {{shelf(0.9, kBehind)}, std::vector{worker, box}}) {
    now_.measured->linear = 0.5;
    EXPECT_EQ(pass(1.0, things), Sides{});
    now_.measured->linear = -0.5;
    EXPECT_EQ(pass(1.0, things), Sides{Side::behind});
  }
}

TEST_F(NearCuesTest, names_a_thing_once_that_the_robot_drives_towards) {
  const NearThing pedestal{ThingClass::pedestal, 3, 0.9, kAhead, false};
  EXPECT_EQ(pass(1.0, {pedestal}), Sides{}) << "the robot stands";
  now_.measured->linear = 0.5;
  now_.voice_busy = true;
  EXPECT_EQ(pass(5.0, {pedestal}), Sides{Side::ahead});
  EXPECT_EQ(Content(last_), Content(CueKind::near, About::obstacle));
  EXPECT_EQ(last_.fillings.thing, ThingClass::pedestal);
  EXPECT_EQ(last_.priority, Priority::message);
  EXPECT_EQ(pass(1.0, {{ThingClass::box, 4, 0.8, kAhead, false}}), Sides{Side::ahead});
  EXPECT_EQ(pass(1.0, {{ThingClass::box, 5, 1.1, kAhead, false}}), Sides{}) << "too far";
}

TEST_F(NearCuesTest, names_what_moves_about_once_more_if_the_robot_may_brush_it) {
  now_.measured->linear = 0.5;
  const auto worker = [](double gap, const Eigen::Vector2d& at) {
    return NearThing{ThingClass::worker, 3, gap, at, true};
  };
  EXPECT_EQ(pass(1.0, {worker(0.9, kAhead)}), Sides{Side::ahead});
  EXPECT_EQ(pass(2.0, {worker(0.3, kLeft)}), Sides{Side::left});
  EXPECT_EQ(Content(last_), Content(CueKind::close, About::obstacle));
  EXPECT_EQ(pass(5.0, {worker(0.2, kLeft)}), Sides{}) << "it was said";
  EXPECT_EQ(pass(9.0, {}), Sides{});
  EXPECT_EQ(pass(2.0, {worker(0.3, {-0.1, 1.3})}), Sides{}) << "it is left behind";
}

TEST_F(NearCuesTest, names_by_its_side_what_is_ahead_but_will_be_passed) {
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(1.0, {shelf(0.9, {1.1, 0.7})}), Sides{Side::left});
}

TEST_F(NearCuesTest, names_a_thing_again_only_after_it_was_gone_for_a_while) {
  now_.measured->linear = 0.5;
  for (NearThing thing : {NearThing{ThingClass::box, 4, 0.9, kAhead, false}, shelf(0.9, kLeft)}) {
    EXPECT_EQ(pass(1.0, {thing}).size(), 1U);
    thing.gap = 1.15;
    EXPECT_EQ(pass(3.0, {thing}), Sides{});
    thing.gap = 1.3;
    EXPECT_EQ(pass(1.0, {thing}), Sides{});
    thing.gap = 0.9;
    EXPECT_EQ(pass(1.0, {thing}), Sides{});
    EXPECT_EQ(pass(9.0, {}), Sides{});
    EXPECT_EQ(pass(1.0, {thing}).size(), 1U);
  }
}

TEST_F(NearCuesTest, adds_nothing_to_a_collision) {
  now_.measured->linear = 0.5;
  const NearThing box{ThingClass::box, 4, 0.0, kAhead, false};
  for (const NearThing& hit : {box, shelf(0.0, kLeft)}) {
    now_.contacts = {{hit.thing_class, hit.nearest, hit.id}};
    EXPECT_EQ(pass(0.02, {hit}), Sides{});
    now_.contacts.clear();
    EXPECT_EQ(pass(5.0, {hit}), Sides{});
  }
}

TEST_F(NearCuesTest, leaves_everything_else_to_the_hands_where_that_is_wanted) {
  NearConfig config;
  config.obstacles = false;
  cues_ = NearCues(config);
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(1.0, {{ThingClass::forklift, 1, 0.5, kAhead, true},
                       {ThingClass::box, 2, 0.2, kLeft, false}}),
            Sides{});
}

}  // namespace
}  // namespace navvi_feedback::cues
