#include "status/status.hpp"

#include <gtest/gtest.h>

#include <map>

namespace navvi_rviz::status {
namespace {

using navvi_types::CueEvent;
using navvi_types::CueKind;
using navvi_types::CueStage;
using navvi_types::DriveState;
using navvi_types::Guidance;

CueEvent said(CueKind kind, const std::string& text) {
  CueEvent cue;
  cue.stage = CueStage::started;
  cue.what = kind;
  cue.text = text;
  return cue;
}

Guidance in(Guidance::State state) {
  Guidance guidance;
  guidance.state = state;
  return guidance;
}

DriveState gate(DriveState::State state) {
  DriveState drive;
  drive.state = state;
  return drive;
}

CueEvent queued(CueKind kind, const std::string& text) {
  CueEvent cue = said(kind, text);
  cue.stage = CueStage::queued;
  return cue;
}

/// In a session of this language.
Status speaking(const std::string& language = "en") {
  Status status;
  status.use(Words(std::string(NAVVI_PHRASES) + "/" + language + ".yaml"));
  return status;
}

TEST(Status, of_nothing_is_empty) {
  const Shown shown = speaking().shown(0.0, 0.0);
  EXPECT_EQ(shown.banner, "");
  EXPECT_EQ(shown.instruction, "");
  EXPECT_EQ(shown.distance, "");
  EXPECT_FALSE(shown.clock);
}

TEST(Status, rounds_the_distance_as_the_voice_does_and_shows_none_to_a_goal_that_is_not_seen_yet) {
  Status status = speaking();
  Guidance guidance = in(Guidance::State::following);
  guidance.goal_distance = 1.4;
  status.take(guidance, 1.0);
  EXPECT_EQ(status.shown(1.0, 0.0).distance, "1.5 meters to go");
  status.use(Words(NAVVI_PHRASES "/es.yaml", "feet"));
  EXPECT_EQ(status.shown(1.0, 0.0).distance, "5 pies hasta la meta");
  guidance.ends_short = true;
  status.take(guidance, 1.0);
  EXPECT_EQ(status.shown(1.0, 0.0).distance, "");
}

TEST(Status, of_a_robot_that_fell_silent_neither_speed_nor_distance_is_shown) {
  Status status = speaking();
  status.take_speed(-0.4, 5.0);
  status.take(in(Guidance::State::following), 5.0);
  EXPECT_EQ(status.shown(5.5, 0.0).speed, 0.4);
  EXPECT_NE(status.shown(5.5, 0.0).distance, "");
  EXPECT_FALSE(status.shown(6.5, 0.0).speed);
  EXPECT_EQ(status.shown(6.5, 0.0).distance, "");
}

TEST(Status, shows_the_order_but_for_the_way_which_the_plate_shows) {
  using Tone = Shown::Tone;
  Status status = speaking();
  for (const auto& [kind, tone] : std::map<CueKind, Tone>{{CueKind::blocked, Tone::wait},
                                                          {CueKind::obstacle_stop, Tone::alarm},
                                                          {CueKind::press, Tone::wait},
                                                          {CueKind::lesson, Tone::wait},
                                                          {CueKind::make_room, Tone::wait},
                                                          {CueKind::no_way, Tone::alarm},
                                                          {CueKind::arrived, Tone::good}}) {
    status.take_order(said(kind, "as the guide has it"));
    EXPECT_EQ(status.shown(1.0, 0.0).banner, "as the guide has it") << to_string(kind);
    EXPECT_EQ(status.shown(1.0, 0.0).tone, tone) << to_string(kind);
  }
  status.take_order(said(CueKind::turn_ahead, "in 3 meters, 9 o'clock"));
  EXPECT_EQ(status.shown(2.0, 0.0).banner, "");
  EXPECT_EQ(status.shown(2.0, 0.0).instruction, "in 3 meters, 9 o'clock");
}

TEST(Status, an_order_that_has_ended_is_shown_no_more) {
  Status status = speaking();
  CueEvent order = said(CueKind::blocked, "wait, worker in the way");
  status.take_order(order);
  status.take(in(Guidance::State::following), 0.0);
  EXPECT_EQ(status.shown(100.0, 0.0).banner, "wait, worker in the way");
  order.stage = CueStage::ended;
  status.take_order(order);
  EXPECT_EQ(status.shown(100.0, 0.0).banner, "");
}

TEST(Status, wheels_that_stand_without_the_guide_are_shown_before_its_last_order) {
  Status status = speaking();
  status.take_order(said(CueKind::blocked, "wait, worker in the way"));
  status.take(gate(DriveState::State::stopped));
  EXPECT_EQ(status.shown(1.0, 0.0).banner, "robot stopped, release the stick");
}

TEST(Status, C8_why_the_wheels_stand_is_shown_where_the_guide_knows_it) {
  Status status = speaking();
  status.take(gate(DriveState::State::stopped));
  for (const CueKind kind : {CueKind::emergency_stop, CueKind::stick_lost, CueKind::robot_lost,
                             CueKind::connection_lost}) {
    status.take_order(said(kind, "as the guide has it"));
    EXPECT_EQ(status.shown(1.0, 0.0).banner, "as the guide has it") << to_string(kind);
    EXPECT_EQ(status.shown(1.0, 0.0).tone, Shown::Tone::alarm) << to_string(kind);
  }
}

TEST(Status, speaks_the_language_of_the_session_and_names_its_keys) {
  Status status = speaking("es");
  status.take_input("keyboard");
  status.take(gate(DriveState::State::stopped));
  EXPECT_EQ(status.shown(0.0, 0.0).banner, "robot detenido, suelte las teclas");
  EXPECT_EQ(status.words().of("lessons/key_6"), "intro") << "so does the button";
}

TEST(Status, missing_sound_is_shown_by_itself) {
  Status status = speaking();
  status.take(in(Guidance::State::following), 0.0);
  status.take_device("navvi/audio", "missing", 0.0);
  EXPECT_EQ(status.shown(0.0, 0.0).banner, "no sound");
  status.take_device("navvi/audio", "missing", 10.0);
  EXPECT_EQ(status.shown(11.0, 0.0).banner, "") << "it would hide the way";
  EXPECT_FALSE(status.shown(11.0, 0.0).sound);
}

TEST(Status, a_cue_that_was_never_spoken_is_not_shown) {
  Status status;
  CueEvent cue = said(CueKind::obstacle_stop, "stop, worker ahead");
  for (const CueStage stage : {CueStage::queued, CueStage::dropped, CueStage::ended}) {
    cue.stage = stage;
    status.take(cue, 0.0);
  }
  EXPECT_EQ(status.shown(0.0, 0.0).banner, "");
}

TEST(Status, where_nothing_can_be_heard_what_would_have_been_said_is_shown) {
  Status status = speaking();
  status.take_device("navvi/audio", "missing", 0.0);
  CueEvent cue = said(CueKind::direction, "turn to 2 o'clock, 5 meters");
  cue.stage = CueStage::dropped;
  status.take(cue, 0.0);
  EXPECT_EQ(status.shown(0.0, 0.0).instruction, "turn to 2 o'clock, 5 meters");
}

TEST(Status, the_menu_is_shown_while_it_is_open_whatever_else_is_said) {
  Status status = speaking();
  status.take(queued(CueKind::menu, "volume, 50 percent"), 0.0);
  status.take(said(CueKind::direction, "turn to 2 o'clock, 5 meters"), 1.0);
  EXPECT_EQ(status.shown(1.0, 0.0).menu, "volume, 50 percent");
  EXPECT_EQ(status.shown(1.0, 0.0).instruction, "turn to 2 o'clock, 5 meters");
  CueEvent lesson = queued(CueKind::lesson, "space repeats");
  lesson.what = navvi_types::Spoken(CueKind::lesson, "help");
  status.take(lesson, 1.0);
  EXPECT_EQ(status.shown(1.0, 0.0).menu, "volume, 50 percent");
  lesson.what = navvi_types::Spoken(CueKind::lesson, "glossary_welcome");
  status.take(lesson, 1.0);
  EXPECT_EQ(status.shown(1.0, 0.0).menu, "") << "it was chosen";
  status.take(queued(CueKind::menu, "volume, 50 percent"), 2.0);
  status.take(queued(CueKind::menu_closed, "menu closed"), 2.0);
  EXPECT_EQ(status.shown(2.0, 0.0).menu, "");
  status.take(queued(CueKind::menu, "begin the trial"), 3.0);
  status.take(navvi_types::TrialState{navvi_types::TrialState::State::running});
  EXPECT_EQ(status.shown(3.0, 0.0).menu, "") << "it was chosen";
}

TEST(Status, the_clock_is_right_for_a_picture_that_comes_later) {
  Status status = speaking();
  status.take(navvi_types::TrialState{navvi_types::TrialState::State::running, 10'000'000'000});
  EXPECT_EQ(status.shown(0.0, 70.0).clock, 60.0);
}

TEST(Status, the_clock_runs_from_the_trials_start_to_its_end) {
  Status status = speaking();
  status.take_event("TRIAL_START", 10.0);
  EXPECT_EQ(status.shown(0.0, 12.5).clock, 2.5);
  status.take_event("TRIAL_END", 14.0);
  EXPECT_EQ(status.shown(0.0, 99.0).clock, 4.0);
}

TEST(Status, the_panel_says_of_the_way_what_the_plate_says) {
  Status status = speaking();
  const auto shown = [&](double time) { return status.shown(time, 0.0).instruction; };
  status.take(said(CueKind::turn_ahead, "in 3 meters, turn to 9 o'clock"), 0.0);
  EXPECT_EQ(shown(0.0), "in 3 meters, turn to 9 o'clock");
  const auto order = [&](CueKind kind, const std::string& text) {
    status.take_order(said(kind, text));
  };
  order(CueKind::turn_ahead, "in 1.5 meters, 9 o'clock");
  EXPECT_EQ(shown(1.0), "in 1.5 meters, 9 o'clock");
  for (const CueKind kind : {CueKind::turn_now, CueKind::rerouted, CueKind::make_room}) {
    status.take(said(kind, "turn to 9 o'clock now"), 1.0);
    EXPECT_EQ(shown(1.0), "in 1.5 meters, 9 o'clock") << "it is older than the order";
  }
  status.take(said(CueKind::collision, "hit, shelf on the left"), 2.0);
  EXPECT_EQ(shown(2.0), "hit, shelf on the left") << "to be read first";
  EXPECT_EQ(shown(7.0), "in 1.5 meters, 9 o'clock");
  status.take(said(CueKind::straight, "drive straight, 4 meters"), 8.0);
  order(CueKind::straight, "straight");
  EXPECT_EQ(shown(8.0), "straight") << "it is less by now";
}

Shown with(const char* banner) {
  Shown shown;
  shown.banner = banner;
  shown.tone = *banner ? Shown::Tone::alarm : Shown::Tone::calm;
  return shown;
}

TEST(SteadyBanner, does_not_flash_whatever_trembles) {
  SteadyBanner banner;
  std::string last;
  int appeared = 0;
  for (int tick = 0; tick < 500; ++tick) {  // 10 s at 50 Hz
    const std::string now =
        banner.hold(with(tick % 2 == 0 ? "robot stopped" : ""), 0.02 * tick).banner;
    if (last.empty() && !now.empty()) ++appeared;
    last = now;
  }
  EXPECT_LE(appeared, 3 * 10);
  EXPECT_GE(appeared, 5);
}

TEST(SteadyBanner, shows_what_comes_after_calm_at_once_and_the_rest_as_it_is) {
  SteadyBanner banner;
  Shown shown = with("");
  EXPECT_EQ(banner.hold(shown, 0.0).banner, "");
  EXPECT_EQ(banner.hold(with("wait"), 1.0).banner, "wait");
  shown.instruction = "go on";
  EXPECT_EQ(banner.hold(shown, 1.1).banner, "wait");
  EXPECT_EQ(banner.hold(shown, 1.1).instruction, "go on");
  EXPECT_EQ(banner.hold(shown, 1.4).banner, "");
}

TEST(Status, the_banner_has_the_mover_that_it_names) {
  using navvi_types::ThingClass;
  Status status = speaking("es");
  status.take_order(said(CueKind::blocked, "espere, carretilla elevadora en el camino"));
  EXPECT_EQ(status.shown(1.0, 0.0).mover, ThingClass::forklift);
  status.take_order(said(CueKind::obstacle_stop, "pare, estantería a la izquierda"));
  EXPECT_FALSE(status.shown(2.0, 0.0).mover);
}

}  // namespace

}  // namespace navvi_rviz::status
