#include "trial/trial_flow.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <tuple>

namespace navvi_study::trial {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
using Next = GoalTries::Next;

Signs at(double time) {
  Signs signs;
  signs.now = signs.latest = static_cast<std::int64_t>(time * 1e9);
  return signs;
}

TEST(TrialFlow, goes_on_while_all_is_well_and_for_ever_without_a_limit) {
  TrialFlow flow(0.0);
  flow.start(10 * kSecond);
  EXPECT_FALSE(flow.watch(at(1e6)));
  EXPECT_FALSE(flow.deadline());
}

TEST(TrialFlow, ends_at_its_limit_to_the_nanosecond_however_late_that_is_seen) {
  TrialFlow flow(5.0);
  flow.start(10 * kSecond);
  EXPECT_FALSE(flow.watch(at(14.99)));
  const auto ending = flow.watch(at(15.4));
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->result, "timeout");
  EXPECT_EQ(ending->stamp, 15 * kSecond);
}

TEST(TrialFlow, T1_each_loss_ends_the_trial_with_its_own_reason) {
  TrialFlow flow(0.0);
  flow.start(10 * kSecond);
  const std::vector<std::pair<std::string, std::function<void(Signs&)>>> losses{
      {"disk_full", [](Signs& signs) { signs.disk_full = true; }},
      {"simulator_restarted", [](Signs& signs) { signs.world_restarted = true; }},
      {"time_went_back", [](Signs& signs) { signs.now -= 2 * kSecond; }},
      {"time_went_back", [](Signs& signs) { signs.clock_jumped = true; }},
      {"simulator_lost", [](Signs& signs) { signs.odometry_silence = 6.0; }},
      {"guidance_lost", [](Signs& signs) { signs.guidance_silence = 11.0; }},
      {"feedback_lost", [](Signs& signs) { signs.feedback_silence = 6.0; }},
      {"operator_lost", [](Signs& signs) { signs.operator_silence = 11.0; }},
  };
  EXPECT_FALSE(flow.watch(at(20.0)));
  for (const auto& [reason, lose] : losses) {
    Signs signs = at(20.0);
    lose(signs);
    const auto ending = flow.watch(signs);
    ASSERT_TRUE(ending) << reason;
    EXPECT_EQ(ending->reason, reason);
    EXPECT_EQ(ending->result, reason == "disk_full" ? "invalid" : "aborted");
    EXPECT_EQ(ending->stamp, signs.latest);
  }
}

TEST(TrialFlow, takes_a_clock_that_comes_later_than_the_reports_for_no_other_time) {
  TrialFlow flow(0.0);
  flow.start(10 * kSecond);
  Signs signs = at(20.0);
  signs.latest += 5 * kSecond;
  EXPECT_FALSE(flow.watch(signs));
}

TEST(TrialFlow, a_goal_reached_just_before_another_end_counts_but_not_with_holes_in_the_record) {
  const Ending reached{"reached", "goal_reached", 1}, late{"timeout", "limit", 1};
  EXPECT_EQ(TrialFlow::last_word(late, reached, false).result, "reached");
  EXPECT_EQ(TrialFlow::last_word(late, reached, false).reason, "goal_reached");
  EXPECT_EQ(TrialFlow::last_word(late, std::nullopt, false).result, "timeout");
  EXPECT_EQ(TrialFlow::last_word({"invalid", "disk_full", 1}, reached, false).result, "invalid");
  EXPECT_EQ(TrialFlow::last_word(reached, reached, true).result, "invalid");
  EXPECT_EQ(TrialFlow::last_word(reached, reached, true).reason, "disk_full");
}

TEST(TrialFlow, names_the_part_that_had_been_silent_before_a_signal) {
  Signs signs = at(20.0);
  EXPECT_EQ(TrialFlow::reason_of_stop(signs), "stopped_by_signal");
  for (const auto& [silence, most, reason] :
       {std::tuple{&Signs::feedback_silence, 1.0, "feedback_lost"},
        {&Signs::guidance_silence, 1.5, "guidance_lost"},  // it may plan for 1 s
        {&Signs::odometry_silence, 1.0, "simulator_lost"}}) {
    const std::string before = TrialFlow::reason_of_stop(signs);
    signs.*silence = most - 0.1;
    EXPECT_EQ(TrialFlow::reason_of_stop(signs), before);
    signs.*silence = most + 0.1;
    EXPECT_EQ(TrialFlow::reason_of_stop(signs), reason);
  }
}

TEST(GoalTries, sends_a_goal_three_times_two_seconds_apart_then_gives_up) {
  GoalTries tries;
  EXPECT_EQ(tries.next(false, 0.0), Next::send);
  EXPECT_EQ(tries.next(false, 1.9), Next::wait);
  EXPECT_EQ(tries.next(false, 2.0), Next::send);
  EXPECT_EQ(tries.next(false, 4.0), Next::send);
  EXPECT_EQ(tries.next(false, 5.9), Next::wait);
  EXPECT_EQ(tries.next(false, 6.0), Next::give_up);
}

TEST(GoalTries, waits_for_the_answer_of_a_slow_connection) {
  GoalTries tries;
  EXPECT_EQ(tries.next(false, 0.0, 5.0), Next::send);
  EXPECT_EQ(tries.next(false, 6.9, 5.0), Next::wait);
  EXPECT_EQ(tries.next(true, 6.9, 5.0), Next::wait);
  EXPECT_EQ(tries.next(true, 60.0, 5.0), Next::wait);
}

TEST(GoalTries, a_goal_that_is_forgotten_is_sent_again_with_all_tries) {
  GoalTries tries;
  EXPECT_EQ(tries.next(false, 0.0), Next::send);
  EXPECT_EQ(tries.next(false, 2.0), Next::send);
  EXPECT_EQ(tries.next(true, 3.0), Next::wait);
  EXPECT_EQ(tries.next(false, 100.0), Next::send);
  EXPECT_EQ(tries.next(false, 102.0), Next::send);
  EXPECT_EQ(tries.next(false, 104.0), Next::send);
  EXPECT_EQ(tries.next(false, 106.0), Next::give_up);
}

TEST(GoalTries, a_goal_that_a_person_set_is_sent_again_only_if_it_is_not_taken) {
  GoalTries tries;
  EXPECT_EQ(tries.next(false, 0.0), Next::send);
  EXPECT_EQ(tries.next(false, 2.0), Next::send);
  EXPECT_EQ(tries.next(true, 3.0), Next::wait);
  tries.sent_elsewhere(50.0);
  EXPECT_EQ(tries.next(false, 50.1), Next::wait);
  EXPECT_EQ(tries.next(false, 52.1), Next::send);
  EXPECT_EQ(tries.next(false, 54.1), Next::send);
  EXPECT_EQ(tries.next(false, 56.1), Next::give_up) << "the person's was the first of three";
}

}  // namespace
}  // namespace navvi_study::trial
