#include "cues/near_cues.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::cues {
namespace {

NearThing shelf(double gap, const Eigen::Vector2d& nearest) {
  return {ThingClass::shelf, 7, gap, nearest, false};
}

const Eigen::Vector2d kLeft(0.1, 1.3);
const Eigen::Vector2d kRight(0.1, -1.3);
const Eigen::Vector2d kAhead(1.3, 0.1);
const Eigen::Vector2d kBehind(-1.3, 0.1);

class NearCuesTest : public testing::Test {
 protected:
  NearCuesTest() { now_.measured.emplace(); }

  /// The sides said within `seconds` of a situation, in order.
  std::vector<Side> pass(double seconds, const std::vector<NearThing>& nearby) {
    now_.nearby = nearby;
    std::vector<Side> sides;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02) {
      for (const Utterance& utterance : cues_.update(now_, true, {}, time_)) {
        sides.push_back(*utterance.fillings.side);
        last_ = utterance;
      }
    }
    return sides;
  }

  NearCues cues_{NearConfig{}};
  Situation now_;
  Utterance last_;
  double time_ = 10.0;
};

using Sides = std::vector<Side>;

TEST(InsteadOf, is_a_sound_for_what_is_near_where_its_family_is_heard) {
  const Utterance shelf{CueKind::wall_close, {{}, {}, ThingClass::wall, Side::left}};
  const Utterance worker{CueKind::obstacle_near, {{}, {}, ThingClass::worker, Side::right}};
  const Utterance stop{CueKind::obstacle_stop, {{}, {}, ThingClass::worker, Side::ahead}};
  const Sounds all{true, true, true};
  EXPECT_FALSE(instead_of(shelf, {true, false, true}));
  EXPECT_FALSE(instead_of(worker, {true, true, false}));
  EXPECT_FALSE(instead_of(stop, all));
  EXPECT_EQ(instead_of(shelf, all).value().earcon, sounds::Earcon::shelf_close);
  EXPECT_GT(instead_of(shelf, all).value().from.y(), 0.9);
  EXPECT_EQ(instead_of(worker, all).value().earcon, sounds::Earcon::worker_near);
  EXPECT_LT(instead_of(worker, all).value().from.y(), -0.9);
}

TEST_F(NearCuesTest, says_nothing_where_nothing_is_near) {
  EXPECT_EQ(pass(1.0, {}), Sides{});
  EXPECT_EQ(pass(1.0, {shelf(1.01, kLeft)}), Sides{});
}

TEST_F(NearCuesTest, says_once_that_a_shelf_is_within_a_metre_and_on_which_side) {
  EXPECT_EQ(pass(5.0, {shelf(0.99, kLeft)}), Sides{Side::left});
  EXPECT_EQ(last_.kind, CueKind::shelf_near);
  EXPECT_FALSE(last_.priority);
}

TEST_F(NearCuesTest, says_nothing_new_while_the_gap_trembles_on_the_border) {
  Sides said;
  for (int i = 0; i < 100; ++i)
    for (const Side side : pass(0.1, {shelf(i % 2 == 0 ? 0.98 : 1.15, kLeft)}))
      said.push_back(side);
  EXPECT_EQ(said, Sides{Side::left});
}

TEST_F(NearCuesTest, says_it_again_after_the_shelf_was_gone_for_a_while) {
  pass(1.0, {shelf(0.9, kLeft)});
  pass(1.0, {});
  EXPECT_EQ(pass(1.0, {shelf(0.9, kLeft)}), Sides{});
  pass(9.0, {});
  EXPECT_EQ(pass(1.0, {shelf(0.9, kLeft)}), Sides{Side::left});
}

