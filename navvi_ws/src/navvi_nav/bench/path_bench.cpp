// From a map to a mesh and from two points to a path, beside Recast and Detour used plainly.
// Times are of the processor, so that what else the machine does falls out of them.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "course.hpp"
#include "medians.hpp"

namespace {

using namespace navvi_nav;
using benchmark::State;

constexpr int kQueries = Course::kQueries;
constexpr double kHole = 0.5;   // m, radius
constexpr double kMoved = 0.3;  // m, holes from one update to the next
const std::vector<int> kHoles{1, 10, 50};

double now() {  // s
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Times `ask` alone, once a query, after `prepare`.
void ask_all(State& state, const Course& course, const std::function<void(const Query&)>& prepare,
             const std::function<void(const Query&)>& ask) {
  std::vector<double> times;
  for (auto _ : state) {
    const Query& query = course.queries[times.size() % course.queries.size()];
    prepare(query);
    const double begin = now();
    ask(query);
    times.push_back(now() - begin);
    state.SetIterationTime(times.back());
  }
  std::sort(times.begin(), times.end());
  state.counters["p50_us"] = 1e6 * times[times.size() / 2];
  state.counters["p99_us"] = 1e6 * times[times.size() * 99 / 100];
}

void carve(State& state, Course& course, int holes) {
  std::mt19937 random(2);
  std::vector<Cylinder> here, there;
  for (std::uint32_t id = 0; id < static_cast<std::uint32_t>(holes); ++id) {
    here.push_back({id, course.somewhere(random), kHole, {}});
    there.push_back(here.back());
    there.back().center.x += kMoved;
  }
  course.carved.carve({});
  course.carved.carve(there);
  int updates = 0, tiles = 0;
  for (auto _ : state)
    tiles += course.carved.carve(updates++ % 2 == 0 ? here : there).tiles_rebuilt;
  state.counters["tiles"] = static_cast<double>(tiles) / updates;
}

void declare(Course& c) {
  using benchmark::kMicrosecond;
  using benchmark::kMillisecond;
  const auto nothing = [](const Query&) {};
  const auto add = [&c](const std::string& what, const std::function<void(State&)>& run) {
    return benchmark::RegisterBenchmark((what + c.name).c_str(), run);
  };
  const auto add_queries = [&](const std::string& what,
                               const std::function<void(const Query&)>& prepare,
                               const std::function<void(const Query&)>& ask) {
    add(what, [&c, prepare, ask](State& state) { ask_all(state, c, prepare, ask); })
        ->Iterations(kQueries)
        ->UseManualTime()
        ->Unit(kMicrosecond);
  };
  add("our bake", [&c](State& state) {
    for (auto _ : state) {
      Planner planner(c.config);
      planner.set_map(c.map.tree());
    }
  })->Unit(kMillisecond);
  add("plain bake", [&c](State& state) {
    const NavMeshConfig& mesh = c.config.mesh;
    for (auto _ : state) PlainDetour(c.map.tree(), mesh.robot_radius, mesh.robot_height);
  })->Unit(kMillisecond);
  for (const int holes : kHoles)
    add("carve " + std::to_string(holes), [&c, holes](State& state) {
      carve(state, c, holes);
    })->Unit(kMillisecond);

  add_queries("our locate", nothing, [&c](const Query& q) {
    benchmark::DoNotOptimize(c.place(q.start));
    benchmark::DoNotOptimize(c.place(q.goal));
  });
  add_queries("plain locate", nothing, [&c](const Query& q) { c.plain.locate(q.start, q.goal); });
  add_queries(
      "our search",
      [&c](const Query& q) {
        c.ends = {c.place(q.start), c.place(q.goal)};
      },
      [&c](const Query&) { benchmark::DoNotOptimize(c.search(c.ends.first, c.ends.second)); });
  add_queries(
      "plain search", [&c](const Query& q) { c.plain.locate(q.start, q.goal); },
      [&c](const Query&) { benchmark::DoNotOptimize(c.plain.search()); });
  add_queries("our whole", nothing,
              [&c](const Query& q) { benchmark::DoNotOptimize(c.ours.plan(q.start, q.goal)); });
  add_queries("plain whole", nothing, [&c](const Query& q) {
    c.plain.locate(q.start, q.goal);
    benchmark::DoNotOptimize(c.plain.search());
  });
}

void row(const std::string& what, double ours, double plain) {
  std::printf("%-58s %10.2f %10.2f", what.c_str(), ours, plain);
  if (ours > 0.0 && plain > 0.0) std::printf(" %8.2f x", ours / plain);
  std::puts("");
}

/// What one of the planners made of all queries.
struct Answers {
  int failures = 0;
  int too_near = 0;     ///< paths that come nearer than the robot's radius to something
  double length = 0.0;  ///< m, of the queries that all planners answered
};

/// The paths themselves, which need no clock.
void compare(Course& c) {
  constexpr double kSlack = 1e-3;  // m, for Detour's single precision
  const double radius = c.config.mesh.robot_radius - kSlack;
  Answers ours, smoothed, plain, as_far;
  double longest = 0.0, shortest = 1e9;
  const auto judge = [&](Answers& answers, const Path& path) {
    if (path.empty()) ++answers.failures;
    bool clear = true;
    for (std::size_t i = 1; i < path.size(); ++i)
      clear = clear && c.ours.nav_mesh().space().segment_clear(path[i - 1], path[i], radius);
    if (!clear) ++answers.too_near;
  };
  for (const Query& query : c.queries) {
    const Path a = c.search(c.place(query.start), c.place(query.goal));
    const Path b = c.ours.plan(query.start, query.goal).path;
    const Path d = c.plain.locate(query.start, query.goal) ? c.plain.search() : Path{};
    const Path e = c.as_far.locate(query.start, query.goal) ? c.as_far.search() : Path{};
    judge(ours, a);
    judge(smoothed, b);
    judge(plain, d);
    judge(as_far, e);
    if (a.empty() || b.empty() || d.empty() || e.empty()) continue;
    ours.length += length_of(a);
    smoothed.length += length_of(b);
    plain.length += length_of(d);
    as_far.length += length_of(e);
    longest = std::max(longest, length_of(a) / length_of(e));
    shortest = std::min(shortest, length_of(a) / length_of(e));
  }
  const double n = kQueries;
  row("search + funnel: queries without a path", ours.failures, plain.failures);
  row("search + funnel: paths nearer than the radius", ours.too_near, plain.too_near);
  row("search + funnel: mean length, m", ours.length / n, plain.length / n);
  std::puts("  and where the plain mesh is eroded by as much as ours:");
  row("search + funnel: queries without a path", ours.failures, as_far.failures);
  row("search + funnel: paths nearer than the radius", ours.too_near, as_far.too_near);
  row("search + funnel: mean length, m", ours.length / n, as_far.length / n);
  row("plan(), smoothed: mean length, m", smoothed.length / n, as_far.length / n);
  std::printf("%-58s %10.2f to %.2f x\n", "search + funnel: one path's length against the other's",
              shortest, longest);
  std::printf("%-58s %10d\n", "plan(), smoothed: queries without a path", smoothed.failures);
  std::printf("%-58s %10d\n", "plan(), smoothed: paths nearer than the radius", smoothed.too_near);
}

void print(const Medians& medians, Course& c) {
  std::printf("\n%-58s %10s %10s %10s\n",
              ("50 x 30 m," + c.name + " voxels, " + std::to_string(kQueries) + " queries").c_str(),
              "ours", "plain", "ratio");
  const auto both = [&](const std::string& what, const std::string& name,
                        const std::string& value) {
    row(what, medians.get("our " + name + c.name, value),
        medians.get("plain " + name + c.name, value));
  };
  row("polygons", static_cast<double>(c.mesh().polygons.size()), c.plain.polygons());
  both("map to mesh, ms", "bake", "ms");
  for (const int holes : kHoles) {
    const std::string name = "carve " + std::to_string(holes) + c.name;
    char what[80];
    std::snprintf(what, sizeof what, "make %d holes, %.0f tiles / bake again, ms", holes,
                  medians.get(name, "tiles"));
    row(what, medians.get(name, "ms"), medians.get("plain bake" + c.name, "ms"));
  }
  for (const std::string p : {"p50", "p99"}) {
    both("find both ends on the mesh, " + p + ", us", "locate", p + "_us");
    both("search + funnel / findPath + findStraightPath, " + p + ", us", "search", p + "_us");
    both("plan(), smoothed / ends, path, no smoothing, " + p + ", us", "whole", p + "_us");
  }
  compare(c);
}

}  // namespace

int main(int argc, char** argv) {
  Course coarse(0.10), fine(0.05);
  declare(coarse);
  declare(fine);
  const Medians medians(argc, argv);
  print(medians, coarse);
  print(medians, fine);
  return 0;
}
