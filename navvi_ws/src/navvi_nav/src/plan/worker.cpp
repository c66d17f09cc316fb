#include "plan/worker.hpp"

#include <chrono>

namespace navvi_nav::plan {

void Worker::start(PlanRequest request) {
  std::packaged_task<PlanAnswer()> task([this, request = std::move(request)] {
    const auto begin = std::chrono::steady_clock::now();
    const std::lock_guard<std::timed_mutex> busy(busy_);
    PlanAnswer answer = planner_.answer(request);
    answer.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return answer;
  });
  answer_ = task.get_future();
  thread_ = std::async(std::launch::async, [this, task = std::move(task)]() mutable {
    task();
    done_();
  });
}

std::optional<PlanAnswer> Worker::take() {
  const bool ready =
      answer_.valid() && answer_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  return ready ? std::optional(answer_.get()) : std::nullopt;
}

std::optional<Plan> Worker::ask(Point start, Point goal, double tolerance, double patience) {
  const std::unique_lock<std::timed_mutex> lock(busy_, std::chrono::duration<double>(patience));
  if (!lock) return std::nullopt;
  return planner_.plan_near(start, goal, tolerance);
}

}  // namespace navvi_nav::plan
