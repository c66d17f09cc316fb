#include "trial/trial_keeper.hpp"

#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "record/trial_folder.hpp"
#include "trials.hpp"

namespace navvi_study::trial {
namespace {

TEST_F(Trials, T2_wait_for_every_part_and_name_what_is_missing) {
  begin();
  wait(6.0);
  EXPECT_TRUE(said("No trial yet: waiting for"));
  EXPECT_TRUE(folders().empty());
  wait(60.0);
  EXPECT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 3);
  EXPECT_TRUE(said("after 60 s what is missing is still"));
  EXPECT_TRUE(folders().empty());
}

TEST_F(Trials, set_the_goal_of_the_scenario_and_end_when_it_is_reached) {
  offer();
  live(1.0);
  ASSERT_FALSE(goals_.empty());
  EXPECT_EQ(goals_.front().x(), 5.0);
  ASSERT_GE(events_.size(), 2U);
  EXPECT_EQ(events_[0], "TRIAL_START");
  EXPECT_EQ(events_[1], "GOAL_SET");
  EXPECT_TRUE(holds("journal.csv", "world=hall"));
  EXPECT_TRUE(holds("journal.csv", ";contact_seq=0;")) << "of a world of its own";
  EXPECT_TRUE(holds("journal.csv", ";contacts=counted;"));
  live(1.0, State::following, kScenario.goal);
  EXPECT_FALSE(happened("TRIAL_END"));
  live(0.1, State::arrived, kScenario.goal);
  live(9.0, State::arrived, kScenario.goal);
  EXPECT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 0);
  EXPECT_EQ(events_.back(), "BAG_CLOSED");
  EXPECT_TRUE(holds("summary.csv", "reached"));
  EXPECT_TRUE(said("result: reached"));
}

TEST_F(Trials, call_contacts_unknown_where_nothing_tells_of_them) {
  contacts_ = false;
  offer();
  live(1.0);
  EXPECT_TRUE(holds("journal.csv", ";contacts=unknown;")) << "whatever the parameter says";
}

TEST_F(Trials, leave_a_track_that_grows_while_they_run_and_figures_of_it) {
  offer();
  live(3.0);
  live(3.0, State::following, kScenario.goal);
  keeper_->take(Hands{now().ros_ns, 0.5, 0.0, false}, now());
  const auto before = record::parse_track(content("track.npy"));
  ASSERT_TRUE(before);
  EXPECT_GT(before->size(), 20u) << "what a killed node leaves";
  live(3.0, State::following, kScenario.goal);
  live(9.0, State::arrived, kScenario.goal);
  const record::Trial trial = record::read_trial(folders().back());
  ASSERT_GT(trial.track.size(), before->size());
  EXPECT_GE(trial.track.front().time, trial.begin());
  EXPECT_LE(trial.track.back().time, trial.end());
  EXPECT_EQ(trial.track.back().stick_forward, 0.5F);
  EXPECT_EQ(trial.track.front().odom_x, trial.track.front().x);
  EXPECT_EQ(content("summary.csv"), record::summary_csv(record::summarize(trial)));
}

TEST_F(Trials, name_another_clock_while_they_run_and_leave_it_out_of_the_events) {
  begin();
  keeper_->take(ClockOffset{"lsl", 1}, now());
  keeper_->take(kScenario, now());
  live(1.0);
  keeper_->take(ClockOffset{"lsl", -4321}, now());
  live(1.0, State::following, kScenario.goal);
  live(9.0, State::arrived, kScenario.goal);
  EXPECT_EQ(times("CLOCK_OFFSET"), 1);
  EXPECT_TRUE(holds("journal.csv", "source=lsl;offset_ns=-4321"));
  EXPECT_FALSE(holds("events.csv", "CLOCK_OFFSET"));
  EXPECT_TRUE(holds("summary.csv", "reached"));
}

TEST_F(Trials, T4_are_invalid_where_the_guide_arrives_and_the_robot_does_not) {
  offer();
  live(1.0);
  live(20.0, State::following, kScenario.goal);
  elsewhere_ = true;
  live(9.0, State::arrived, kScenario.goal);
  EXPECT_TRUE(keeper_->done());
  EXPECT_TRUE(happened("ARRIVED_ELSEWHERE"));
  EXPECT_FALSE(happened("GOAL_REACHED"));
  EXPECT_TRUE(holds("summary.csv", ",invalid,arrived_elsewhere,"));
}