TEST_F(NearCuesTest, says_it_once_more_when_the_shelf_is_close) {
  pass(1.0, {shelf(0.9, kLeft)});
  EXPECT_EQ(last_.kind, CueKind::shelf_near);
  EXPECT_EQ(pass(5.0, {shelf(0.3, kLeft)}), Sides{Side::left});
  EXPECT_EQ(last_.kind, CueKind::shelf_close);
  pass(5.0, {});
  pass(1.0, {{ThingClass::wall, 1, 0.3, kRight, false}});
  EXPECT_EQ(last_.kind, CueKind::wall_close);
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

TEST_F(NearCuesTest, names_what_is_behind_only_while_the_robot_drives_back) {
  EXPECT_EQ(pass(1.0, {shelf(0.9, kBehind)}), Sides{});
  now_.measured->linear = -0.5;
  EXPECT_EQ(pass(1.0, {shelf(0.9, kBehind)}), Sides{Side::behind});
}

TEST_F(NearCuesTest, speaks_of_walls_too) {
  EXPECT_EQ(pass(1.0, {{ThingClass::wall, 1, 0.5, kRight, false}}), Sides{Side::right});
  EXPECT_EQ(last_.kind, CueKind::wall_near);
}

TEST_F(NearCuesTest, names_a_thing_once_that_the_robot_drives_towards) {
  const NearThing pedestal{ThingClass::pedestal, 3, 0.9, kAhead, false};
  EXPECT_EQ(pass(1.0, {pedestal}), Sides{}) << "the robot stands";
  now_.measured->linear = 0.5;
  now_.voice_busy = true;
  EXPECT_EQ(pass(5.0, {pedestal}), Sides{Side::ahead});
  EXPECT_EQ(last_.kind, CueKind::obstacle_near);
  EXPECT_EQ(last_.fillings.thing, ThingClass::pedestal);
  EXPECT_EQ(last_.priority, Priority::message);
  EXPECT_EQ(pass(1.0, {{ThingClass::box, 4, 0.8, kAhead, false}}), Sides{Side::ahead});
  EXPECT_EQ(pass(1.0, {{ThingClass::box, 5, 1.1, kAhead, false}}), Sides{}) << "too far";
}

TEST_F(NearCuesTest,
       names_a_thing_behind_only_while_the_robot_drives_back_and_none_that_is_passed) {
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(1.0, {{ThingClass::worker, 3, 0.6, kBehind, true},
                       {ThingClass::box, 4, 0.6, kLeft, false}}),
            Sides{});
  now_.measured->linear = -0.5;
  EXPECT_EQ(pass(1.0, {{ThingClass::worker, 3, 0.6, kBehind, true},
                       {ThingClass::box, 4, 0.6, kLeft, false}}),
            Sides{Side::behind});
}

TEST_F(NearCuesTest, names_what_moves_about_once_more_if_the_robot_may_brush_it) {
  now_.measured->linear = 0.5;
  const auto worker = [](double gap, const Eigen::Vector2d& at) {
    return NearThing{ThingClass::worker, 3, gap, at, true};
  };
  EXPECT_EQ(pass(1.0, {worker(0.9, kAhead)}), Sides{Side::ahead});
  EXPECT_EQ(pass(2.0, {worker(0.3, kLeft)}), Sides{Side::left});
  EXPECT_EQ(last_.kind, CueKind::obstacle_close);
  EXPECT_EQ(pass(5.0, {worker(0.2, kLeft)}), Sides{}) << "it was said";
  EXPECT_EQ(pass(9.0, {}), Sides{});
  EXPECT_EQ(pass(2.0, {worker(0.3, {-0.1, 1.3})}), Sides{}) << "it is left behind";
}

TEST_F(NearCuesTest, names_by_its_side_what_is_ahead_but_will_be_passed) {
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(1.0, {shelf(0.9, {1.1, 0.7})}), Sides{Side::left});
}

/// From `from` on, `seconds` of a thing that nears by `speed` along x.
class StopTest : public NearCuesTest {
 protected:
  std::vector<Side> approach(const NearThing& at_first, double speed, double seconds) {
    std::vector<Side> sides;
    NearThing thing = at_first;
    for (double left = seconds; left > 0.0; left -= 0.02) {
      thing.nearest.x() -= std::copysign(speed * 0.02, thing.nearest.x());
      thing.gap -= speed * 0.02;
      gap_ = thing.gap;
      for (const Side side : pass(0.02, {thing})) sides.push_back(side);
      if (!sides.empty()) break;
    }
    return sides;
  }
  double gap_ = 0.0;
};

TEST_F(StopTest, what_moves_is_stopped_for_by_the_time_to_collision) {
  now_.measured->linear = 0.9;
  EXPECT_EQ(approach({ThingClass::forklift, 3, 4.0, {4.4, 0.0}, true}, 1.5, 2.0),
            Sides{Side::ahead});
  EXPECT_EQ(last_.kind, CueKind::obstacle_stop);
  EXPECT_NEAR(gap_ / 1.5, 2.5, 0.1) << "s before the collision";
}

TEST_F(StopTest, so_is_a_shelf_but_later_if_the_guide_turns_off_before_it) {
  now_.measured->linear = 0.9;
  EXPECT_EQ(approach({ThingClass::shelf, 3, 3.0, {3.4, 0.0}, false}, 0.9, 3.0), Sides{Side::ahead});
  EXPECT_EQ(last_.kind, CueKind::obstacle_stop);
  EXPECT_NEAR(gap_ / 0.9, 1.5, 0.1);
  pass(20.0, {});
  now_.guidance.emplace();
  now_.guidance->state = Guidance::State::following;
  now_.guidance->waypoint_distance = 0.5;
  approach({ThingClass::wall, 4, 3.0, {3.4, 0.0}, false}, 0.9, 3.0);
  while (last_.kind != CueKind::obstacle_stop && gap_ > 0.1)
    approach({ThingClass::wall, 4, gap_, {gap_ + 0.4, 0.0}, false}, 0.9, 3.0);
  EXPECT_EQ(last_.kind, CueKind::obstacle_stop);
  EXPECT_NEAR(gap_ / 0.9, 1.0, 0.25);
}

