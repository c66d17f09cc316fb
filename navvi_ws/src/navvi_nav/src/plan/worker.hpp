#pragma once

#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

#include "plan/planner.hpp"

namespace navvi_nav::plan {

/// Owns the Planner, and answers requests in other threads: one at a time, and besides one that
/// brings a map, so that paths are found on the old mesh while a new one is baked.
class Worker {
 public:
  /// \param done  called in that thread once an answer can be taken
  Worker(const PlannerConfig& config, std::function<void()> done)
      : done_(std::move(done)), planner_(config) {}

  /// The answer to the previous request of its kind must have been taken.
  void start(PlanRequest request);
  /// An answer, once.
  [[nodiscard]] std::optional<PlanAnswer> take();
  /// Plans in the caller's thread, as Planner::plan. \returns nullopt if a request kept the planner
  /// busy for longer than `patience` (s)
  [[nodiscard]] std::optional<Plan> ask(Point start, Point goal, double patience);

 private:
  const std::function<void()> done_;
  std::timed_mutex busy_;  // guards planner_
  Planner planner_;
  struct Job {
    std::future<PlanAnswer> answer;
    std::future<void> thread;  // its destructor waits for the thread
  };
  Job plan_, map_;  // last
};

}  // namespace navvi_nav::plan