TEST_F(Trials, T4_go_on_where_reports_are_stamped_far_ahead_and_say_so_once) {
  for (const double limit : {0.0, 100.0}) {
    config_.out = (folder_ / (limit > 0.0 ? "limit" : "none")).string();
    config_.limit = limit;
    said_.clear();
    run();
    const std::int64_t ahead = now().ros_ns + 3600'000'000'000;
    keeper_->take(Odometry{ahead, {{time_, 0.0}}}, now());
    keeper_->take(Proximity{ahead, {}}, now());
    keeper_->take(StateHash{ahead, 1, 2}, now());
    live(3.0, State::following, kScenario.goal);
    live(9.0, State::arrived, kScenario.goal);
    const record::Trial trial = record::read_trial(folders().back());
    EXPECT_TRUE(holds("summary.csv", ",reached,goal_reached,"));
    EXPECT_NEAR(trial.end() - trial.begin(), 4.5, 0.5);
    EXPECT_NEAR(trial.track.back().time, trial.end(), 0.1);
    const auto at = said_.find("A report is stamped 3600.0 s ahead of ROS time and was dropped");
    ASSERT_NE(at, said_.npos) << said_;
    EXPECT_EQ(said_.find("ahead of ROS time", at + 60), said_.npos);
  }
}

TEST_F(Trials, begin_when_the_person_says_so_and_count_from_then) {
  using Wants = TrialState::State;
  config_.press_to_start = true;
  begin();
  press();
  keeper_->take(kScenario, now());
  live(100.0);
  EXPECT_EQ(shown_, (std::vector{Wants::preparing, Wants::ready})) << "pressed too early";
  EXPECT_TRUE(events_.empty());
  EXPECT_TRUE(goals_.empty());

  press();
  live(1.0);
  EXPECT_EQ(shown_.back(), Wants::running);
  ASSERT_TRUE(happened("TRIAL_START"));
  EXPECT_TRUE(holds("journal.csv", "pressed=101.0"));
  live(5.0, State::following, kScenario.goal);
  live(0.1, State::arrived, kScenario.goal);
  EXPECT_EQ(shown_.back(), Wants::preparing) << "the stick rests at once";
  live(9.0, State::arrived, kScenario.goal);
  EXPECT_TRUE(holds("summary.csv", ",goal_reached,6.1"));
}

TEST_F(Trials, are_separated_by_a_pause_in_which_a_goal_can_be_chosen_again_and_again) {
  using Wants = TrialState::State;
  config_.press_to_start = true;
  config_.once = false;
  begin();
  live(1.0);
  EXPECT_EQ(shown_.back(), Wants::choose_goal);
  press();
  keeper_->take_goal({3.0, 0.0}, now());
  keeper_->take_goal({4.0, 0.0}, now());
  live(1.0, State::following, {4.0, 0.0});
  EXPECT_EQ(shown_.back(), Wants::ready);
  EXPECT_TRUE(events_.empty());
  press();
  live(1.0, State::following, {4.0, 0.0});
  EXPECT_TRUE(holds("journal.csv", "goal_x=4.0"));
  EXPECT_TRUE(holds("journal.csv", ";contact_seq=n/a;")) << "of a robot that came from elsewhere";
  press(TrialRequest::Kind::end);
  live(9.0);
  EXPECT_TRUE(happened("TRIAL_END"));
  EXPECT_TRUE(said("reason: ended_by_person"));
  EXPECT_EQ(shown_.back(), Wants::choose_goal);
  EXPECT_EQ(times("TRIAL_START"), 1);
}

TEST_F(Trials, are_to_a_goal_that_was_chosen_while_the_one_before_was_closed) {
  config_.once = false;
  begin();
  live(1.0);
  const Eigen::Vector2d refused(500.0, 0.0);
  const Eigen::Vector2d next(4.0, 0.0);
  keeper_->take_goal(refused, now());
  live(0.5, State::goal_refused, refused);
  ASSERT_TRUE(happened("TRIAL_END"));
  keeper_->take_goal(next, now());
  live(9.0, State::following, next);
  EXPECT_EQ(times("TRIAL_START"), 2) << "none without a record";
  EXPECT_TRUE(holds("journal.csv", "goal_x=4.0"));
}