TEST_F(StopTest, a_shelf_that_the_robot_slowly_nears_abeam_is_stopped_for) {
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(5.0, {shelf(0.2, {0.0, 0.55})}), Sides{Side::left});
  // Its nearest point slides along the face.
  double gap = 0.2;
  Sides said;
  for (; gap > 0.0 && said.empty(); gap -= 0.05 * 0.02)
    said = pass(0.02, {shelf(gap, {0.0, 0.35 + gap})});
  EXPECT_EQ(said, Sides{Side::left});
  EXPECT_EQ(last_.kind, CueKind::obstacle_stop);
  EXPECT_GT(gap, 0.01);
}

TEST_F(StopTest,
       who_drives_along_a_shelf_hears_stop_once_then_a_sound_then_stop_at_the_last_moment) {
  now_.measured->linear = 0.4;
  now_.sounds.shelf = true;
  double gap = 0.0;
  const auto near = [&](double from) {
    Sides said;
    for (gap = from; gap > 0.0 && said.empty(); gap -= 0.05 * 0.02)
      said = pass(0.02, {shelf(gap, {0.0, 0.35 + gap})});
    EXPECT_EQ(said, Sides{Side::left});
    return last_.kind;
  };
  pass(1.0, {shelf(0.2, {0.0, 0.55})});
  EXPECT_EQ(near(0.2), CueKind::obstacle_stop);
  pass(3.0, {shelf(0.2, {0.0, 0.55})});
  EXPECT_EQ(near(0.2), CueKind::shelf_close);
  EXPECT_EQ(last_.priority, Priority::message);
  EXPECT_EQ(near(gap), CueKind::obstacle_stop) << "who does not keep off";
  EXPECT_GT(gap, 0.05);
  now_.sounds.shelf = false;
  pass(4.0, {shelf(0.2, {0.0, 0.55})});
  EXPECT_EQ(near(0.2), CueKind::obstacle_stop) << "where there are no sounds";
}

TEST_F(StopTest, a_shelf_is_stopped_for_1_5_s_before_it_at_the_speed_driven_however_that_began) {
  std::uint32_t id = 100;
  for (const double first : {0.15, 0.3, 0.6, 1.0, 2.0})
    for (const double fastest : {0.3, 0.6, 0.9})
      for (const double degrees : {0.0, 25.0, 50.0}) {
        pass(12.0, {});
        ++id;
        last_ = {};
        // Along the nose, towards a face that is turned.
        const Eigen::Vector2d normal(std::cos(degrees * M_PI / 180.0),
                                     std::sin(degrees * M_PI / 180.0));
        double gap = first;
        double speed = 0.0;
        while (last_.kind != CueKind::obstacle_stop && gap > 0.0) {
          now_.commanded.linear = now_.measured->linear = speed;
          pass(0.02, {{ThingClass::shelf, id, gap, (gap + 0.35) * normal, false}});
          if (last_.kind == CueKind::obstacle_stop) break;
          speed = std::min(fastest, speed + 1.2 * 0.02);
          gap -= 0.02 * speed * normal.x();
        }
        EXPECT_GE(gap / (speed * normal.x()), 1.5)
            << first << " m, " << fastest << " m/s, " << degrees << " degrees";
        now_.commanded.linear = now_.measured->linear = 0.0;
      }
}

TEST_F(StopTest, what_is_passed_is_not_stopped_for) {
  now_.measured->linear = 0.9;
  for (double x = 3.0; x > -3.0; x -= 0.018) {
    const Eigen::Vector2d at(x, 0.8);
    pass(0.02, {{ThingClass::box, 3, at.norm() - 0.35, at, false}});
    EXPECT_NE(last_.kind, CueKind::obstacle_stop);
  }
}

TEST_F(StopTest, who_drives_on_at_it_is_told_again) {
  now_.measured->linear = 0.3;
  const auto pallet = [&](double gap) {
    return NearThing{ThingClass::pallet_robot, 3, gap, {gap + 0.4, 0.0}, true};
  };
  approach(pallet(2.0), 0.3, 9.0);
  EXPECT_EQ(last_.kind, CueKind::obstacle_near);
  EXPECT_EQ(approach(pallet(gap_), 0.3, 1.0), Sides{Side::ahead});
  EXPECT_EQ(last_.kind, CueKind::obstacle_stop);
  EXPECT_EQ(approach(pallet(gap_), 0.1, 2.0), Sides{});
  EXPECT_EQ(approach(pallet(gap_), 0.1, 3.0), Sides{Side::ahead});
  EXPECT_EQ(last_.kind, CueKind::obstacle_stop);
}

