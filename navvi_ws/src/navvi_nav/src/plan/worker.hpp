#pragma once

#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

#include "plan/planner.hpp"

namespace navvi_nav::plan {

/// Owns the Planner, and answers one request at a time in another thread.
class Worker {
 public:
  /// \param done  called in that thread once an answer can be taken
  Worker(const PlannerConfig& config, std::function<void()> done)
      : done_(std::move(done)), planner_(config) {}

  /// The previous request's answer must have been taken.
  void start(PlanRequest request);
  /// The answer, once.
  [[nodiscard]] std::optional<PlanAnswer> take();
  /// Plans in the caller's thread, as Planner::plan_near. \returns nullopt if a request kept the
  /// planner busy for longer than `patience` (s)
  [[nodiscard]] std::optional<Plan> ask(Point start, Point goal, double tolerance, double patience);

 private:
  const std::function<void()> done_;
  std::timed_mutex busy_;  // guards planner_
  Planner planner_;
  std::future<PlanAnswer> answer_;
  std::future<void> thread_;  // last: its destructor waits for the thread
};

}  // namespace navvi_nav::plan