TEST_F(Trials, keep_their_goal_when_another_one_is_refused) {
  run();
  const Eigen::Vector2d bad(500.0, 0.0);
  keeper_->take_goal(bad, now());
  goals_.clear();
  live(0.1, State::goal_refused, bad);
  ASSERT_FALSE(goals_.empty());
  EXPECT_EQ(goals_.back(), kScenario.goal);
  live(1.0, State::following, kScenario.goal);
  EXPECT_FALSE(happened("TRIAL_END"));
  EXPECT_TRUE(happened("GOAL_REFUSED"));
  live(0.1, State::arrived, kScenario.goal);
  live(9.0, State::arrived, kScenario.goal);
  EXPECT_TRUE(holds("summary.csv", "reached"));
}

TEST_F(Trials, lead_back_to_no_goal_that_was_given_up_for_another_which_was_followed) {
  run();
  const Eigen::Vector2d other(3.0, 0.0);
  keeper_->take_goal(other, now());
  live(1.0, State::following, other);
  goals_.clear();
  live(9.0, State::goal_refused, other);
  EXPECT_TRUE(goals_.empty());
  EXPECT_TRUE(holds("summary.csv", ",refused,"));
}

/// A newer stamp would be the person's second ask, by which they are led toward the unseen.
TEST_F(Trials, N12_send_a_goal_again_with_the_stamp_of_the_persons_message_and_the_worlds_without) {
  config_.once = false;
  offer();
  live(5.0);
  ASSERT_GE(goals_.size(), 2U);
  EXPECT_EQ(stamps_, std::vector<std::int64_t>(goals_.size(), 0));
  live(1.0, State::following, kScenario.goal);
  stamps_.clear();
  const std::int64_t asked = now().ros_ns;
  keeper_->take_goal({3.0, 0.0}, now(), asked);
  live(5.0, State::following, kScenario.goal);  // it is not taken
  EXPECT_GE(stamps_.size(), 1U);
  live(1.0, State::following, {3.0, 0.0});
  keeper_->take_goal({500.0, 0.0}, now(), now().ros_ns);
  live(0.1, State::goal_refused, {500.0, 0.0});
  live(0.1, State::following, {3.0, 0.0});
  EXPECT_EQ(stamps_, std::vector<std::int64_t>(stamps_.size(), asked)) << "nor when restored";
}

/// The guide's last word on the last trial's goal may still be on its way.
TEST_F(Trials, that_begin_with_a_goal_which_was_refused_wait_for_what_is_said_of_it_now) {
  config_.once = false;
  begin();
  live(1.0);
  const Eigen::Vector2d unseen(500.0, 0.0);
  keeper_->take_goal(unseen, now(), now().ros_ns);
  live(9.0, State::goal_refused, unseen);
  ASSERT_TRUE(said("result: refused"));
  keeper_->take_goal(unseen, now(), now().ros_ns);
  live(0.2, State::goal_refused, unseen);
  ++plans_;
  live(9.0, State::following, unseen);
  EXPECT_EQ(times("TRIAL_END"), 1);
  ++plans_;
  live(9.0, State::goal_refused, unseen);
  EXPECT_EQ(times("TRIAL_END"), 2);
}

TEST_F(Trials, of_a_study_end_when_anybody_else_sets_a_goal) {
  config_.locked = true;
  run();
  keeper_->take_goal({3.0, 0.0}, now());
  live(9.0, State::following, kScenario.goal);
  EXPECT_TRUE(holds("summary.csv", ",aborted,goal_changed,"));
}

TEST_F(Trials, of_a_study_that_have_not_begun_take_nobodys_goal) {
  for (const bool job : {false, true}) {
    config_.job = job ? folder_.write("job.yaml", "- {name: table, x: 3, y: 0}\n") : "";
    config_.out = (folder_ / (job ? "job" : "world")).string();
    config_.press_to_start = config_.locked = true;
    said_.clear();
    offer();
    live(1.0);
    keeper_->take_goal({9.0, 0.0}, now());
    live(1.0);
    press();
    live(1.0);
    ASSERT_FALSE(goals_.empty());
    EXPECT_EQ(goals_.back(), job ? Eigen::Vector2d(3.0, 0.0) : kScenario.goal);
    EXPECT_TRUE(said("A goal was set from outside, with no effect."));
  }
}