TEST_F(StopTest, a_robot_that_stands_hears_what_comes_and_from_where) {
  EXPECT_EQ(approach({ThingClass::pallet_robot, 3, 4.0, {-4.4, 0.0}, true}, 1.0, 4.0),
            Sides{Side::behind});
  EXPECT_EQ(last_.kind, CueKind::obstacle_comes);
  EXPECT_EQ(approach({ThingClass::pallet_robot, 3, gap_, {-gap_ - 0.4, 0.0}, true}, 1.0, 1.0),
            Sides{})
      << "it was said";
}

TEST_F(StopTest, a_robot_that_stands_hears_nothing_of_what_only_turns_past_it) {
  Eigen::Vector2d at(2.5, 2.0);
  double heading = -M_PI;
  for (int i = 0; i < 300; ++i, heading += 1.2 * 0.02) {
    at += 0.02 * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    EXPECT_EQ(pass(0.02, {{ThingClass::forklift, 3, at.norm() - 0.35, at, true}}), Sides{})
        << at.transpose();
  }
}

TEST_F(StopTest, what_was_stopped_for_is_told_again_from_the_side_once_it_is_a_danger_anew) {
  now_.measured->linear = 0.3;
  NearThing robot{ThingClass::pallet_robot, 3, 2.0, {2.4, 0.0}, true};
  while (last_.kind != CueKind::obstacle_stop && robot.gap > 0.1) {
    approach(robot, 0.3, 1.0);
    robot.gap = gap_;
    robot.nearest.x() = gap_ + 0.4;
  }
  ASSERT_EQ(last_.kind, CueKind::obstacle_stop);
  pass(3.0, {robot});  // it is waited for, and then driven past, too near
  robot = {ThingClass::pallet_robot, 3, 0.4, {0.5, -0.6}, true};
  Sides said;
  for (; robot.gap > 0.0 && said.empty(); robot.gap -= 0.006) {
    robot.nearest = Eigen::Vector2d(0.5, -0.6).normalized() * (robot.gap + 0.38);
    said = pass(0.02, {robot});
  }
  EXPECT_EQ(said, Sides{Side::right});
}

TEST_F(NearCuesTest, names_a_thing_again_only_after_it_was_gone_for_a_while) {
  now_.measured->linear = 0.5;
  const auto box = [](double gap) { return NearThing{ThingClass::box, 4, gap, kAhead, false}; };
  EXPECT_EQ(pass(1.0, {box(0.9)}), Sides{Side::ahead});
  EXPECT_EQ(pass(3.0, {box(1.15)}), Sides{});
  EXPECT_EQ(pass(1.0, {box(1.3)}), Sides{});
  EXPECT_EQ(pass(1.0, {box(0.9)}), Sides{});
  EXPECT_EQ(pass(8.5, {}), Sides{});
  EXPECT_EQ(pass(1.0, {box(0.9)}), Sides{Side::ahead});
}

TEST_F(NearCuesTest, adds_nothing_to_a_collision_with_a_thing) {
  now_.measured->linear = 0.5;
  now_.contacts = {{ThingClass::box, kAhead, 4}};
  EXPECT_EQ(pass(0.02, {{ThingClass::box, 4, 0.0, kAhead, false}}), Sides{});
  now_.contacts.clear();
  EXPECT_EQ(pass(5.0, {{ThingClass::box, 4, 0.0, kAhead, false}}), Sides{});
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

TEST_F(NearCuesTest, adds_nothing_to_a_collision) {
  now_.contacts = {{ThingClass::shelf, kLeft}};
  EXPECT_EQ(pass(0.02, {shelf(0.0, kLeft)}), Sides{});
  now_.contacts.clear();
  EXPECT_EQ(pass(5.0, {shelf(0.0, kLeft)}), Sides{});
}

TEST(InsteadOf, sounds_stand_for_what_is_near_and_for_no_other_words) {
  const Sounds all{true, true, true};
  for (const CueKind kind : phrase_kinds()) {
    Utterance told{kind};
    told.fillings.thing = ThingClass::shelf;
    told.fillings.side = Side::left;
    EXPECT_EQ(instead_of(told, all).has_value(), is_near(family_of(kind))) << to_string(kind);
  }
  EXPECT_FALSE(instead_of({CueKind::menu_closed}, all)) << "a menu is not a thing";
}

}  // namespace
}  // namespace navvi_feedback::cues
