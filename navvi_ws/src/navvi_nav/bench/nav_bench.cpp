// From a map to a mesh, from two points to a path, and from moved things to another path, beside
// Recast, Detour and TileCache used plainly. Bakes are timed by the clock on the wall, since ours
// may use threads; all else by the processor, so that what else the machine does falls out of it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "course.hpp"
#include "medians.hpp"
#include "navvi_nav/octomap_reader.hpp"
#include "navvi_nav/search.hpp"

namespace {

using namespace navvi_nav;
using benchmark::State;

constexpr double kMoved = 0.3;  // m, discs from one update to the next
const std::vector<int> kDiscs{1, 10, 50, 200};

double now() {  // s
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// One of the searches that are compared: `find` works on what `locate` left in it.
struct Contestant {
  std::string name;
  std::function<bool(const Query&)> locate;
  std::function<Path()> find;
};

std::vector<Contestant> searches(Course& c) {
  const auto on = [](const std::string& name, const Mesh& mesh, SearchMethod method) {
    const auto search = std::make_shared<Search>(method);
    const auto ends = std::make_shared<std::pair<Mesh::Place, Mesh::Place>>();
    return Contestant{
        name,
        [&mesh, ends](const Query& query) {
          const auto from = mesh.locate(query.start, Course::kNear);
          const auto to = mesh.locate(query.goal, Course::kNear);
          if (from && to) *ends = {*from, *to};
          return from && to;
        },
        [&mesh, ends, search] { return search->find(mesh, ends->first, ends->second).path; }};
  };
  return {
      on("exact, our mesh", c.ours.nav_mesh().mesh(), SearchMethod::exact),
      on("exact, Detour's mesh", c.detours_mesh, SearchMethod::exact),
      on("centroids and funnel, Detour's mesh", c.detours_mesh, SearchMethod::centroid_astar),
      {"Detour", [&c](const Query& q) { return c.detour_query.locate(q.start, q.goal); },
       [&c] { return c.detour_query.search(); }},
  };
}

/// Times each search alone, once a query.
void ask_all(State& state, const Course& course, const Contestant& search) {
  std::vector<double> times;
  for (auto _ : state) {
    const Query& query = course.queries[times.size() % course.queries.size()];
    double took = 0.0;
    if (search.locate(query)) {
      const double begin = now();
      benchmark::DoNotOptimize(search.find());
      took = now() - begin;
    }
    times.push_back(took);
    state.SetIterationTime(took);
  }
  std::sort(times.begin(), times.end());
  state.counters["p50"] = 1e6 * times[times.size() / 2];
  state.counters["p99"] = 1e6 * times[times.size() * 99 / 100];
  state.counters["max"] = 1e6 * times.back();
}

/// Times `replan` with the discs here and 0.3 m farther in turn, and a query each time.
void move_discs(State& state, const Course& course, int count,
                const std::function<void(const std::vector<Cylinder>&, const Query&)>& replan) {
  const std::vector<Cylinder> here = course.discs(count);
  std::vector<Cylinder> there = here;
  for (Cylinder& disc : there) disc.center.x += kMoved;
  replan(here, course.queries[0]);
  std::size_t turn = 0;
  for (auto _ : state) {
    ++turn;
    replan(turn % 2 == 0 ? here : there, course.queries[turn % course.queries.size()]);
  }
  replan({}, course.queries[0]);
}

void declare_bakes(Course& c) {
  const NavMeshConfig& mesh = c.config.mesh;
  const auto add = [&c](const std::string& what, const std::function<void()>& run) {
    benchmark::RegisterBenchmark((what + c.name).c_str(),
                                 [run](State& state) {
                                   for (auto _ : state) run();
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  add("bytes to mesh, ours", [&c] {
    Planner planner(c.config);
    planner.set_map(
        MapBytes{c.bytes.data(), c.bytes.size(), true, "OcTree", c.tree.getResolution()});
  });
  add("spans to mesh, watershed",
      [&c, &mesh] { plain::Detour(c.columns, mesh.robot_radius, mesh.robot_height); });
  add("spans to mesh, TileCache", [&c, &mesh] {
    plain::TileCache(c.columns, mesh.robot_radius, mesh.robot_height, Course::kTile);
  });
}

void declare(Course& c) {
  declare_bakes(c);
  for (const Contestant& search : searches(c))
    benchmark::RegisterBenchmark((search.name + c.name).c_str(),
                                 [&c, search](State& state) { ask_all(state, c, search); })
        ->Iterations(Course::kQueries)
        ->UseManualTime();
  const Contestant ours = searches(c).front();
  for (const int count : kDiscs) {
    const auto add = [&](const std::string& who, const auto& replan) {
      benchmark::RegisterBenchmark(
          (who + std::to_string(count) + c.name).c_str(),
          [&c, count, replan](State& state) { move_discs(state, c, count, replan); })
          ->Unit(benchmark::kMillisecond);
    };
    const auto search = std::make_shared<Search>(SearchMethod::exact);
    add("our replan ", [&c, search](const std::vector<Cylinder>& discs, const Query& query) {
      c.carved.carve(discs);
      const Mesh& mesh = c.carved.nav_mesh().mesh();
      const auto from = mesh.locate(query.start, Course::kNear);
      const auto to = mesh.locate(query.goal, Course::kNear);
      if (from && to) benchmark::DoNotOptimize(search->find(mesh, *from, *to));
    });
    add("TileCache replan ", [&c](const std::vector<Cylinder>& discs, const Query& query) {
      c.tile_cache.place(discs);
      if (c.tile_cache_query.locate(query.start, query.goal))
        benchmark::DoNotOptimize(c.tile_cache_query.search());
    });
  }
}

void row(const std::string& what, const std::vector<double>& values, double ratio) {
  std::printf("%-44s", what.c_str());
  for (const double value : values) std::printf(" %11.2f", value);
  if (ratio > 0.0) std::printf("   ratio %.2f", ratio);
  std::puts("");
}

/// The paths themselves, which need no clock.
struct Answers {
  int failures = 0;
  int too_near = 0;     ///< paths that come nearer than the robot's radius to something
  double length = 0.0;  ///< m
  double worst = 1.0;   ///< longest against the first search of the same mesh
};

void compare(Course& c) {
  constexpr double kSlack = 1e-3;  // m, for Detour's single precision
  const std::vector<Contestant> all = searches(c);
  std::vector<Answers> answers(all.size());
  for (const Query& query : c.queries) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Path path = all[i].locate(query) ? all[i].find() : Path{};
      lengths.push_back(length_of(path));
      answers[i].length += lengths.back();
      if (path.empty()) ++answers[i].failures;
      const auto legs = [&path](const auto& fits) {
        for (std::size_t k = 1; k < path.size(); ++k)
          if (!fits(path[k - 1], path[k])) return false;
        return true;
      };
      if (!legs([&c](Point a, Point b) {
            return c.ours.nav_mesh().space().segment_clear(a, b,
                                                           c.config.mesh.robot_radius - kSlack);
          }))
        ++answers[i].too_near;
      if (i >= 2 && lengths[1] > 0.0)
        answers[i].worst = std::max(answers[i].worst, lengths[i] / lengths[1]);
    }
  }
  std::printf("\n%-44s %11s %11s %11s %11s\n", "paths", "none", "too near", "mean m", "worst x");
  for (std::size_t i = 0; i < all.size(); ++i)
    row(all[i].name,
        {static_cast<double>(answers[i].failures), static_cast<double>(answers[i].too_near),
         answers[i].length / Course::kQueries, answers[i].worst},
        i >= 2 ? answers[i].length / answers[1].length : 0.0);
}

void print(const Medians& medians, Course& c) {
  std::printf("\n== %s, 0.1 m voxels, seed %u: %zu polygons ours, %zu Detour's\n", c.name.c_str(),
              c.seed, c.ours.nav_mesh().mesh().polygons.size(), c.detour.polygons().size());
  std::printf("%-44s %11s\n", "bake", "ms");
  const double cached = medians.get("spans to mesh, TileCache" + c.name, "real_ms");
  for (const std::string what :
       {"bytes to mesh, ours", "spans to mesh, watershed", "spans to mesh, TileCache"}) {
    const double took = medians.get(what + c.name, "real_ms");
    row(what, {took}, took / cached);
  }
  std::printf("\n%-44s %11s %11s %11s\n", "search, us", "p50", "p99", "max");
  for (const Contestant& search : searches(c)) {
    const auto get = [&](const char* value) { return medians.get(search.name + c.name, value); };
    row(search.name, {get("p50"), get("p99"), get("max")},
        get("p50") / medians.get("Detour" + c.name, "p50"));
  }
  std::printf("\n%-44s %11s %11s\n", "discs moved, path out, ms", "ours", "TileCache");
  for (const int count : kDiscs) {
    const std::string which = std::to_string(count) + c.name;
    const double ours = medians.get("our replan " + which, "ms");
    const double theirs = medians.get("TileCache replan " + which, "ms");
    row(std::to_string(count), {ours, theirs}, ours / theirs);
  }
  compare(c);
}

}  // namespace

/// Arguments: `--seed=N` for clutter and queries, and Google Benchmark's own.
int main(int argc, char** argv) {
  std::uint32_t seed = 1;
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "--seed=", 7) != 0) continue;
    seed = static_cast<std::uint32_t>(std::strtoul(argv[i] + 7, nullptr, 10));
    std::copy(argv + i + 1, argv + argc + 1, argv + i);
    --argc;
    break;
  }
  Course small({50, 30}, seed), middle({100, 100}, seed), cluttered({100, 100, 25}, seed),
      large({300, 300}, seed);
  const std::vector<Course*> courses{&small, &middle, &cluttered, &large};
  for (Course* course : courses) declare(*course);
  const Medians medians(argc, argv);
  for (Course* course : courses) print(medians, *course);
  return 0;
}
