#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "navvi_nav/navigator.hpp"

namespace navvi_nav {

/// Owns the Planner and one thread that does one job at a time and hands back a value.
class Worker {
 public:
  explicit Worker(const PlannerConfig& config);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// The previous job's outcome must have been taken.
  void start(Job job);
  /// The finished job, once.
  [[nodiscard]] std::optional<Outcome> take();
  /// Plans in the caller's thread, as Planner::plan_near. \returns nullopt if a job kept the
  /// planner busy for longer than `patience` (s)
  [[nodiscard]] std::optional<Plan> ask(Point start, Point goal, double tolerance, double patience);

 private:
  void run();

  std::timed_mutex busy_;  // guards planner_
  Planner planner_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Job> job_;
  std::optional<Outcome> outcome_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace navvi_nav