TEST_F(Trials, P3_of_a_study_record_each_parameter_that_is_set_from_outside) {
  config_.locked = true;
  offer();
  live(1.0);
  live(2.0, State::following, kScenario.goal);
  EXPECT_FALSE(happened("PARAMETER_SET"));
  settings_ = {{"feedback/haptics/enabled", "0"}};
  live(2.0, State::following, kScenario.goal);
  EXPECT_EQ(times("PARAMETER_SET"), 2);
  EXPECT_TRUE(holds("journal.csv", ";name=feedback/haptics/enabled;value=0;"));
  EXPECT_TRUE(holds("journal.csv", ";name=sim/seed;value=deleted;"));
}

TEST_F(Trials, of_a_study_name_their_place_in_it_and_on_what_they_ran) {
  config_.study.condition = "no_touch";
  config_.study.order = 2;
  offer();
  live(1.0);
  for (const char* field :
       {";condition=no_touch;phase=n/a;replaces=n/a;session=n/a;condition_order=2;",
        ";audio_device=", ";compiler=GCC", ";bullet=3."})
    EXPECT_TRUE(holds("journal.csv", field)) << field;
  live(1.0, State::following, kScenario.goal);
  live(9.0, State::arrived, kScenario.goal);
  EXPECT_TRUE(holds("summary.csv", ",condition,condition_order,"));
  EXPECT_TRUE(holds("summary.csv", ",no_touch,2,"));
}

TEST_F(Trials, that_are_to_begin_forget_a_goal_that_is_refused) {
  config_.press_to_start = true;
  config_.once = false;
  begin();
  live(1.0);
  keeper_->take_goal({500.0, 0.0}, now());
  Guidance ahead;
  ahead.stamp = now().ros_ns + 3600'000'000'000;
  ahead.state = State::goal_refused;
  ahead.goal = {500.0, 0.0};
  keeper_->take(ahead, now());
  live(0.1);
  EXPECT_EQ(shown_.back(), TrialState::State::ready);
  live(0.1, State::goal_refused, {500.0, 0.0});
  EXPECT_EQ(shown_.back(), TrialState::State::choose_goal);
}

TEST_F(Trials, do_not_wait_for_ever_for_a_simulated_operator_to_begin) {
  config_.press_to_start = true;
  config_.operator_kind = "simulated";
  offer();
  live(62.0);
  EXPECT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 3);
  EXPECT_TRUE(folders().empty());
}

TEST_F(Trials, name_what_was_set_and_every_device_and_the_hour_of_each_row) {
  offer();
  const std::map<std::string, std::string> traits{{"name", "DualSense"}, {"firmware", "552"}};
  keeper_->take(DeviceReport{now().ros_ns, "pad", DeviceState::works, traits}, now());
  live(1.0);
  for (const char* field :
       {"settings=sim/seed%3d3;", ";pad_name=DualSense;pad_firmware=552;", ";voice=unknown;",
        ";round_trip=0.000000;", "x=", "utc=2023-11-14T22:13:2"})
    EXPECT_TRUE(holds("journal.csv", field)) << field;
  live(1.0, State::following, kScenario.goal);
  live(9.0, State::arrived, kScenario.goal);
  EXPECT_TRUE(holds("summary.csv", ",started_utc,"));
}

TEST_F(Trials, S5_keep_the_order_of_their_hours_when_the_clock_is_set) {
  offer();
  live(1.0);
  set_ = -3600'000'000'000;
  live(2.0, State::following, kScenario.goal);
  live(9.0, State::arrived, kScenario.goal);
  std::istringstream events(content("events.csv"));
  std::vector<std::string> hours;
  for (std::string line; std::getline(events, line);) {
    const auto at = line.find("2023-");
    if (at != line.npos) hours.push_back(line.substr(at, 24));
  }
  EXPECT_GT(hours.size(), 5U);
  EXPECT_TRUE(holds("journal.csv", ";calendar=2023-11-14T21:13:")) << "the clock as it was set";
  EXPECT_TRUE(std::is_sorted(hours.begin(), hours.end())) << content("events.csv");
}

