#include "cues/route_cues.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_feedback::cues {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTick = 0.02;

double rad(double degrees) { return degrees * kPi / 180.0; }

Guidance following(double degrees, double distance) {
  Guidance guidance;
  guidance.state = Guidance::State::following;
  guidance.goal = {20.0, 5.0};
  guidance.waypoint = {10.0, 0.0};
  guidance.waypoint_angle = guidance.steer_angle = rad(degrees);
  guidance.waypoint_distance = distance;
  guidance.turn_angle = rad(90.0);
  guidance.goal_distance = 25.0;
  return guidance;
}

/// A drive as it is told: what was said at which second.
class Drive {
 public:
  explicit Drive(const RouteConfig& config = {}) : cues(config) { now.measured.emplace(); }

  /// Lets `seconds` pass in this situation and returns the kinds that were said.
  std::vector<CueKind> pass(double seconds) {
    std::vector<CueKind> kinds;
    for (const double end = time + seconds; time < end - 1e-9; time += kTick) {
      for (const Utterance& utterance : cues.update(now, false, time)) {
        kinds.push_back(utterance.kind);
        last = utterance;
      }
    }
    return kinds;
  }

  /// After the introduction and the first direction, so that only news is said.
  void settle(double degrees, double distance) {
    now.guidance = following(degrees, distance);
    now.commanded.linear = 1.0;
    now.measured->linear = 1.0;
    pass(3.0);
  }

  /// Of a person who was told to stop.
  Utterances go_on() {
    EXPECT_TRUE(cues.update(now, true, time += kTick).empty());
    return cues.go_on(now, time);
  }

  RouteCues cues;
  Situation now;
  Utterance last;
  double time = 100.0;
};

using Kinds = std::vector<CueKind>;

TEST(RouteCues, leave_corrections_to_the_sound_while_it_is_heard) {
  for (const bool sound : {true, false}) {
    Drive drive;
    drive.now.sounds.turn = sound;
    drive.settle(0.0, 20.0);
    Kinds said;
    for (const double off : {30.0, -30.0, 60.0, 0.0}) {
      drive.now.guidance = following(off, 15.0);
      const Kinds more = drive.pass(3.0);
      said.insert(said.end(), more.begin(), more.end());
    }
    EXPECT_EQ(said.empty(), sound);
  }
}

TEST(RouteCues, say_a_turn_once_and_no_bend_where_a_sound_leads_round) {
  for (const double turn : {90.0, 30.0}) {
    for (const bool announced : {true, false}) {
      Drive drive;
      drive.now.sounds.turn = true;
      drive.settle(0.0, 20.0);
      drive.now.guidance = following(0.0, 5.0);
      drive.now.guidance->turn_angle = announced ? rad(turn) : 0.0;
      const bool worth_words = turn > 45.0;
      EXPECT_EQ(drive.pass(3.0), worth_words && announced ? Kinds{CueKind::turn_ahead} : Kinds{});
      drive.now.guidance->waypoint_distance = 0.5;
      drive.pass(1.0);
      drive.now.guidance = following(turn, 12.0);
      drive.now.guidance->waypoint = {10.0, 12.0};
      EXPECT_EQ(drive.pass(3.0), worth_words && !announced ? Kinds{CueKind::turn_now} : Kinds{});
      drive.now.guidance->steer_angle = 0.0;
      EXPECT_EQ(drive.pass(3.0), worth_words && announced ? Kinds{CueKind::straight} : Kinds{});
    }
  }
}

TEST(RouteCues, introduce_a_new_goal_and_then_the_way_to_it) {
  Drive drive;
  drive.now.guidance = following(90.0, 8.0);
  drive.now.goal_angle = rad(-60.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::start});
  EXPECT_EQ(drive.last.fillings.hour, 10);
  EXPECT_DOUBLE_EQ(*drive.last.fillings.distance, 25.0);
  drive.now.voice_busy = true;
  EXPECT_EQ(drive.pass(2.0), Kinds{});
  drive.now.voice_busy = false;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::direction});
  EXPECT_EQ(drive.last.fillings.hour, 3);
  EXPECT_DOUBLE_EQ(*drive.last.fillings.distance, 8.0);
}

