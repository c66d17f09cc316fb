#include "cues/collision_warning.hpp"

#include <gtest/gtest.h>

#include "near_cues_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

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

TEST_F(StopTest, what_leads_all_the_time_stops_later_but_the_hand_feels_it_before_the_ear_hears_it) {
  now_.measured->linear = 0.9;
  std::uint32_t id = 3;
  for (const auto& [lead, seconds] : {std::pair{Lead::flow, 0.75}, {Lead::hand, 1.125}}) {
    now_.lead = lead;
    last_ = {};
    approach({ThingClass::shelf, ++id, 3.0, {3.4, 0.0}, false}, 0.9, 3.2);
    while (last_.kind != CueKind::obstacle_stop && gap_ > 0.1)
      approach({ThingClass::shelf, id, gap_, {gap_ + 0.4, 0.0}, false}, 0.9, 3.2);
    EXPECT_EQ(last_.kind, CueKind::obstacle_stop);
    EXPECT_NEAR(gap_ / 0.9, seconds, 0.1);
    pass(20.0, {});
  }
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
    return Content(last_);
  };
  pass(1.0, {shelf(0.2, {0.0, 0.55})});
  EXPECT_EQ(near(0.2), CueKind::obstacle_stop);
  pass(3.0, {shelf(0.2, {0.0, 0.55})});
  EXPECT_EQ(near(0.2), Content(CueKind::close, About::shelf));
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
  EXPECT_EQ(Content(last_), Content(CueKind::near, About::obstacle));
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

}  // namespace
}  // namespace navvi_feedback::cues
