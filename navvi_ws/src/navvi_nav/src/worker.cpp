#include "navvi_nav/worker.hpp"

#include <chrono>

namespace navvi_nav {

Worker::Worker(const PlannerConfig& config) : planner_(config), thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Worker::start(Job job) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    job_ = std::move(job);
  }
  wake_.notify_one();
}

std::optional<Outcome> Worker::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(outcome_, std::nullopt);
}

std::optional<Plan> Worker::ask(Point start, Point goal, double tolerance, double patience) {
  const std::unique_lock<std::timed_mutex> lock(busy_, std::chrono::duration<double>(patience));
  if (!lock) return std::nullopt;
  return planner_.plan_near(start, goal, tolerance);
}

void Worker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || job_; });
    if (stop_) return;
    const Job job = *std::exchange(job_, std::nullopt);
    lock.unlock();
    const auto begin = std::chrono::steady_clock::now();
    Outcome outcome = [&] {
      const std::lock_guard<std::timed_mutex> busy(busy_);
      return work(planner_, job);
    }();
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    lock.lock();
    outcome_ = std::move(outcome);
  }
}

}  // namespace navvi_nav