TEST(RouteCues, introduce_a_goal_whose_bearing_is_unknown_by_its_distance) {
  Drive drive;
  drive.now.guidance = following(90.0, 8.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::start_distance});
}

TEST(RouteCues, say_nothing_of_an_angle_that_is_no_number) {
  Drive drive;
  drive.now.guidance = following(std::nan(""), 8.0);
  EXPECT_EQ(drive.pass(10.0), Kinds{});
  drive.now.guidance = following(0.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(drive.pass(10.0), Kinds{});
  EXPECT_FALSE(drive.cues.ask(*drive.now.guidance, drive.time));
}

TEST(RouteCues, do_not_say_by_themselves_what_was_just_answered) {
  Drive drive;
  drive.settle(0.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.pass(6.0);
  EXPECT_EQ(drive.cues.ask(*drive.now.guidance, drive.time).value().kind, CueKind::straight);
  EXPECT_EQ(drive.pass(19.0), Kinds{});
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::straight});
}

TEST(RouteCues, send_nobody_straight_ahead_into_a_thing_that_the_path_avoids) {
  Drive drive;
  drive.settle(10.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  EXPECT_EQ(drive.cues.ask(*drive.now.guidance, drive.time).value().kind, CueKind::straight);
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.4, {0.7, 0.2}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight});
  EXPECT_EQ(drive.last.fillings.side, Side::right);
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.4, {0.2, -0.7}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight}) << "on the way's side, and not in the way";
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.4, {0.2, 0.7}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight}) << "the way leads off from it";
}

TEST(RouteCues, lead_off_from_what_is_all_but_touched_however_straight_the_path) {
  Drive drive;
  drive.settle(0.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.03, {0.02, 0.4}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight});
  EXPECT_EQ(drive.last.fillings.side, Side::right);
  drive.now.nearby.push_back(NearThing{ThingClass::shelf, 2, 0.05, {0.02, -0.4}, false});
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight}) << "between two";
}

TEST(RouteCues, send_nobody_aside_into_a_thing) {
  Drive drive;
  drive.settle(8.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  EXPECT_EQ(drive.cues.ask(*drive.now.guidance, drive.time).value().kind, CueKind::straight);
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.55, {0.78, -0.45}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{}) << "30 degrees to the right is where it stands";
}

TEST(RouteCues, lead_aside_and_ahead_again_only_once_the_angle_has_clearly_changed) {
  Drive drive;
  drive.settle(7.5, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.45, {0.8, 0.2}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight});
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(6.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{});
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(3.0);
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight});
}

TEST(RouteCues, judge_a_new_leg_afresh) {
  Drive drive;
  drive.settle(0.0, 1.5);
  drive.now.guidance = following(17.0, 8.0);
  drive.now.guidance->waypoint = {10.0, 8.0};
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::turn_now});
  EXPECT_EQ(drive.last.fillings.hour, 1) << "17 degrees would still be held as 12 on the old leg";
}

TEST(RouteCues, call_a_new_route_just_before_a_corner_by_its_name) {
  Drive drive;
  drive.settle(0.0, 1.5);
  drive.now.guidance = following(90.0, 8.0);
  drive.now.guidance->waypoint = {10.0, 8.0};
  drive.now.guidance->reroutes = 1;
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::rerouted});
}

TEST(RouteCues, repeat_the_direction_while_the_robot_faces_elsewhere) {
  Drive drive;
  drive.settle(90.0, 8.0);
  EXPECT_EQ(drive.pass(18.0), (Kinds{CueKind::direction, CueKind::direction, CueKind::direction}));
}

TEST(RouteCues, say_the_direction_again_to_who_turns_away_from_it) {
  Drive drive;
  drive.settle(25.0, 12.0);
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(38.0);
  EXPECT_EQ(drive.pass(1.0), Kinds{});
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(44.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::direction}) << "although it is the same hour";
}

