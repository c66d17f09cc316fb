// loop_bench [WORLD ...]: the real-time factor of whole sessions without ROS, set-up
// included, and what takes the time. Seconds are those of the processor, of all threads.

#include <ros/package.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <navvi_people/loop/closed_loop.hpp>
#include <string>
#include <vector>

#include "batch/loop_figures.hpp"

namespace {

using navvi_people::loop::ClosedLoop;
using navvi_people::loop::ClosedLoopConfig;
using navvi_study::batch::LoopFigures;
namespace setup = navvi_sim::setup;

constexpr int kSeeds = 6;       // trials of a world
constexpr double kLimit = 600;  // s

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// s that `work` takes, added to `sum`.
template <typename Work>
auto timed(double& sum, const Work& work) {
  const double since = now();
  auto result = work();
  sum += now() - since;
  return result;
}

struct Cost {
  double world = 0.0, octomap = 0.0, ends = 0.0;  ///< of the set-up, made once more
  double setup = 0.0, map = 0.0, driving = 0.0;
  double life = 0.0;  ///< s, simulated
};

/// One trial. The mesh is made while the loop waits for its goal.
void run(const std::string& world, int seed, const std::string& phrases, Cost& cost) {
  ClosedLoopConfig config;
  config.sim.world = world;
  config.sim.seed = seed;
  const auto loaded = timed(cost.world, [&] { return setup::load_world(config.sim); });
  const auto map = timed(cost.octomap, [&] { return setup::map_of(config.sim, loaded.world); });
  (void)timed(cost.ends, [&] { return setup::scenario_of(config.sim, loaded.world, map); });

  const double since = now();
  ClosedLoop trial(config, phrases);
  LoopFigures figures(static_cast<int>(kLimit));
  const double set_up = now();
  double begun = set_up;
  while (trial.step() && figures.watch(trial))
    if (!trial.begun()) begun = now();
  cost.setup += set_up - since;
  cost.map += begun - set_up;
  cost.driving += now() - begun;
  cost.life += trial.time();
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> worlds(argv + 1, argv + argc);
  const std::string phrases = ros::package::getPath("navvi_feedback") + "/config/phrases/en.yaml";
  if (worlds.empty()) worlds = {"easy", "busy"};
  std::printf("%-16s %8s | share of: %6s (%5s %7s %10s) %5s %8s | %9s\n", "world", "x life",
              "set-up", "world", "octomap", "start,goal", "mesh", "driving", "set-up, s");
  for (const std::string& world : worlds) {
    Cost cost;
    for (int seed = 1; seed <= kSeeds; ++seed) run(world, seed, phrases, cost);
    const double all = cost.setup + cost.map + cost.driving;
    const auto percent = [all](double part) { return 100.0 * part / all; };
    std::printf("%-16s %8.0f | %14.0f%% (%4.0f%% %6.0f%% %9.0f%%) %4.0f%% %7.0f%% | %9.3f\n",
                world.c_str(), cost.life / all, percent(cost.setup), percent(cost.world),
                percent(cost.octomap), percent(cost.ends), percent(cost.map), percent(cost.driving),
                (cost.setup + cost.map) / kSeeds);
    std::fflush(stdout);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "navvi: %s\n", error.what());
  return 2;
}