TEST_F(Trials, are_aborted_when_the_guidance_never_takes_the_goal) {
  offer();
  live(60.0);
  EXPECT_TRUE(keeper_->done());
  EXPECT_GT(goals_.size(), 1U);
  EXPECT_TRUE(holds("summary.csv", "goal_not_taken"));
}

TEST_F(Trials, S1_are_aborted_when_the_robot_is_heard_of_no_more) {
  run();
  wait(30.0);
  EXPECT_TRUE(keeper_->done());
  EXPECT_TRUE(holds("summary.csv", "aborted"));
}

TEST_F(Trials, that_have_not_begun_leave_nothing_behind_when_stopped) {
  begin();
  live(1.0);
  EXPECT_EQ(folders().size(), 1U);
  keeper_->stop(now());
  EXPECT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 0);
  EXPECT_TRUE(folders().empty());
}

TEST_F(Trials, that_run_are_closed_within_two_seconds_when_stopped) {
  run();
  keeper_->stop(now());
  EXPECT_FALSE(keeper_->done());
  wait(2.0);
  EXPECT_TRUE(keeper_->done());
  EXPECT_TRUE(holds("summary.csv", "stopped_by_signal"));
}

TEST_F(Trials, follow_on_one_another_where_more_than_one_is_wanted) {
  config_.once = false;
  begin();
  live(1.0);
  keeper_->take_goal({3.0, 0.0}, now());
  live(1.0, State::following, {3.0, 0.0});
  live(9.0, State::arrived, {3.0, 0.0});
  EXPECT_FALSE(keeper_->done());
  EXPECT_EQ(times("TRIAL_END"), 1);
  keeper_->take_goal({8.0, 0.0}, now());
  live(1.0, State::following, {8.0, 0.0});
  keeper_->take_goal({9.0, 0.0}, now());
  EXPECT_EQ(events_.back(), "GOAL_SET") << "of a trial that runs";
  live(9.0, State::arrived, {9.0, 0.0});
  EXPECT_EQ(times("TRIAL_END"), 2);
  EXPECT_GE(folders().size(), 2U);
}

TEST_F(Trials, of_a_job_lead_from_place_to_place_and_wait_for_what_is_done_there) {
  config_.job = folder_.write("job.yaml",
                              "- {name: packing table, x: 3, y: 0, do: pick}\n"
                              "- {name: dock, x: 6, y: 0, do: drop}\n");
  config_.out = (folder_ / "out").string();
  config_.press_to_start = true;
  offer();
  live(1.0);
  EXPECT_EQ(waits_.state, TrialState::State::ready) << "the scenario's goal is none of the job's";
  EXPECT_EQ(waits_.place, "");
  press();
  live(1.0, State::following, {3.0, 0.0});
  press(TrialRequest::Kind::end);
  live(9.0);
  EXPECT_EQ(waits_.place, "") << "ended by the person, and not reached";
  using Task = TrialState::Task;
  for (const auto& [name, x, task] :
       {std::tuple("packing table", 3.0, Task::pick), std::tuple("dock", 6.0, Task::drop)}) {
    press();
    live(1.0, State::following, {x, 0.0});
    EXPECT_EQ(goals_.back().x(), x);
    EXPECT_TRUE(holds("journal.csv", std::string("job_task=") + to_string(task)));
    live(9.0, State::arrived, {x, 0.0});
    EXPECT_EQ(waits_.state, TrialState::State::ready);
    EXPECT_EQ(waits_.place, name);
    EXPECT_EQ(waits_.task, task);
  }
  EXPECT_FALSE(keeper_->done()) << "what is done at the last place is confirmed, too";
  press();
  live(1.0, State::arrived, {6.0, 0.0});
  EXPECT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 0);
  EXPECT_TRUE(said("The job is done: 2 places."));
  EXPECT_EQ(folders().size(), 3U) << "a record a leg";
}