TEST(RouteCues, repeat_half_as_often_while_the_stick_rests) {
  Drive drive;
  drive.settle(90.0, 8.0);
  drive.now.commanded = {};
  drive.pass(12.0);
  EXPECT_EQ(drive.pass(24.0).size(), 2U);
}

TEST(RouteCues, repeat_straight_ahead_seldom) {
  Drive drive;
  drive.settle(0.0, 30.0);
  EXPECT_EQ(drive.pass(40.0), (Kinds{CueKind::straight, CueKind::straight}));
}

TEST(RouteCues, correct_only_beyond_the_hysteresis) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(18.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{});
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(21.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::direction});
  EXPECT_EQ(drive.last.fillings.hour, 1);
}

TEST(RouteCues, leave_out_the_hours_that_a_turning_robot_passes_and_say_when_to_stop) {
  Drive drive;
  drive.settle(90.0, 8.0);
  drive.now.measured = Velocity{0.0, -1.0};
  double degrees = 90.0;
  Kinds said;
  double angle_when_told = 0.0;
  while (degrees > 0.0) {
    degrees -= kTick / kPi * 180.0;
    drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(degrees);
    for (const CueKind kind : drive.pass(kTick)) {
      said.push_back(kind);
      angle_when_told = degrees;
    }
  }
  EXPECT_EQ(said, Kinds{CueKind::straight});
  EXPECT_EQ(drive.last.priority, Priority::message);
  EXPECT_GT(angle_when_told, 20.0) << "a person needs a moment to stop";
  EXPECT_LT(angle_when_told, 60.0);
}

TEST(RouteCues, tell_a_robot_that_turned_too_far_once_it_has_settled) {
  Drive drive;
  drive.settle(90.0, 8.0);
  drive.now.measured = Velocity{0.0, -1.0};
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(10.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::straight});
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(-30.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{});
  drive.now.measured = Velocity{};
  EXPECT_EQ(drive.pass(1.0), Kinds{CueKind::direction});
  EXPECT_EQ(drive.last.fillings.hour, 11);
}

TEST(RouteCues, announce_a_turn_once_ahead_and_once_when_the_corner_is_reached) {
  Drive drive;
  drive.settle(0.0, 12.0);
  Kinds said;
  for (double distance = 12.0; distance > 1.0; distance -= kTick) {
    drive.now.guidance->waypoint_distance = distance;
    for (const CueKind kind : drive.pass(kTick)) {
      if (kind == CueKind::turn_ahead) {
        EXPECT_LE(distance, 6.0);
        EXPECT_GT(distance, 4.0);
        EXPECT_EQ(drive.last.fillings.hour, 3);
      }
      said.push_back(kind);
    }
  }
  EXPECT_EQ(std::count(said.begin(), said.end(), CueKind::turn_ahead), 1);
  drive.now.guidance = following(80.0, 9.0);
  drive.now.guidance->waypoint = {10.0, -10.0};
  drive.now.voice_busy = true;  // it does not wait for a lesser cue to end
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::turn_now});
  EXPECT_EQ(drive.last.fillings.hour, 3);
}

TEST(RouteCues, name_the_turn_where_straight_ahead_alone_would_lead_past_it) {
  Drive drive;
  drive.settle(90.0, 3.0);
  drive.now.guidance = following(0.0, 3.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::straight_then});
  EXPECT_EQ(drive.last.fillings.hour, 3);
  EXPECT_EQ(drive.pass(10.0), Kinds{}) << "the turn was announced";
}

TEST(RouteCues, say_that_an_announced_turn_falls_away) {
  Drive drive;
  drive.settle(0.0, 12.0);
  drive.now.guidance->waypoint_distance = 5.0;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::turn_ahead});
  drive.now.guidance = following(0.0, 14.0);
  drive.now.guidance->waypoint = {20.0, 0.0};
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::turn_cancelled});
}

