#include "trial/trial_flow.hpp"

#include <algorithm>
#include <utility>

namespace navvi_study::trial {

constexpr double kSimulatorLost = 5.0;             // s, without odometry
constexpr double kGuidanceLost = 10.0;             // s
constexpr double kFeedbackLost = 5.0;              // s; it reports four times a second
constexpr double kOperatorLost = 10.0;             // s
constexpr double kSilent = 1.0;                    // s, of a part that a signal did not end
constexpr double kPlans = 1.5;                     // s, likewise; nav_node may plan for 1 s
constexpr std::int64_t kTimeBack = 1'000'000'000;  // ns
constexpr double kGoalAgain = 2.0;                 // s, before a goal is sent again
constexpr int kGoalTries = 3;

void GoalTries::sent_elsewhere(double time) {
  tries_ = 1;
  sent_ = time;
  stood_ = false;
}

GoalTries::Next GoalTries::next(bool taken, double time, double round_trip) {
  if (stood_ && !taken) tries_ = 0;
  stood_ = taken;
  if (taken || (tries_ > 0 && time - sent_ < kGoalAgain + round_trip)) return Next::wait;
  if (tries_ >= kGoalTries) return Next::give_up;
  ++tries_;
  sent_ = time;
  return Next::send;
}

std::optional<std::int64_t> TrialFlow::deadline() const {
  if (limit_ <= 0) return std::nullopt;
  return start_ + limit_;
}

std::optional<Ending> TrialFlow::watch(const Signs& signs) {
  clock_ = std::max(clock_, signs.now);
  if (signs.disk_full) return Ending{"invalid", "disk_full", signs.latest};
  const std::pair<bool, const char*> losses[] = {
      {signs.world_restarted, "simulator_restarted"},
      {signs.clock_jumped || signs.now + kTimeBack < clock_, "time_went_back"},
      {signs.odometry_silence > kSimulatorLost, "simulator_lost"},
      {signs.guidance_silence > kGuidanceLost, "guidance_lost"},
      {signs.feedback_silence > kFeedbackLost, "feedback_lost"},
      {signs.operator_silence > kOperatorLost, "operator_lost"}};
  for (const auto& [lost, reason] : losses)
    if (lost) return Ending{"aborted", reason, signs.latest};
  const auto end = deadline();
  if (end && signs.now >= *end) return Ending{"timeout", "limit", *end};
  return std::nullopt;
}

std::string TrialFlow::reason_of_stop(const Signs& signs) {
  if (signs.odometry_silence > kSilent) return "simulator_lost";
  if (signs.guidance_silence > kPlans) return "guidance_lost";
  if (signs.feedback_silence > kSilent) return "feedback_lost";
  return "stopped_by_signal";
}

Ending TrialFlow::last_word(Ending ending, const std::optional<Ending>& arrival, bool disk_full) {
  if (arrival && ending.result != "invalid") {
    ending.result = arrival->result;
    ending.reason = arrival->reason;
  }
  return disk_full ? Ending{"invalid", "disk_full", ending.stamp} : ending;
}

}  // namespace navvi_study::trial