TEST_F(Trials, of_a_job_lead_to_the_place_that_was_chosen_and_then_to_those_that_are_left) {
  config_.job = folder_.write("job.yaml",
                              "- {name: packing table, x: 3, y: 0}\n- {name: dock, x: 6, y: 0}\n");
  config_.out = (folder_ / "out").string();
  config_.press_to_start = true;
  offer();
  live(1.0);
  using Goal = Eigen::Vector2d;
  for (const auto& [chosen, leads, place] :
       {std::tuple(true, Goal(6.0, 0.0), "job_place=2"), std::tuple(true, Goal(9.0, 0.0), ""),
        std::tuple(false, Goal(3.0, 0.0), "job_place=1")}) {
    if (chosen) keeper_->take_goal(leads, now());
    press();
    live(1.0, State::following, leads);
    EXPECT_EQ(goals_.back(), leads);
    EXPECT_NE(content("journal.csv").find(*place != 0 ? place : "TRIAL_START"), std::string::npos);
    EXPECT_EQ(content("journal.csv").find("job_place") != std::string::npos, *place != 0);
    live(9.0, State::arrived, leads);
    EXPECT_EQ(waits_.place, std::string(*place == 0 ? "" : leads.x() > 5.0 ? "dock" : "packing table"));
  }
  press();
  live(1.0, State::arrived, {3.0, 0.0});
  EXPECT_TRUE(keeper_->done());
}

TEST_F(Trials, of_a_job_that_comes_back_to_a_spot_lead_there_again_and_end) {
  config_.job = folder_.write("job.yaml",
                              "- {name: dock, x: 3, y: 0, do: pick}\n- {name: table, x: 6, y: 0}\n"
                              "- {name: dock again, x: 3, y: 0, do: drop}\n");
  config_.out = (folder_ / "out").string();
  config_.press_to_start = true;
  offer();
  live(1.0);
  for (const auto& [x, place] : {std::pair(3.0, "dock"), {6.0, "table"}, {3.0, "dock again"}}) {
    press();
    live(1.0, State::following, {x, 0.0});
    EXPECT_TRUE(holds("journal.csv", std::string("job_name=") + place + ";"));
    live(9.0, State::arrived, {x, 0.0});
    EXPECT_EQ(waits_.place, place);
  }
  press();
  live(1.0, State::arrived, {3.0, 0.0});
  EXPECT_TRUE(keeper_->done());
  EXPECT_TRUE(said("The job is done: 3 places."));
}

TEST_F(Trials, of_a_job_end_without_a_place_that_is_refused_or_takes_too_long_and_name_it) {
  config_.job = folder_.write("job.yaml",
                              "- {name: attic, x: 500, y: 0}\n- {name: here, x: 2, y: 0}\n"
                              "- {name: table, x: 3, y: 0}\n- {name: dock, x: 6, y: 0}\n");
  config_.out = (folder_ / "out").string();
  config_.limit = 5.0;
  offer();
  const auto drive = [&](State state, double x, const std::string& until, int count) {
    for (int i = 0; i < 400 && times(until) < count; ++i) live(0.05, state, {x, 0.0});
  };
  drive(State::goal_refused, 500.0, "TRIAL_END", 1);
  drive(State::arrived, 2.0, "TRIAL_END", 2);
  drive(State::following, 3.0, "TRIAL_END", 3);
  drive(State::following, 6.0, "TRIAL_START", 4);
  live(1.0, State::following, {6.0, 0.0});
  drive(State::arrived, 6.0, "TRIAL_END", 4);
  live(9.0);
  EXPECT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 0);
  EXPECT_EQ(times("TRIAL_END"), 4);
  EXPECT_TRUE(said("The job is done: 4 places, not reached: attic, table."));
}

TEST_F(Trials, of_a_job_in_a_study_lead_to_each_place_once_and_end_where_one_breaks_off) {
  for (const bool breaks_off : {false, true}) {
    config_.job = folder_.write("job.yaml",
                                "- {name: table, x: 3, y: 0}\n- {name: dock, x: 6, y: 0}\n");
    config_.out = (folder_ / (breaks_off ? "broken" : "late")).string();
    config_.press_to_start = config_.locked = true;
    config_.limit = 5.0;
    offer();
    live(1.0);
    press();
    live(1.0, State::following, {3.0, 0.0});
    if (breaks_off) press(TrialRequest::Kind::end);
    live(9.0, State::following, {3.0, 0.0});
    EXPECT_EQ(keeper_->done(), breaks_off);
    if (breaks_off) break;
    EXPECT_EQ(waits_.place, "") << "it was not reached";
    press();
    live(9.0, State::following, {6.0, 0.0});
    EXPECT_TRUE(keeper_->done()) << "nothing is to be confirmed there";
  }
}