TEST(RouteCues, keep_an_announced_turn_that_a_plan_moves_a_little) {
  Drive drive;
  drive.settle(0.0, 12.0);
  drive.now.guidance->waypoint_distance = 4.0;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::turn_ahead});
  drive.now.guidance = following(0.0, 5.5);
  drive.now.guidance->waypoint = {11.5, 0.0};
  EXPECT_EQ(drive.pass(6.0), Kinds{});
}

TEST(RouteCues, are_silent_while_the_person_is_to_stop_and_then_say_the_direction) {
  Drive drive;
  drive.settle(0.0, 30.0);
  for (double end = drive.time + 10.0; drive.time < end; drive.time += kTick)
    EXPECT_TRUE(drive.cues.update(drive.now, true, drive.time).empty());
  EXPECT_EQ(drive.go_on().at(0).kind, CueKind::straight);
  EXPECT_EQ(drive.pass(5.0), Kinds{}) << "it was just said";
}

TEST(RouteCues, keep_quiet_about_a_turn_at_the_goal) {
  Drive drive;
  drive.now.guidance = following(0.0, 5.0);
  drive.now.guidance->waypoint_is_goal = true;
  const Kinds said = drive.pass(20.0);
  EXPECT_EQ(std::count(said.begin(), said.end(), CueKind::turn_ahead), 0);
}

TEST(RouteCues, keep_quiet_after_a_replan_that_changes_nothing_to_do) {
  Drive drive;
  drive.settle(0.0, 30.0);
  for (int plan = 0; plan < 3; ++plan) {
    drive.now.guidance->replan_reason = Guidance::Replan::period;
    drive.now.guidance->waypoint += Eigen::Vector2d(plan % 2 == 0 ? 1.5 : -1.5, 0.2);
    EXPECT_EQ(drive.pass(1.5), Kinds{}) << plan;
  }
}

TEST(RouteCues, say_a_new_route_if_the_next_manoeuvre_changed) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.now.guidance->waypoint = {0.0, -12.0};
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(150.0);
  drive.now.guidance->waypoint_distance = 12.0;
  EXPECT_EQ(drive.pass(1.0), Kinds{CueKind::rerouted});
  EXPECT_EQ(drive.last.fillings.hour, 5);
}

TEST(RouteCues, say_that_the_old_way_is_blocked_once_for_each_reroute) {
  Drive drive;
  drive.settle(0.0, 30.0);
  const auto lead_to = [&drive](double x, double degrees) {
    drive.now.guidance->waypoint = {x, -12.0};
    drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(degrees);
  };
  drive.now.guidance->reroutes = 1;
  drive.now.guidance->reroute_reason = Guidance::Replan::path_carved;
  lead_to(0.0, 150.0);
  EXPECT_EQ(drive.pass(1.0), Kinds{CueKind::rerouted_blocked});
  lead_to(9.0, 60.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::rerouted});
}

TEST(RouteCues, say_a_route_that_changed_while_the_person_waited) {
  for (const bool sound : {true, false})
    for (const auto& [angle, hour] : {std::pair(120.0, 4), std::pair(0.0, 12)}) {
      Drive drive;
      drive.now.sounds.turn = sound;
      drive.settle(0.0, 30.0);
      drive.now.guidance->reroutes = 1;
      drive.now.guidance->waypoint = {0.0, -12.0};
      drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(angle);
      const Utterances on = drive.go_on();
      ASSERT_EQ(on.size(), 1U);
      EXPECT_EQ(on[0].kind, CueKind::rerouted);
      EXPECT_EQ(on[0].fillings.hour, hour);
      EXPECT_EQ(drive.pass(2.0), Kinds{});
    }
}

TEST(RouteCues, call_no_route_new_whose_way_was_told) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.now.guidance = following(0.0, 3.0);
  drive.now.guidance->reroutes = 1;
  drive.now.guidance->waypoint = {0.0, -12.0};
  EXPECT_EQ(drive.go_on().at(0).kind, CueKind::rerouted);
  const RouteCues told = drive.cues;
  drive.cues.pause(false);
  drive.now.guidance->steer_angle = rad(-30.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::direction});
  drive.cues = told;
  drive.cues.lost(CueKind::straight_then);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::rerouted});
}

