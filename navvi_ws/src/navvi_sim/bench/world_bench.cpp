// A step of the built-in warehouse, alone and with all that a session makes of it, beside Bullet.

#include <ros/serialization.h>
#include <rosgraph_msgs/Clock.h>

#include <cstdio>

#include "bare_bullet.hpp"
#include "medians.hpp"
#include "navvi_sim/scene.hpp"
#include "navvi_sim/state_conversion.hpp"
#include "navvi_sim/warehouse.hpp"
#include "navvi_sim/world.hpp"

namespace {

using namespace navvi_sim;

// Round and round in the southern lane, between shelves and wall, where it meets nothing: both
// robots then do the same.
const FloorPose kStart{6.0, -12.8, 1.57};
constexpr navvi_safety::Velocity kCommand{0.45, 0.3};
constexpr double kDetectionRadius = 5.0;     // m
constexpr std::uint64_t kProximityEach = 2;  // steps: 50 Hz
constexpr std::uint64_t kObstaclesEach = 5;  // steps: 20 Hz
constexpr int kWarmUp = 200;                 // steps, until all that moves is under way

const WorldDescription& description() {
  static const WorldDescription world = warehouse(1, {});
  return world;
}

/// Simulated seconds a second: how many times faster than life.
void count_steps(benchmark::State& state, double step) {
  using benchmark::Counter;
  state.counters["steps/s"] = Counter(1.0, Counter::kIsIterationInvariantRate);
  state.counters["times_life"] = Counter(step, Counter::kIsIterationInvariantRate);
}

template <typename Message>
std::size_t bytes_of(const Message& message) {
  return ros::serialization::serializeMessage(message).num_bytes;
}

/// Everything that sim_node publishes after a step, made and serialized but not sent.
std::size_t state_bytes(const World& world, Scene& looks, std::uint64_t steps) {
  const Snapshot& now = world.now();
  const double floor = description().floor_height;
  const ros::Time stamp(now.time);
  rosgraph_msgs::Clock clock;
  clock.clock = stamp;
  std::size_t bytes = bytes_of(clock) + bytes_of(base_link_msg(now.robot, floor, stamp)) +
                      bytes_of(odometry_msg(now.robot, floor, stamp));
  for (const ContactEvent& contact : now.contacts)
    bytes += bytes_of(contact_msg(description(), now.robot, contact, stamp));
  if (steps % kProximityEach == 0)
    bytes += bytes_of(proximity_msg(description(), now.robot, world.proximity(kDetectionRadius),
                                    kDetectionRadius, stamp));
  if (steps % kObstaclesEach == 0) {
    bytes += bytes_of(obstacles_msg(description(), now, stamp));
    bytes += bytes_of(looks.moving(now, stamp));
  }
  return bytes;
}

void run_world(benchmark::State& state, bool publishing) {
  const WorldConfig config;
  World world(description(), config, kStart, 1);
  for (int i = 0; i < kWarmUp; ++i) (void)world.step(kCommand);
  Scene looks(description(), config.robot);
  std::uint64_t steps = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    if (world.step(kCommand) != World::Status::running) state.SkipWithError("the world stopped");
    if (publishing) bytes += state_bytes(world, looks, ++steps);
  }
  count_steps(state, config.step);
  if (publishing) state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
}

void run_bullet(benchmark::State& state, BareBullet::Settings settings) {
  const WorldConfig config;
  BareBullet bullet(description(), config.robot, kStart, settings);
  for (int i = 0; i < kWarmUp; ++i) bullet.step(kCommand.linear, kCommand.angular, config.step);
  for (auto _ : state) bullet.step(kCommand.linear, kCommand.angular, config.step);
  count_steps(state, config.step);
}

}  // namespace

int main(int argc, char** argv) {
  using benchmark::RegisterBenchmark;
  const std::string step = "World::step", session = "World::step and messages";
  const std::string plain = "Bullet as it comes", lean = "Bullet set as ours";
  const auto unit = benchmark::kMicrosecond;
  RegisterBenchmark(step.c_str(), run_world, false)->Unit(unit);
  RegisterBenchmark(session.c_str(), run_world, true)->Unit(unit);
  RegisterBenchmark(plain.c_str(), run_bullet, BareBullet::Settings::as_they_come)->Unit(unit);
  RegisterBenchmark(lean.c_str(), run_bullet, BareBullet::Settings::as_ours)->Unit(unit);
  const Medians medians(argc, argv);
  std::puts("\nours / bare Bullet, the same bodies at the same time step");
  for (const std::string& ours : {step, session})
    for (const std::string& bare : {plain, lean}) medians.ratio(ours, bare);
  return 0;
}
