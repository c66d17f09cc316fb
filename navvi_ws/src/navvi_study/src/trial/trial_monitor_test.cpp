#include "trial/trial_monitor.hpp"

#include <gtest/gtest.h>

namespace navvi_study::trial {
namespace {

using navvi_types::ThingClass;

constexpr std::int64_t kSecond = 1'000'000'000;

class Monitor : public testing::Test {
 protected:
  void SetUp() override { monitor_.start({10 * kSecond, {5.0, 0.0}}); }

  static Guidance guidance(double time, Guidance::State state, std::uint32_t seq = 1) {
    Guidance report;
    report.stamp = static_cast<std::int64_t>(time * 1e9);
    report.state = state;
    report.seq = seq;
    report.goal = {5.0, 0.0};
    report.goal_distance = 5.0;
    report.plans = 1;
    report.replan_reason = Guidance::Replan::new_goal;
    return report;
  }
  static Contact contact(double time, std::uint32_t seq, const char* what, int shelves,
                         int others) {
    Contact report;
    report.stamp = static_cast<std::int64_t>(time * 1e9);
    report.seq = seq;
    report.thing_class = *navvi_types::from_word<ThingClass>(what);
    report.counts[ThingClass::shelf] = static_cast<std::uint32_t>(shelves);
    report.counts[ThingClass::worker] = static_cast<std::uint32_t>(others);
    return report;
  }
  static Proximity near(double time, const char* what, double gap, double lateral = 0.0) {
    Proximity report{static_cast<std::int64_t>(time * 1e9), {}};
    if (gap < 5.0)
      report.things.push_back({*navvi_types::from_word<ThingClass>(what), 1, gap, {0.0, lateral}});
    return report;
  }
  static DriveState stopped(std::int64_t time) {
    return {DriveState::State::stopped, DriveState::Reason::command_lost, 0, time * kSecond};
  }
  static std::vector<std::string> types(const std::vector<Event>& events) {
    std::vector<std::string> names;
    for (const auto& event : events) names.push_back(event.type);
    return names;
  }
  using Names = std::vector<std::string>;
  using State = Guidance::State;
  /// The types of the events that a report makes.
  template <typename Report>
  Names seen(const Report& report) {
    return types(monitor_.observe(report));
  }