TEST(RouteCues, say_straight_ahead_in_a_turn_not_more_than_an_hour_too_early) {
  Drive drive;
  drive.settle(90.0, 8.0);
  drive.now.commanded = {0.0, -1.2};
  drive.now.measured->linear = 0.0;
  drive.now.measured->angular = -1.2;
  const auto face = [&drive](double degrees) {
    drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(degrees);
    return drive.pass(kTick);
  };
  EXPECT_EQ(face(60.0), Kinds{});
  EXPECT_EQ(face(45.0), Kinds{});  // half a second later it would face it
  EXPECT_EQ(face(29.0), Kinds{CueKind::straight});
  EXPECT_EQ(face(10.0), Kinds{});
}

TEST(RouteCues, let_a_turn_by_one_hour_end_by_itself) {
  for (const double side : {1.0, -1.0}) {
    Drive drive;
    drive.settle(side * 30.0, 8.0);
    drive.now.measured->linear = 0.0;
    drive.now.measured->angular = -side * 1.2;
    for (const double degrees : {30.0, 25.0, 15.0, 5.0, -5.0, -10.0}) {
      drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(side * degrees);
      EXPECT_EQ(drive.pass(kTick), Kinds{}) << degrees;
    }
    drive.now.measured->angular = 0.0;
    EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::straight});
  }
}

TEST(RouteCues, do_not_correct_a_robot_that_is_about_to_pass_the_corner_near_enough) {
  Drive drive;
  drive.settle(0.0, 8.0);
  drive.now.guidance->waypoint_distance = 1.4;
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(28.0);
  EXPECT_EQ(drive.pass(1.0), Kinds{});
}

TEST(RouteCues, do_not_waver_between_the_hours_ahead_just_before_the_way_point) {
  Drive drive;
  drive.settle(0.0, 8.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.now.guidance->waypoint_distance = 0.95;
  Kinds said;
  for (int i = 0; i < 10; ++i) {
    drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle =
        rad(i % 2 == 0 ? -40.0 : 0.0);
    for (const CueKind kind : drive.pass(2.0)) said.push_back(kind);
  }
  EXPECT_EQ(said, Kinds{});
  EXPECT_TRUE(drive.cues.ask(*drive.now.guidance, drive.time)) << "who asks is told";
  drive.pass(2.0);
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(100.0);
  EXPECT_EQ(drive.pass(1.0), Kinds{CueKind::direction}) << "who missed it is told";
}

TEST(RouteCues, tell_a_person_who_stands_just_before_the_way_point_to_go_on) {
  Drive drive;
  drive.settle(0.0, 0.9);
  drive.now.commanded = {};
  EXPECT_FALSE(drive.pass(20.0).empty());
}

TEST(RouteCues, say_the_direction_again_after_a_stop) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.cues.remind(drive.time + 1.0);
  EXPECT_EQ(drive.pass(0.9), Kinds{});
  EXPECT_EQ(drive.pass(0.2), Kinds{CueKind::straight});
}

TEST(RouteCues, say_the_direction_when_the_path_is_back_without_a_new_introduction) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.cues.pause(false);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::straight});
  drive.cues.pause(true);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::start_distance});
}

/// A person with the stick: reacts to words after a second, turns by an hour's angle with an error,
/// and drives on when told that the way is straight ahead.
class Person {
 public:
  explicit Person(double error) : error_(error) {}

  void hear(const Utterance& utterance, double time) {
    heard_ = {time + 1.0, utterance};
    busy_until_ = time + 1.6;
    ++words;
  }

