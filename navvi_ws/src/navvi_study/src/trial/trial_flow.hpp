#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace navvi_study::trial {

/// How and when a trial ended.
struct Ending {
  std::string result;      ///< reached, timeout, refused, aborted, invalid
  std::string reason;      ///< in words with underscores
  std::int64_t stamp = 0;  ///< ns, ROS time
};

/// Signs that a trial may continue, or must end. Silences are s of the wall clock, stamps ns of ROS
/// time.
struct Signs {
  std::int64_t now = 0;
  std::int64_t latest = 0;  ///< of any report
  bool disk_full = false;
  bool world_restarted = false;
  bool clock_jumped = false;  ///< for a moment at least
  double odometry_silence = 0.0;
  double guidance_silence = 0.0;
  double feedback_silence = 0.0;
  double operator_silence = 0.0;  ///< of a simulated one; 0 for a person, as they may rest
};

/// Sets a goal until the guidance shows it. Times are s, monotonic.
class GoalTries {
 public:
  enum class Next { wait, send, give_up };

  /// Another node has sent another goal: the first try.
  void sent_elsewhere(double time);
  /// What to do now; `send` counts as a try. A goal that stood and is forgotten, as by a guidance
  /// that was started anew, is sent again with all tries.
  /// \param taken  the guidance shows the goal \param round_trip  s, of the connection
  [[nodiscard]] Next next(bool taken, double time, double round_trip = 0.0);

 private:
  int tries_ = 0;
  double sent_ = 0.0;
  bool stood_ = false;
};

/// When a trial ends that is neither reached nor refused.
class TrialFlow {
 public:
  /// \param limit  s of ROS time; 0 for none
  explicit TrialFlow(double limit) : limit_(static_cast<std::int64_t>(limit * 1e9)) {}

  /// \param stamp  ns, ROS time
  void start(std::int64_t stamp) {
    start_ = stamp;
    clock_ = 0;
  }
  /// ns of ROS time, when time is up
  [[nodiscard]] std::optional<std::int64_t> deadline() const;
  /// A clock that comes late by another connection than the reports is not one that goes back.
  [[nodiscard]] std::optional<Ending> watch(const Signs& signs);
  /// The reason of a trial that is ended by a signal: a part that had been silent before, else the
  /// signal. roslaunch ends a session whose simulator has crashed just as one that a hand stops.
  [[nodiscard]] static std::string reason_of_stop(const Signs& signs);
  /// What counts in the end: an arrival just before, but never a record with holes.
  [[nodiscard]] static Ending last_word(Ending ending, const std::optional<Ending>& arrival,
                                        bool disk_full);

 private:
  std::int64_t limit_;
  std::int64_t start_ = 0;
  std::int64_t clock_ = 0;  ///< ns, the latest ROS time of the trial
};

}  // namespace navvi_study::trial
