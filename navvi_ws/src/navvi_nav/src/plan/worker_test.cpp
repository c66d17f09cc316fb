#include "plan/worker.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "small_world.hpp"

namespace navvi_nav::plan {
namespace {

PlanRequest with_map(double side) {
  PlanRequest request;
  request.map = std::make_shared<const MapMessage>(
      MapMessage{SmallWorld().room(side, side).bytes(), true, "OcTree", 0.05});
  return request;
}

PlanAnswer answer_of(Worker& worker) {
  std::optional<PlanAnswer> answer = worker.take();
  for (; !answer; answer = worker.take()) std::this_thread::yield();
  return *answer;
}

TEST(Worker, N2_finds_paths_on_the_old_mesh_while_a_large_map_is_baked) {
  Worker worker(PlannerConfig{}, [] {});
  worker.start(with_map(10.0));
  ASSERT_TRUE(answer_of(worker).map_taken);
  worker.start(with_map(80.0));
  PlanRequest request;
  request.start = {2.0, 2.0};
  request.goal = Point{8.0, 8.0};
  worker.start(request);
  const PlanAnswer first = answer_of(worker);
  ASSERT_TRUE(first.plan);
  EXPECT_EQ(first.plan->status, PlanStatus::found);
  EXPECT_LT(first.floor->columns() * first.floor->cell_size(), 20.0);
  EXPECT_TRUE(answer_of(worker).map_taken);
}

}  // namespace
}  // namespace navvi_nav::plan