  Velocity command(double time) {
    if (heard_ && time >= heard_->first) {
      if (heard_->second.kind == CueKind::straight ||
          heard_->second.kind == CueKind::straight_then) {
        turn_left_ = 0.0;
        drives_ = true;
      } else if (heard_->second.kind != CueKind::turn_ahead) {
        const double turn = *heard_->second.fillings.hour * kPi / 6.0;
        turn_left_ = error_ * std::remainder(turn, 2.0 * kPi);
        drives_ = true;
      }
      heard_.reset();
    }
    if (std::abs(turn_left_) < 0.8 * kTick) turn_left_ = 0.0;
    const double rate = turn_left_ > 0.0 ? -0.8 : turn_left_ < 0.0 ? 0.8 : 0.0;
    turn_left_ += rate * kTick;
    return {rate == 0.0 && drives_ ? 0.8 : 0.0, rate};
  }

  [[nodiscard]] bool listens(double time) const { return time < busy_until_; }

  int words = 0;

 private:
  double error_;
  double turn_left_ = 0.0;  // rad, clockwise
  bool drives_ = false;
  double busy_until_ = 0.0;
  std::optional<std::pair<double, Utterance>> heard_;
};

/// Leads a person along a path of four corners, and checks that they get there without much talk.
void lead(const RouteConfig& config, double error) {
  const std::vector<Eigen::Vector2d> path = {{12.0, 0.0}, {12.0, 9.0}, {0.0, 9.0}, {-3.0, 14.0}};
  RouteCues cues(config);
  Person person(error);
  Eigen::Vector2d position(0.0, 0.0);
  double heading = 2.5;
  std::size_t next = 0;
  Situation now;
  now.measured.emplace();
  double time = 0.0;
  for (; time < 120.0; time += kTick) {
    if ((path[next] - position).norm() < 1.0 && ++next == path.size()) break;
    const Eigen::Vector2d to = path[next] - position;
    now.guidance = following(0.0, to.norm());
    now.guidance->waypoint = path[next];
    now.guidance->goal = path.back();
    now.guidance->waypoint_is_goal = next + 1 == path.size();
    now.guidance->waypoint_angle = now.guidance->steer_angle =
        -std::remainder(std::atan2(to.y(), to.x()) - heading, 2.0 * kPi);
    now.voice_busy = person.listens(time);
    for (const Utterance& utterance : cues.update(now, false, time))
      if (utterance.fillings.hour) person.hear(utterance, time);
    now.commanded = person.command(time);
    now.measured = now.commanded;
    heading += now.commanded.angular * kTick;
    position +=
        now.commanded.linear * kTick * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  }
  EXPECT_EQ(next, path.size()) << "got as far as corner " << next;
  EXPECT_LT(person.words, 45);
}

TEST(RouteCues, bring_a_person_who_only_hears_to_the_goal) {
  for (const char* rounding : {"nearest", "floor"}) {
    for (const double error : {0.8, 1.0, 1.2}) {
      SCOPED_TRACE(std::string(rounding) + ", turns by " + std::to_string(error) + " of the hour");
      RouteConfig config;
      config.rounding = rounding;
      lead(config, error);
    }
  }
}

TEST(RouteCues, name_once_the_thing_to_make_room_for_and_then_the_way) {
  Drive drive;
  drive.settle(0.0, 12.0);
  drive.now.guidance = following(170.0, 3.0);
  drive.now.guidance->state = Guidance::State::make_room;
  drive.now.guidance->blocked_by = ThingClass::forklift;
  drive.now.voice_busy = true;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::make_room});
  EXPECT_EQ(drive.last.fillings.thing, ThingClass::forklift);
  EXPECT_EQ(drive.last.fillings.hour, 6);
  EXPECT_EQ(drive.pass(1.0), Kinds{});
  drive.now.voice_busy = false;
  EXPECT_EQ(drive.pass(6.0), Kinds{CueKind::direction}) << "words alone lead";
  drive.now.guidance = following(0.0, 12.0);
  drive.pass(6.0);
  drive.now.guidance = following(90.0, 3.0);
  drive.now.guidance->state = Guidance::State::make_room;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::make_room});
}

}  // namespace
}  // namespace navvi_feedback::cues