  TrialMonitor monitor_{TrialMonitorConfig()};
};

TEST_F(Monitor, counts_only_round_trips_that_were_measured) {
  LinkState link;
  for (const std::int64_t second : {11, 12, 13}) {
    link.stamp = second * kSecond;
    (void)monitor_.observe(link);
    EXPECT_EQ(monitor_.end_fields().get("round_trip"), second < 13 ? "n/a" : "0.250");
    link.round_trip = second < 12 ? 0.0 : 0.25;
  }
}

TEST_F(Monitor, says_nothing_of_what_was_before_the_trial) {
  EXPECT_TRUE(monitor_.observe(contact(9.0, 1, "shelf", 1, 0)).empty());
  EXPECT_TRUE(monitor_.observe(guidance(10.0, State::arrived)).empty());
  EXPECT_FALSE(monitor_.arrival());
}

TEST_F(Monitor, tells_shelves_from_everything_else) {
  const auto shelf = monitor_.observe(contact(11.0, 1, "shelf", 1, 0));
  ASSERT_EQ(types(shelf), Names{"COLLISION"});
  EXPECT_EQ(shelf[0].fields.get("kind"), "shelf");
  for (const char* what : {"wall", "worker", "box", "other"}) {
    const auto seq = static_cast<std::uint32_t>(monitor_.tally().obstacle_collisions) + 2;
    const auto events = monitor_.observe(contact(12.0, seq, what, 1, static_cast<int>(seq) - 1));
    ASSERT_EQ(types(events), Names{"COLLISION"}) << what;
    EXPECT_EQ(events[0].fields.get("kind"), "obstacle") << what;
  }
  EXPECT_EQ(monitor_.tally().shelf_collisions, 1u);
  EXPECT_EQ(monitor_.tally().obstacle_collisions, 4u);
}

TEST_F(Monitor, keeps_the_last_state_of_the_world_that_is_not_after_the_end) {
  EXPECT_EQ(monitor_.tally_fields().get("state_hash"), "n/a");
  (void)monitor_.observe(StateHash{9 * kSecond, 900, 0xaa});
  EXPECT_EQ(monitor_.tally_fields().get("state_hash"), "00000000000000aa")
      << "before the start, but none later";
  (void)monitor_.observe(StateHash{11 * kSecond, 1100, 0xbb});
  monitor_.end(11 * kSecond);
  (void)monitor_.observe(StateHash{12 * kSecond, 1200, 0xcc});
  EXPECT_EQ(monitor_.tally_fields().get("state_hash"), "00000000000000bb");
  EXPECT_EQ(monitor_.tally_fields().get("state_step"), "1100");
}

TEST_F(Monitor, counts_no_contacts_of_those_who_drove_in_the_same_world_before) {
  EXPECT_EQ(seen(contact(11.0, 4, "shelf", 3, 1)), Names{"COLLISION"});
  EXPECT_EQ(monitor_.tally().shelf_collisions, 1u);
  EXPECT_EQ(monitor_.tally().missed_messages, 0u);
}

TEST_F(Monitor, R3_makes_the_first_contact_good_in_a_world_that_nobody_drove_in_before) {
  TrialStart start{10 * kSecond, {5.0, 0.0}};
  start.hits_known = true;
  monitor_.start(start);
  EXPECT_EQ(seen(contact(11.0, 2, "shelf", 1, 1)), (Names{"COLLISION", "COLLISION"}));
  EXPECT_EQ(monitor_.tally().shelf_collisions, 1u);
  EXPECT_EQ(monitor_.tally().obstacle_collisions, 1u);
  EXPECT_EQ(monitor_.tally().missed_messages, 1u);
}

TEST_F(Monitor, T1_begins_at_the_time_that_is_where_the_clock_was_set_back) {
  (void)monitor_.observe(guidance(5000.0, State::following));
  EXPECT_EQ(monitor_.start_now(20 * kSecond, {5.0, 0.0}).stamp, 20 * kSecond);
  (void)monitor_.observe(guidance(20.5, State::following));
  EXPECT_EQ(monitor_.start_now(20 * kSecond, {5.0, 0.0}).stamp, 20'500'000'000)
      << "a report is as new as that";
}

TEST_F(Monitor, counts_the_contacts_of_a_simulator_that_was_started_anew_between_two_trials) {
  struct Row {
    double last;  ///< s, by the clock before, when it was hit last
    bool hit_before;
  };
  for (const Row& row : {Row{5000.0, false}, {5000.0, true}, {5.0, false}, {5.0, true}}) {
    monitor_.start({5000 * kSecond, {5.0, 0.0}});
    EXPECT_TRUE(monitor_.observe(contact(row.last, 7, "shelf", 5, 2)).empty());
    (void)monitor_.observe(guidance(5001.0, State::following));
    EXPECT_TRUE(!row.hit_before || monitor_.observe(contact(15.0, 1, "shelf", 1, 0)).empty());
    monitor_.start(monitor_.start_now(20 * kSecond, {5.0, 0.0}));
    EXPECT_EQ(seen(contact(21.0, row.hit_before ? 2U : 1U, "worker", row.hit_before ? 1 : 0, 1)),
              Names{"COLLISION"});
    EXPECT_EQ(monitor_.tally().missed_messages, 0u);
    EXPECT_FALSE(monitor_.world_restarted());
  }
  TrialMonitor monitor{TrialMonitorConfig()};  // of a session that was no longer than this one
  (void)monitor.observe(contact(5.0, 7, "shelf", 5, 2));
  monitor.start(monitor.start_now(20 * kSecond, {5.0, 0.0}));
  EXPECT_EQ(types(monitor.observe(contact(21.0, 1, "shelf", 1, 0))), Names{"COLLISION"});
  EXPECT_EQ(monitor.tally().missed_messages, 0u);
  EXPECT_FALSE(monitor.world_restarted());
}

TEST_F(Monitor, R3_makes_a_lost_contact_good_from_the_running_counts) {
  (void)monitor_.observe(contact(11.0, 1, "shelf", 1, 0));
  const auto events = monitor_.observe(contact(12.0, 4, "shelf", 2, 2));
  EXPECT_EQ(events.size(), 3u);
  EXPECT_EQ(monitor_.tally().shelf_collisions, 2u);
  EXPECT_EQ(monitor_.tally().obstacle_collisions, 2u);
  EXPECT_EQ(monitor_.tally().missed_messages, 2u);
  EXPECT_EQ(events[0].fields.get("made_good"), "yes");
}

TEST_F(Monitor, counts_a_contact_that_comes_twice_once) {
  (void)monitor_.observe(contact(11.0, 2, "shelf", 2, 0));
  EXPECT_TRUE(monitor_.observe(contact(11.0, 2, "shelf", 2, 0)).empty());
  EXPECT_FALSE(monitor_.world_restarted());
  EXPECT_TRUE(monitor_.observe(contact(11.5, 1, "shelf", 1, 0)).empty());
  EXPECT_TRUE(monitor_.world_restarted());
}

TEST_F(Monitor, tells_since_when_a_thing_was_near_and_of_no_time_before_the_trial) {
  for (const double time : {1.0, 5000.0}) {  // of a simulator before this one
    TrialMonitor monitor{TrialMonitorConfig()};
    (void)monitor.observe(near(time, "worker", 1.0));
    monitor.start({10 * kSecond, {5.0, 0.0}});
    Contact hit = contact(12.0, 1, "worker", 0, 1);
    hit.id = 1;
    EXPECT_EQ(monitor.observe(hit).at(0).fields.get("felt"), "2.000");
  }
}

TEST_F(Monitor, T1_goes_on_by_a_count_of_contacts_that_began_anew_before_the_trials_first) {
  TrialStart start{10 * kSecond, {5.0, 0.0}, {4, 0, 4}};
  start.hits_known = true;  // as a recount has it
  monitor_.start(start);
  EXPECT_EQ(seen(contact(11.0, 1, "other", 0, 1)), Names{"COLLISION"});
  EXPECT_EQ(seen(contact(12.0, 3, "other", 0, 3)), (Names{"COLLISION", "COLLISION"}));
  EXPECT_EQ(monitor_.tally().obstacle_collisions, 3u);
  EXPECT_EQ(monitor_.tally().missed_messages, 1u);
  EXPECT_FALSE(monitor_.world_restarted());
  EXPECT_TRUE(monitor_.observe(contact(13.0, 1, "other", 0, 1)).empty());
  EXPECT_TRUE(monitor_.world_restarted());
}

TEST_F(Monitor, does_not_flicker_at_the_boundary) {
  EXPECT_EQ(seen(near(11.0, "worker", 4.9, 2.0)), Names{"PROXIMITY_ENTER"});
  for (int i = 0; i < 20; ++i) {
    const double time = 11.1 + 0.1 * i;
    EXPECT_TRUE(monitor_.observe(near(time, "worker", i % 2 == 0 ? 6.0 : 4.99)).empty());
  }
  EXPECT_TRUE(monitor_.observe(near(13.1, "worker", 6.0)).empty());
  EXPECT_EQ(seen(near(13.8, "worker", 6.0)), Names{"PROXIMITY_LEAVE"});
  EXPECT_EQ(seen(near(14.0, "worker", 1.0)), Names{"PROXIMITY_ENTER"});
}

TEST_F(Monitor, names_the_zone_of_an_obstacle) {
  const auto zone = [&](double lateral) {
    TrialMonitor fresh{TrialMonitorConfig()};
    fresh.start({});
    return fresh.observe(near(1.0, "box", 2.0, lateral)).at(0).fields.get("zone");
  };
  EXPECT_EQ(zone(1.5), "left");
  EXPECT_EQ(zone(-1.5), "right");
  EXPECT_EQ(zone(0.9), "center");
  EXPECT_EQ(zone(-1.0), "center");
}

TEST_F(Monitor, takes_a_shelf_as_near_within_one_meter_only) {
  EXPECT_TRUE(monitor_.observe(near(11.0, "shelf", 1.05)).empty());
  EXPECT_EQ(seen(near(11.1, "shelf", 1.0)), Names{"PROXIMITY_ENTER"});
  EXPECT_TRUE(monitor_.observe(near(12.0, "shelf", 1.05)).empty()) << "still within the margin";
}

TEST_F(Monitor, reports_when_the_robot_begins_and_ceases_to_steer_by_itself) {
  DriveState drive;
  drive.stamp = 11 * kSecond;
  EXPECT_TRUE(monitor_.observe(drive).empty());
  drive.assistance = DriveState::Assistance::steers_left;
  const auto begun = monitor_.observe(drive);
  EXPECT_EQ(types(begun), Names{"ASSISTED"});
  EXPECT_EQ(begun.at(0).fields.get("does"), "steers_left");
  EXPECT_TRUE(monitor_.observe(drive).empty()) << "goes on";
  drive.assistance = DriveState::Assistance::nothing;
  EXPECT_EQ(monitor_.observe(drive).at(0).fields.get("does"), "nothing");
}

TEST_F(Monitor, reports_in_each_trial_anew_that_the_robot_is_slowed) {
  DriveState drive;
  drive.assistance = DriveState::Assistance::slows;
  drive.stamp = 11 * kSecond;
  EXPECT_EQ(seen(drive), Names{"ASSISTED"});
  monitor_.end(12 * kSecond);
  for (const std::int64_t begin : {20, 30}) {
    monitor_.start({begin * kSecond, {5.0, 0.0}});
    drive.stamp = (begin + 1) * kSecond;
    EXPECT_EQ(seen(drive), Names{"ASSISTED"}) << "as in a recount of the bag of this trial alone";
  }
}

TEST_F(Monitor, ends_with_the_heading_and_what_is_on_either_side) {
  Odometry stood;
  stood.stamp = 11 * kSecond;
  stood.pose.yaw = 1.25;
  EXPECT_EQ(seen(stood), Names{"PROGRESS"});
  Proximity around = near(11.0, "worker", 0.5, 0.9);
  around.things.front().nearest.x() = 1.0;
  around.things.push_back({ThingClass::shelf, 2, 0.9, {1.0, 1.5}});
  around.things.push_back({ThingClass::wall, 3, 3.1, {1.0, -3.5}});
  EXPECT_EQ(seen(around), (Names{"PROXIMITY_ENTER", "PROXIMITY_ENTER", "PROXIMITY_ENTER"}));
  const record::Fields end = monitor_.end_fields();
  EXPECT_EQ(end.get("yaw"), "1.250");
  EXPECT_EQ(end.get("left"), "shelf") << "the worker is nearer, and ahead";
  EXPECT_EQ(end.get("right"), "nothing") << "the wall is more than 3 m away";
}

TEST_F(Monitor, times_the_goal_from_the_start_and_ends_there) {
  const auto first = monitor_.observe(guidance(10.5, State::following));
  ASSERT_EQ(types(first), (Names{"GUIDANCE", "ROUTE"}));
  EXPECT_EQ(first[1].fields.get("first_path_length"), "5.000");
  const auto events = monitor_.observe(guidance(17.25, State::arrived, 2));
  ASSERT_EQ(types(events), (Names{"GUIDANCE", "GOAL_REACHED"}));
  EXPECT_EQ(events[1].fields.get("elapsed"), "7.250");
  monitor_.end(monitor_.latest());
  EXPECT_EQ(monitor_.observe(contact(17.2, 1, "shelf", 1, 0)).size(), 1u) << "late, but in time";
  EXPECT_TRUE(monitor_.observe(contact(17.3, 2, "shelf", 2, 0)).empty()) << "the trial is over";
}

TEST_F(Monitor, calls_no_path_the_first_that_ends_short_of_the_goal) {
  Guidance short_of_it = guidance(10.5, State::following);
  short_of_it.ends_short = true;
  EXPECT_EQ(seen(short_of_it), Names{"GUIDANCE"});
  Guidance whole = guidance(12.0, State::following, 2);
  whole.plans = 2;
  EXPECT_EQ(seen(whole), Names{"REPLAN"});
}

TEST_F(Monitor, T4_an_arrival_that_the_odometry_contradicts_is_not_recorded_as_reached) {
  (void)monitor_.observe(Odometry{11 * kSecond, {{-3.2, 0.4}}});
  (void)monitor_.observe(guidance(11.5, State::following));
  const auto events = monitor_.observe(guidance(12.0, State::arrived, 2));
  ASSERT_EQ(types(events), (Names{"GUIDANCE", "ARRIVED_ELSEWHERE"}));
  EXPECT_EQ(events[1].fields.get("distance"), "8.210");
  EXPECT_FALSE(monitor_.arrival());
  EXPECT_TRUE(monitor_.arrived_elsewhere());
  EXPECT_TRUE(monitor_.observe(guidance(12.1, State::arrived, 3)).empty()) << "told once";
}

TEST_F(Monitor, records_an_arrival_within_the_range_as_reached) {
  (void)monitor_.observe(Odometry{11 * kSecond, {{3.1, 0.0}}});
  (void)monitor_.observe(guidance(11.5, State::following));
  EXPECT_EQ(seen(guidance(12.0, State::arrived, 2)), (Names{"GUIDANCE", "GOAL_REACHED"}));
  EXPECT_FALSE(monitor_.arrived_elsewhere());
}

TEST_F(Monitor, does_not_call_a_goal_reached_where_the_robot_stands_at_the_start) {
  for (const double driven : {0.0, 0.2}) {
    monitor_.start({10 * kSecond, {0.4, 0.0}});
    (void)monitor_.observe(Odometry{11 * kSecond, {{0.2 - driven, 0.0}}});
    (void)monitor_.observe(guidance(11.5, State::following));
    (void)monitor_.observe(Odometry{12 * kSecond, {{0.2, 0.0}}});
    Guidance there = guidance(12.0, State::arrived, 2);
    there.goal = {0.4, 0.0};
    there.plans = driven > 0.0 ? 3 : 2;
    (void)monitor_.observe(there);
    ASSERT_TRUE(monitor_.arrival());
    EXPECT_EQ(monitor_.arrival()->result, driven > 0.0 ? "reached" : "refused");
    EXPECT_EQ(monitor_.arrival()->reason, driven > 0.0 ? "goal_reached" : "goal_at_start");
  }
}

TEST_F(Monitor, wants_its_goal_set_again_where_guidance_was_started_anew) {
  EXPECT_EQ(seen(guidance(10.5, State::following)), (Names{"GUIDANCE", "ROUTE"}));
  EXPECT_TRUE(monitor_.goal_taken());
  EXPECT_EQ(seen(guidance(12.0, State::no_goal)), Names{"GUIDANCE"});
  EXPECT_FALSE(monitor_.goal_taken());
  EXPECT_EQ(seen(guidance(13.0, State::following)), Names{"GUIDANCE"});
  EXPECT_TRUE(monitor_.goal_taken());
}

TEST_F(Monitor, does_not_take_the_last_goals_arrival_for_its_own) {
  TrialMonitor monitor{TrialMonitorConfig()};
  (void)monitor.observe(guidance(9.9, State::arrived));
  monitor.start({10 * kSecond, {5.0, 0.0}});
  (void)monitor.observe(guidance(10.1, State::arrived, 2));
  EXPECT_FALSE(monitor.arrival());
  auto fresh = guidance(10.2, State::arrived, 3);
  fresh.plans = 2;
  (void)monitor.observe(fresh);
  EXPECT_TRUE(monitor.arrival());
}

TEST_F(Monitor, does_not_take_the_path_to_its_goal_that_was_followed_before_it_for_its_own) {
  TrialMonitor monitor{TrialMonitorConfig()};
  const auto seen_at = [&](double time, std::uint32_t plans, std::uint32_t reroutes) {
    Guidance report = guidance(time, State::following);
    report.plans = plans;
    report.reroutes = reroutes;
    if (reroutes > 0) report.replan_reason = Guidance::Replan::period;
    return types(monitor.observe(report));
  };
  (void)seen_at(9.9, 4, 3);
  monitor.start({10 * kSecond, {5.0, 0.0}});
  EXPECT_EQ(seen_at(10.05, 4, 3), Names{});
  EXPECT_EQ(seen_at(10.1, 5, 4), Names{}) << "before the goal has come to the guide";
  EXPECT_FALSE(monitor.goal_taken());
  EXPECT_EQ(seen_at(10.2, 6, 0), (Names{"GUIDANCE", "ROUTE"}));
  EXPECT_EQ(monitor.tally().replans, 0u);
  EXPECT_EQ(monitor.tally_fields().get("reroutes"), "0");
}

TEST_F(Monitor, takes_no_path_of_before_for_its_own_while_its_goal_is_on_a_slow_connection) {
  TrialMonitor monitor{TrialMonitorConfig()};
  LinkState link;
  link.stamp = 9 * kSecond;
  link.round_trip = 3.0;
  (void)monitor.observe(link);
  (void)monitor.observe(guidance(9.9, State::following));
  monitor.start(monitor.start_now(10 * kSecond, {5.0, 0.0}));
  EXPECT_EQ(types(monitor.observe(guidance(14.9, State::following, 2))), Names{});
  EXPECT_FALSE(monitor.goal_taken());
  EXPECT_EQ(types(monitor.observe(guidance(15.1, State::following, 3))),
            (Names{"GUIDANCE", "ROUTE"}));
}

TEST_F(Monitor, does_not_take_another_goals_path_for_its_own) {
  auto other = guidance(10.5, State::following);
  other.goal = {1.0, 1.0};
  EXPECT_TRUE(monitor_.observe(other).empty());
  EXPECT_FALSE(monitor_.goal_taken());
}

TEST_F(Monitor, tells_a_refused_goal) {
  auto refused = guidance(10.5, State::goal_refused);
  refused.refusal = Guidance::Refusal::inside_obstacle;
  EXPECT_EQ(seen(refused), (Names{"GUIDANCE", "GOAL_REFUSED"}));
  EXPECT_EQ(monitor_.refused(), "inside_obstacle");
}

TEST_F(Monitor, counts_plans_after_the_first_even_where_a_message_was_lost) {
  (void)monitor_.observe(guidance(10.5, State::following, 1));
  auto later = guidance(11.0, State::following, 5);
  later.plans = 4;
  EXPECT_EQ(seen(later), Names{"REPLAN"});
  EXPECT_EQ(monitor_.tally().replans, 3u);
  EXPECT_EQ(monitor_.tally().missed_messages, 3u);
}

TEST_F(Monitor, goes_on_counting_plans_when_the_guidance_was_started_anew) {
  (void)monitor_.observe(guidance(10.5, State::following, 1));
  auto later = guidance(11.0, State::following, 2);
  later.plans = 4;
  (void)monitor_.observe(later);
  auto anew = guidance(12.0, State::no_goal, 1);
  anew.plans = 0;
  (void)monitor_.observe(anew);
  anew = guidance(12.5, State::following, 2);
  anew.plans = 1;
  EXPECT_EQ(seen(anew), (Names{"GUIDANCE", "REPLAN"}));
  EXPECT_EQ(monitor_.tally().replans, 4u);
}

TEST_F(Monitor, takes_a_way_that_is_blocked_for_a_moment_for_a_way) {
  EXPECT_EQ(seen(guidance(10.5, State::blocked)), (Names{"GUIDANCE", "ROUTE"}));
  EXPECT_TRUE(monitor_.goal_taken());
}

TEST_F(Monitor, N4_does_not_ask_for_its_goal_again_where_no_path_begins_at_the_robot) {
  for (const State state : {State::no_route, State::off_mesh}) {
    monitor_.start({10 * kSecond, {5.0, 0.0}});
    Guidance report = guidance(10.5, state);
    report.plans = state == State::off_mesh ? 2 : 1;
    EXPECT_EQ(seen(report), Names{"GUIDANCE"});
    EXPECT_TRUE(monitor_.goal_taken());
  }
}

TEST_F(Monitor, measures_the_way_driven) {
  for (int i = 0; i <= 10; ++i) {
    (void)monitor_.observe(Odometry{(11 + i) * kSecond, {{0.5 * i, 0.0}}});
  }
  EXPECT_DOUBLE_EQ(monitor_.tally().path_length, 5.0);
}

TEST_F(Monitor, has_a_row_where_a_cue_begins_and_one_where_it_ends) {
  using navvi_types::CueStage;
  CueEvent cue{3, CueStage::queued, CueKind::turn_now, "turn to 2 o'clock now"};
  cue.stamp = 11 * kSecond;
  EXPECT_TRUE(monitor_.observe(cue).empty());
  cue.stage = CueStage::started;
  const auto begins = monitor_.observe(cue);
  ASSERT_EQ(types(begins), Names{"CUE"});
  EXPECT_EQ(begins[0].fields.get("text"), "turn to 2 o'clock now");
  EXPECT_EQ(begins[0].fields.get("modality"), "speech");
  cue.stage = CueStage::cut;
  EXPECT_EQ(seen(cue), Names{"CUE_END"});
}

TEST_F(Monitor, has_a_row_for_each_pattern_that_is_felt_and_none_for_what_is_near_all_the_time) {
  CueEvent felt{1, navvi_types::CueStage::started};
  felt.stamp = 11 * kSecond;
  Names rows;
  using navvi_types::Felt;
  const Felt near;
  const Felt hit{navvi_types::Pattern::hit_shelf};
  for (const Felt& what : {near, hit, hit, near, hit}) {
    felt.what = what;
    for (const auto& event : monitor_.observe(felt)) rows.push_back(event.fields.get("kind"));
  }
  EXPECT_EQ(rows, (Names{"hit_shelf", "hit_shelf"}));
  EXPECT_EQ(monitor_.tally().cues_spoken, 0u);
}

TEST_F(Monitor, counts_the_reroutes_of_all_goals_and_of_a_guidance_that_was_started_anew) {
  const auto rerouted = [this](double time, std::uint32_t seq, std::uint32_t reroutes) {
    Guidance report = guidance(time, State::following, seq);
    report.reroutes = reroutes;
    (void)monitor_.observe(report);
    return monitor_.tally_fields().get("reroutes");
  };
  EXPECT_EQ(rerouted(11.0, 1, 0), "0");
  EXPECT_EQ(rerouted(12.0, 2, 2), "2");
  EXPECT_EQ(rerouted(13.0, 3, 2), "2");
  EXPECT_EQ(rerouted(14.0, 4, 0), "2");
  EXPECT_EQ(rerouted(15.0, 5, 1), "3");
}

TEST_F(Monitor, counts_being_stuck_once_a_cue) {
  using navvi_types::CueStage;
  const auto events = [this](std::uint32_t id, CueStage stage) {
    CueEvent cue{id, stage, CueKind::stuck};
    cue.stamp = 11 * kSecond;
    return seen(cue);
  };
  EXPECT_EQ(events(7, CueStage::queued), Names{"STUCK"});
  EXPECT_EQ(events(7, CueStage::started), Names{"CUE"});
  EXPECT_EQ(events(8, CueStage::dropped), Names{"STUCK"});
  EXPECT_EQ(monitor_.tally().cues_spoken, 1u);
  EXPECT_EQ(events(7, CueStage::queued), Names{"STUCK"}) << "of another feedback_node";
  EXPECT_EQ(events(7, CueStage::started), Names{"CUE"});
}

TEST_F(Monitor, counts_every_way_of_being_told_that_the_robot_is_stuck) {
  std::uint32_t id = 0;
  for (const CueKind kind :
       {CueKind::stuck, CueKind::stuck_unknown, CueKind::back_away, CueKind::blocked}) {
    CueEvent cue{++id, navvi_types::CueStage::queued, kind};
    cue.stamp = 11 * kSecond;
    EXPECT_EQ(seen(cue), id < 4 ? Names{"STUCK"} : Names{}) << to_string(kind);
  }
  TrialStart older{20 * kSecond, {5.0, 0.0}};
  older.stuck = {CueKind::stuck};
  monitor_.start(older);
  CueEvent cue{9, navvi_types::CueStage::queued, CueKind::back_away};
  cue.stamp = 21 * kSecond;
  EXPECT_TRUE(monitor_.observe(cue).empty());
}

TEST_F(Monitor, tells_whether_the_robot_had_moved_when_its_wheels_were_stopped) {
  const auto early = monitor_.observe(stopped(11));
  ASSERT_EQ(early.size(), 1u);
  EXPECT_EQ(early[0].fields.get("moved"), "no");
  (void)monitor_.observe(DriveState{DriveState::State::running, {}, 0, 12 * kSecond});
  (void)monitor_.observe(Odometry{12 * kSecond, {}});
  (void)monitor_.observe(Odometry{13 * kSecond, {{0.2, 0.0}}});
  EXPECT_EQ(monitor_.observe(stopped(14))[0].fields.get("moved"), "yes");
}

TEST_F(Monitor, C2_a_stop_while_the_robot_turns_on_the_spot_is_a_stop) {
  (void)monitor_.observe(Odometry{11 * kSecond, {{}, 3.1}});
  EXPECT_EQ(monitor_.observe(stopped(12))[0].fields.get("moved"), "no");
  (void)monitor_.observe(DriveState{DriveState::State::running, {}, 0, 13 * kSecond});
  (void)monitor_.observe(Odometry{13 * kSecond, {{}, -3.0}});
  EXPECT_EQ(monitor_.observe(stopped(14))[0].fields.get("moved"), "yes") << "0.18 rad, over pi";
}

TEST_F(Monitor, names_each_node_that_wants_to_drive_besides_the_guide) {
  DriveState drive{DriveState::State::running, {}, 0, 11 * kSecond, "/teleop"};
  const auto events = monitor_.observe(drive);
  ASSERT_EQ(types(events), Names{"INTRUDER"});
  EXPECT_EQ(events[0].fields.get("node"), "/teleop");
  drive.stamp = 12 * kSecond;
  EXPECT_TRUE(monitor_.observe(drive).empty());
  drive.intruder = "/joystick";
  EXPECT_EQ(seen(drive), Names{"INTRUDER"});
}

TEST_F(Monitor, tells_a_safe_stop_once_and_a_device_that_goes_and_comes) {
  EXPECT_EQ(seen(stopped(11)), Names{"SAFE_STOP"});
  EXPECT_TRUE(monitor_.observe(stopped(12)).empty());
  EXPECT_TRUE(monitor_.observe(DeviceReport{11 * kSecond, "pad", DeviceState::works}).empty());
  EXPECT_EQ(seen(DeviceReport{12 * kSecond, "pad", DeviceState::missing}), Names{"DEVICE_LOST"});
  EXPECT_EQ(seen(DeviceReport{13 * kSecond, "pad", DeviceState::works}), Names{"DEVICE_BACK"});
}

TEST_F(Monitor, F4_records_a_voice_that_was_lost_and_back_between_two_reports) {
  const auto report = [&](int second, const char* losses) {
    return seen(DeviceReport{second * kSecond, "speech", DeviceState::works, {{"losses", losses}}});
  };
  EXPECT_TRUE(report(11, "1").empty()) << "before the trial";
  EXPECT_TRUE(report(12, "1").empty());
  EXPECT_EQ(report(13, "2"), (Names{"DEVICE_LOST", "DEVICE_BACK"}));
  EXPECT_TRUE(report(14, "0").empty()) << "another feedback_node";
  EXPECT_EQ(report(15, "1"), (Names{"DEVICE_LOST", "DEVICE_BACK"}));
}

TEST_F(Monitor, T1_records_a_clock_that_jumps_while_the_wheels_stand_for_another_reason) {
  ASSERT_EQ(seen(stopped(11)), Names{"SAFE_STOP"});
  DriveState jumped = stopped(12);
  jumped.reason = DriveState::Reason::clock_jumped;
  const auto events = monitor_.observe(jumped);
  ASSERT_EQ(types(events), Names{"SAFE_STOP"});
  EXPECT_EQ(events[0].fields.get("reason"), "clock_jumped");
  EXPECT_EQ(events[0].fields.get("held"), "yes");
  EXPECT_TRUE(monitor_.observe(jumped).empty());
  EXPECT_TRUE(monitor_.clock_jumped());
}

TEST_F(Monitor, T1_knows_a_jump_to_before_the_trial_and_forgets_that_of_the_last_one) {
  DriveState jumped = stopped(1);
  jumped.reason = DriveState::Reason::clock_jumped;
  EXPECT_TRUE(monitor_.observe(jumped).empty());
  EXPECT_TRUE(monitor_.clock_jumped());
  monitor_.start({20 * kSecond, {3.0, 0.0}});
  EXPECT_FALSE(monitor_.clock_jumped());
  EXPECT_TRUE(monitor_.observe(jumped).empty());
  EXPECT_FALSE(monitor_.clock_jumped());
}

TEST_F(Monitor, counts_sounds_and_felt_patterns_and_keeps_how_long_the_person_waited) {
  const auto played = [&](navvi_types::Modality modality, const char* word, int second) {
    CueEvent cue;
    cue.stage = navvi_types::CueStage::started;
    cue.what = *navvi_types::signal_of(modality, word);
    cue.stamp = second * kSecond;
    return monitor_.observe(cue);
  };
  using navvi_types::Modality;
  EXPECT_EQ(types(played(Modality::sound, "turn", 11)), Names{"CUE"});
  EXPECT_TRUE(played(Modality::sound, "turn", 12).empty()) << "one row for many ticks";
  EXPECT_EQ(types(played(Modality::rumble, "hit_shelf", 13)), Names{"CUE"});
  EXPECT_TRUE(played(Modality::rumble, "hit_shelf", 14).empty()) << "the same pattern goes on";
  EXPECT_TRUE(played(Modality::rumble, "rumble", 15).empty());
  DeviceReport report{16 * kSecond, "latency", DeviceState::works};
  report.traits = {{"motors_p99_ms", "3.5"}, {"another", "1"}};
  EXPECT_TRUE(monitor_.observe(report).empty());
  const record::Fields fields = monitor_.end_fields();
  EXPECT_EQ(fields.get("sounds_played"), "2");
  EXPECT_EQ(fields.get("patterns_felt"), "1");
  EXPECT_EQ(fields.get("motors_p99_ms"), "3.5");
  EXPECT_FALSE(fields.find("another"));
  EXPECT_FALSE(monitor_.tally_fields().find("motors_p99_ms"));
  report.stamp = 18 * kSecond;
  report.traits["motors_p99_ms"] = "9.9";
  (void)monitor_.observe(report);
  monitor_.end(17 * kSecond);
  EXPECT_EQ(monitor_.end_fields().get("motors_p99_ms"), "3.5") << "of the trial, not after it";
}

}  // namespace
}  // namespace navvi_study::trial