TEST_F(Trials, L1_that_cannot_be_recorded_leave_no_folder_and_no_harm_to_another) {
  config_.once = false;
  begin();
  live(1.0);
  keeper_->take_goal({3.0, 0.0}, now());
  live(1.0, State::following, {3.0, 0.0});
  while (!happened("BAG_CLOSED")) live(0.05, State::arrived, {3.0, 0.0});
  failures_ = 100;
  error_ = ENOSPC;
  live(9.0);
  EXPECT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 3);
  EXPECT_TRUE(said("No space left on device"));
  ASSERT_EQ(folders().size(), 1U);
  EXPECT_TRUE(holds("summary.csv", "reached"));
}

TEST_F(Trials, do_not_begin_without_what_their_condition_needs) {
  config_.require = {"speech"};
  offer();
  live(3.0);
  EXPECT_TRUE(events_.empty());
  for (const char* device : {"audio", "speech"}) report(device);
  live(1.0);
  EXPECT_TRUE(happened("TRIAL_START"));
}

/// As on a robot, where no world asks for a trial.
TEST_F(Trials, by_a_goal_that_a_person_chooses_begin_once_bag_and_devices_are_there) {
  config_.record = "here";
  config_.require = {"speech"};
  begin();
  for (const char* device : {"audio", "speech"}) report(device);
  live(1.0);
  keeper_->take_goal({3.0, 0.0}, now());
  live(1.0);
  EXPECT_FALSE(happened("TRIAL_START")) << "nobody records it";
  keeper_->take(DeviceReport{now().ros_ns, "speech", DeviceState::missing}, now());
  keeper_->recorder_listens(now());
  live(1.0);
  keeper_->take_goal({4.0, 0.0}, now());
  live(1.0);
  EXPECT_FALSE(happened("TRIAL_START")) << "without speech";
  report("speech");
  live(1.0);
  EXPECT_TRUE(happened("TRIAL_START"));
  EXPECT_EQ(goals_.back().x(), 4.0);
}

