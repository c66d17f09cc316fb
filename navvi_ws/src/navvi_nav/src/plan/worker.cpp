#include "plan/worker.hpp"

#include <chrono>

namespace navvi_nav::plan {

Worker::Worker(const PlannerConfig& config) : planner_(config), thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Worker::start(PlanRequest request) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    request_ = std::move(request);
  }
  wake_.notify_one();
}

std::optional<PlanAnswer> Worker::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

std::optional<Plan> Worker::ask(Point start, Point goal, double tolerance, double patience) {
  const std::unique_lock<std::timed_mutex> lock(busy_, std::chrono::duration<double>(patience));
  if (!lock) return std::nullopt;
  return planner_.plan_near(start, goal, tolerance);
}

void Worker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || request_; });
    if (stop_) return;
    const PlanRequest request = *std::exchange(request_, std::nullopt);
    lock.unlock();
    const auto begin = std::chrono::steady_clock::now();
    PlanAnswer answer = [&] {
      const std::lock_guard<std::timed_mutex> busy(busy_);
      return planner_.answer(request);
    }();
    answer.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    lock.lock();
    answer_ = std::move(answer);
  }
}

}  // namespace navvi_nav::plan
