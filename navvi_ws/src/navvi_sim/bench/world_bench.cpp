// A step of a world, alone and with all that a session makes of it, beside Bullet on the same
// bodies; the gaps to what is near.

#include <ros/serialization.h>
#include <rosgraph_msgs/Clock.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <navvi_types/msg_conversion.hpp>

#include "bare_bullet.hpp"
#include "medians.hpp"
#include "navvi_sim/live/world.hpp"
#include "navvi_sim/node/msg_conversion.hpp"
#include "navvi_sim/read/world_source.hpp"
#include "navvi_sim/scene/scene.hpp"

namespace {

using namespace navvi_sim;
using namespace navvi_sim::bench;
using benchmark::RegisterBenchmark;
using navvi_bench::Medians;

constexpr double kDetectionRadius = 5.0;     // m
constexpr std::uint64_t kProximityEach = 2;  // steps: 50 Hz
constexpr std::uint64_t kObstaclesEach = 5;  // steps: 20 Hz
constexpr int kWarmUp = 200;                 // steps, until all that moves is under way
constexpr auto kUnit = benchmark::kMicrosecond;

/// A world, and a robot that goes round and round where it meets nothing: ours and Bullet's then do
/// the same.
struct Scenery {
  WorldDescription world;
  Pose2 start;
  navvi_types::Velocity command;
};

const Scenery& warehouse() {
  static const Scenery scenery{
      read::load_world({"warehouse"}).world, {{6.5, -12.8}, 1.57}, {0.45, 0.45}};
  return scenery;
}

const Scenery& crowded(int cells, std::size_t shelves, std::size_t movers) {
  static std::map<std::tuple<int, std::size_t, std::size_t>, Scenery> made;
  Scenery& scenery = made[{cells, shelves, movers}];
  if (scenery.world.things.empty())
    scenery = {hall(cells, shelves, movers), {{0.5, 4.5}, 1.57}, {0.3, 0.6}};
  return scenery;
}

/// Simulated seconds a second: how many times faster than real time.
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
std::size_t state_bytes(const live::World& world, scene::Scene& looks, std::uint64_t steps) {
  const live::Snapshot& now = world.now();
  const ros::Time stamp(now.time);
  rosgraph_msgs::Clock clock;
  clock.clock = stamp;
  std::size_t bytes = bytes_of(clock) + bytes_of(node::base_link_msg(world.odometry())) +
                      bytes_of(navvi_types::to_msg(world.odometry()));
  for (const navvi_types::Contact& contact : now.contacts)
    bytes += bytes_of(navvi_types::to_msg(contact));
  if (steps % kProximityEach == 0)
    bytes += bytes_of(navvi_types::to_msg(world.proximity(kDetectionRadius)));
  if (steps % kObstaclesEach == 0) {
    bytes += bytes_of(navvi_types::to_msg(world.obstacles()));
    bytes += bytes_of(looks.moving(now, stamp));
  }
  return bytes;
}

void run_world(benchmark::State& state, const Scenery& scenery, bool publishing) {
  const live::WorldConfig config;
  live::World world(scenery.world, config, scenery.start, 1);
  for (int i = 0; i < kWarmUp; ++i) (void)world.step(scenery.command);
  scene::Scene looks(scenery.world, config.robot);
  std::uint64_t steps = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    if (world.step(scenery.command) != live::World::Status::running)
      state.SkipWithError("the world stopped");
    if (publishing) bytes += state_bytes(world, looks, ++steps);
  }
  count_steps(state, config.step);
  if (publishing) state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
}

void run_bullet(benchmark::State& state, const Scenery& scenery) {
  const live::WorldConfig config;
  BareBullet bullet(scenery.world, config.robot, scenery.start);
  const auto step = [&] {
    bullet.step(scenery.command.linear, scenery.command.angular, config.step);
  };
  for (int i = 0; i < kWarmUp; ++i) step();
  for (auto _ : state) step();
  count_steps(state, config.step);
}

void run_proximity(benchmark::State& state, const WorldDescription& description, const Pose2& at) {
  const live::World world(description, {}, at, 1);
  std::size_t near = 0;
  for (auto _ : state) near = world.proximity(kDetectionRadius).things.size();
  state.counters["near"] = static_cast<double>(near);
}

struct Row {
  std::string name;
  const Scenery& scenery;
};

void print_table(const Medians& medians, const std::vector<Row>& rows, double step) {
  std::puts("\n                                   us a step        / bare Bullet      times life");
  std::puts("scene                          Bullet   ours  +msgs   ours  +msgs     ours   +msgs");
  for (const Row& row : rows) {
    const double bare = 1e-3 * medians.get("Bullet, " + row.name, "ms");  // s
    const double ours = 1e-3 * medians.get("World::step, " + row.name, "ms");
    const double all = 1e-3 * medians.get("and messages, " + row.name, "ms");
    if (bare == 0.0 || ours == 0.0 || all == 0.0) continue;  // filtered out
    std::printf("%-29s %7.1f%7.1f%7.1f%7.2f%7.2f%9.0f%8.0f\n", row.name.c_str(), 1e6 * bare,
                1e6 * ours, 1e6 * all, ours / bare, all / bare, step / ours, step / all);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Row> rows{{"warehouse", warehouse()}};
  for (const std::size_t movers : {10, 50, 200, 1000})
    rows.push_back(
        {"500 shelves, " + std::to_string(movers) + " movers", crowded(33, 500, movers)});
  rows.push_back({"300 x 300 m, 1000 movers", crowded(33, 33 * 33, 1000)});
  for (const Row& row : rows) {
    RegisterBenchmark(("World::step, " + row.name).c_str(), run_world, row.scenery, false)
        ->Unit(kUnit);
    RegisterBenchmark(("and messages, " + row.name).c_str(), run_world, row.scenery, true)
        ->Unit(kUnit);
    RegisterBenchmark(("Bullet, " + row.name).c_str(), run_bullet, row.scenery)->Unit(kUnit);
  }
  for (const int cells : {6, 12, 24, 33}) {
    const auto count = static_cast<std::size_t>(cells * cells);
    const Scenery& scenery = crowded(cells, count, count);
    RegisterBenchmark(("proximity among " + std::to_string(2 * count) + " things").c_str(),
                      run_proximity, scenery.world, scenery.start)
        ->Unit(kUnit);
  }
  RegisterBenchmark("proximity in the warehouse", run_proximity, warehouse().world,
                    warehouse().start)
      ->Unit(kUnit);
  const std::filesystem::path meshes = NAVVI_AWS_WORLD;
  if (std::filesystem::exists(meshes)) {
    static const WorldDescription aws = read::load_world({meshes.string()}).world;
    RegisterBenchmark("proximity among the meshes of AWS", run_proximity, aws,
                      Pose2{{1.0, -9.0}, 0.0})
        ->Unit(kUnit);
  }
  const Medians medians(argc, argv, Medians::Print::medians);
  print_table(medians, rows, live::WorldConfig{}.step);
  return 0;
}
