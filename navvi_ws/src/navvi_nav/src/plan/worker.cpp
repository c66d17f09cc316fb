#include "plan/worker.hpp"

#include <chrono>

namespace navvi_nav::plan {

void Worker::start(PlanRequest request) {
  Job& job = request.brings_map() ? map_ : plan_;
  std::packaged_task<PlanAnswer()> task([this, request = std::move(request)] {
    const auto begin = std::chrono::steady_clock::now();
    bake::BakedMap baked = planner_.bake(request);
    const std::lock_guard<std::timed_mutex> busy(busy_);
    PlanAnswer answer = planner_.answer(request, std::move(baked));
    answer.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return answer;
  });
  job.answer = task.get_future();
  job.thread = std::async(std::launch::async, [this, task = std::move(task)]() mutable {
    task();
    done_();
  });
}

std::optional<PlanAnswer> Worker::take() {
  for (Job* const job : {&plan_, &map_}) {  // a plan may be of the mesh before
    if (job->answer.valid() &&
        job->answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
      return job->answer.get();
  }
  return std::nullopt;
}

std::optional<Plan> Worker::ask(Point start, Point goal, double patience) {
  const std::unique_lock<std::timed_mutex> lock(busy_, std::chrono::duration<double>(patience));
  if (!lock) return std::nullopt;
  return planner_.plan(start, goal);
}

}  // namespace navvi_nav::plan