/// A robot waits for hours between two trials.
TEST_F(Trials, do_not_grow_while_they_wait) {
  config_.once = false;
  begin();
  live(1.0);
  keeper_->take_goal({3.0, 0.0}, now());
  live(1.0, State::following, {3.0, 0.0});
  live(9.0, State::arrived, {3.0, 0.0});
  ASSERT_TRUE(happened("BAG_CLOSED"));
  live(10.0);
  const std::size_t before = ::mallinfo2().uordblks;
  live(1000.0);
  EXPECT_LT(::mallinfo2().uordblks, before + 100'000) << "bytes, of 20 000 reports";
}

TEST_F(Trials, S1_that_a_crash_has_stopped_do_not_say_that_a_hand_did) {
  run();
  keeper_->stop(now(), "simulator_lost");
  wait(2.0);
  EXPECT_TRUE(holds("summary.csv", ",aborted,simulator_lost,"));
}

TEST_F(Trials, S1_that_are_stopped_while_a_part_is_silent_name_that_part) {
  run();
  feedback_ = false;
  live(1.5, State::following, kScenario.goal);
  keeper_->stop(now());
  wait(2.0);
  EXPECT_TRUE(holds("summary.csv", ",aborted,feedback_lost,"));
}

TEST_F(Trials, end_when_the_feedback_falls_silent_and_not_as_if_the_person_had_failed) {
  feedback_ = false;
  offer();
  report("audio");
  live(0.8, State::following, kScenario.goal);
  ASSERT_TRUE(happened("TRIAL_START"));
  EXPECT_FALSE(happened("DEVICE_LOST"));
  live(0.5, State::following, kScenario.goal);
  EXPECT_TRUE(happened("DEVICE_LOST")) << "after a second";
  EXPECT_TRUE(said("The guide is silent"));
  EXPECT_FALSE(happened("DEVICE_BACK"));
  report("audio");
  live(0.5, State::following, kScenario.goal);
  EXPECT_TRUE(happened("DEVICE_BACK"));
  live(3.0, State::following, kScenario.goal);
  EXPECT_FALSE(happened("TRIAL_END"));
  live(7.0, State::following, kScenario.goal);
  EXPECT_EQ(times("DEVICE_LOST"), 2);
  EXPECT_TRUE(happened("TRIAL_END"));
}

TEST_F(Trials, go_on_without_their_bag_when_it_does_not_grow_and_say_so) {
  config_.record = "here";
  offer();
  live(1.0);
  keeper_->recorder_listens(now());
  live(2.0);
  ASSERT_TRUE(happened("TRIAL_START"));
  EXPECT_FALSE(happened("BAG_LOST"));
  live(11.0, State::following, kScenario.goal);
  EXPECT_EQ(times("BAG_LOST"), 1);
  EXPECT_TRUE(said("The bag does not grow"));
  live(0.1, State::arrived, kScenario.goal);
  for (int i = 0; i < 1000 && !keeper_->done(); ++i) {  // the recorder is another process
    live(1.0, State::arrived, kScenario.goal);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 0) << "the trial is valid";
  EXPECT_EQ(events_.back(), "BAG_CLOSED");
  EXPECT_TRUE(holds("journal.csv", "state=bad"));
  EXPECT_TRUE(holds("summary.csv", "reached"));
}

TEST_F(Trials, go_on_where_their_own_node_was_halted_for_a_while) {
  offer();
  live(2.0, State::following, kScenario.goal);
  ASSERT_TRUE(happened("TRIAL_START"));
  time_ += 20.0;
  keeper_->step(now());
  live(2.0, State::following, kScenario.goal);
  EXPECT_FALSE(happened("TRIAL_END"));
  wait(12.0);
  EXPECT_TRUE(holds("summary.csv", "simulator_lost"));
}

TEST_F(Trials, L1_are_ended_as_invalid_when_the_disk_is_full_with_all_rows_in_the_reserve) {
  run();
  ASSERT_TRUE(happened("TRIAL_START"));
  failures_ = 1;
  error_ = ENOSPC;
  keeper_->take_goal({7.0, 1.0}, now());
  live(9.0, State::following, {7.0, 1.0});
  ASSERT_TRUE(keeper_->done());
  EXPECT_EQ(times("GOAL_SET"), 2);
  EXPECT_TRUE(happened("TRIAL_END"));
  EXPECT_TRUE(holds("summary.csv", "invalid"));
  EXPECT_TRUE(holds("summary.csv", "disk_full"));
}

TEST_F(Trials, L3_are_invalid_from_the_first_row_that_may_not_be_on_the_disk) {
  run();
  failures_ = 1;
  error_ = EIO;
  const std::size_t told = events_.size();
  keeper_->take_goal({7.0, 1.0}, now());
  live(9.0, State::following, {7.0, 1.0});
  ASSERT_TRUE(keeper_->done());
  EXPECT_EQ(keeper_->exit_code(), 4);
  EXPECT_EQ(events_.size(), told) << "nothing is told that is not recorded";
  EXPECT_TRUE(said("The trial is invalid"));
  EXPECT_TRUE(holds("summary.csv", "journal_broken"));
}

TEST_F(Trials, L3_are_invalid_where_their_track_may_not_last) {
  calls_.fdatasync = [](int file) {
    const fs::path path = fs::read_symlink("/proc/self/fd/" + std::to_string(file));
    if (path.filename() != "track.npy") return ::fdatasync(file);
    errno = EIO;
    return -1;
  };
  run();
  live(9.0, State::arrived, kScenario.goal);
  ASSERT_TRUE(keeper_->done());
  EXPECT_TRUE(said("cannot sync the track"));
  EXPECT_TRUE(holds("summary.csv", "invalid,track_not_written"));
}

TEST_F(Trials, with_a_text_that_would_break_the_record_are_refused) {
  config_.participant = "a\nb";
  EXPECT_THROW(begin(), std::runtime_error);
}

}  // namespace
}  // namespace navvi_study::trial
