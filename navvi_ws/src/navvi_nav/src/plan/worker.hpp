#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "plan/planner.hpp"

namespace navvi_nav::plan {

/// Owns the Planner and one thread that answers one request at a time.
class Worker {
 public:
  explicit Worker(const PlannerConfig& config);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// The previous request's answer must have been taken.
  void start(PlanRequest request);
  /// The answer, once.
  [[nodiscard]] std::optional<PlanAnswer> take();
  /// Plans in the caller's thread, as Planner::plan_near. \returns nullopt if a request kept the
  /// planner busy for longer than `patience` (s)
  [[nodiscard]] std::optional<Plan> ask(Point start, Point goal, double tolerance, double patience);

 private:
  void run();

  std::timed_mutex busy_;  // guards planner_
  Planner planner_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<PlanRequest> request_;
  std::optional<PlanAnswer> answer_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace navvi_nav::plan
