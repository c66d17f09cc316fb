// From a map to a mesh, from two points to a path, and from moved things to another path, beside
// Recast, Detour and TileCache used plainly. Bakes are timed by the clock on the wall, since ours
// may use threads; all else by the processor, so that what else the machine does falls out of it.

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "contestant.hpp"
#include "map/octomap_reader.hpp"
#include "medians.hpp"
#include "octomap_tree.hpp"
#include "search/search.hpp"
#include "visibility_graph.hpp"

namespace {

using namespace navvi_nav;
using namespace navvi_nav::bench;
using benchmark::State;
using navvi_bench::Medians;

constexpr double kMoved = 0.3;  // m, discs from one update to the next
const std::vector<int> kDiscs{1, 10, 50, 200};
constexpr int kSearchedAmong = 50;  // discs
const std::string kAmong = "among discs: ";
constexpr int kJudged = 100;  // queries, by brute force
const std::string kToFloor = "bytes to floor, ours", kToMesh = "bytes to mesh, ours",
                  kToTree = "bytes to tree, octomap", kWatershed = "spans to mesh, watershed",
                  kTileCache = "spans to mesh, TileCache";

double now() {  // s
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Times each search alone, once a query, when all have been asked before.
/// \param before  each of them, untimed
void ask_all(State& state, const Course& course, const Contestant& search,
             const std::function<void()>& before) {
  std::vector<double> times;
  for (const Query& query : course.queries)
    if (search.locate(query)) benchmark::DoNotOptimize(search.find());
  for (auto _ : state) {
    before();
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

/// Times each search alone, when the discs have moved since the query before.
void ask_among_discs(State& state, const Course& course, const Contestant& search) {
  const std::vector<Cylinder> here = course.discs(kSearchedAmong);
  std::vector<Cylinder> there = here;
  for (Cylinder& disc : there) disc.center.x += kMoved;
  std::size_t turn = 0;
  search.place({});
  ask_all(state, course, search, [&] { search.place(++turn % 2 == 0 ? here : there); });
  search.place({});
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
  const plan::NavMeshConfig& mesh = c.config.mesh;
  const auto add = [&c](const std::string& what, const std::function<void()>& run) {
    benchmark::RegisterBenchmark((what + c.name).c_str(),
                                 [run](State& state) {
                                   for (auto _ : state) run();
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  const auto bytes = [&c] {
    return map::MapBytes{c.bytes.data(), c.bytes.size(), true, "OcTree", c.tree.getResolution()};
  };
  add(kToFloor, [&mesh, bytes] {
    benchmark::DoNotOptimize(survey_map(map::read_voxels(bytes()), plan::survey_config(mesh)));
  });
  add(kToMesh, [&c, bytes] { plan::Planner(c.config).set_map(bytes()); });
  add(kToTree, [&c] {
    std::istringstream stream(std::string(c.bytes.begin(), c.bytes.end()));
    octomap::OcTree(c.tree.getResolution()).readBinaryData(stream);
  });
  add(kWatershed, [&c, &mesh] { plain::Detour(c.columns, mesh.robot_radius, mesh.robot_height); });
  add(kTileCache, [&c, &mesh] {
    plain::TileCache(c.columns, mesh.robot_radius, mesh.robot_height, Course::kTile);
  });
}

void declare(Course& c) {
  declare_bakes(c);
  for (const Contestant& search : contestants(c))
    benchmark::RegisterBenchmark((search.name + c.name).c_str(),
                                 [&c, search](State& state) { ask_all(state, c, search, [] {}); })
        ->Iterations(Course::kQueries)
        ->UseManualTime();
  for (const Contestant& search : among_discs(c))
    benchmark::RegisterBenchmark((kAmong + search.name + c.name).c_str(),
                                 [&c, search](State& state) { ask_among_discs(state, c, search); })
        ->Iterations(Course::kQueries)
        ->UseManualTime();
  for (const int count : kDiscs) {
    const auto add = [&](const std::string& who, const auto& replan) {
      benchmark::RegisterBenchmark(
          (who + std::to_string(count) + c.name).c_str(),
          [&c, count, replan](State& state) { move_discs(state, c, count, replan); })
          ->Unit(benchmark::kMillisecond);
    };
    const auto search = std::make_shared<search::Search>(search::SearchMethod::exact);
    add("our replan ", [&c, search](const std::vector<Cylinder>& discs, const Query& query) {
      c.carved.carve(discs);
      const mesh::Mesh& mesh = c.carved.nav_mesh().mesh();
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

void row(const std::string& what, const std::vector<double>& values) {
  std::printf("%-40s", what.c_str());
  for (const double value : values) std::printf(" %10.2f", value);
  std::puts("");
}

void heading(const std::string& what, const std::vector<std::string>& columns) {
  std::printf("\n%-40s", what.c_str());
  for (const std::string& column : columns) std::printf(" %10s", column.c_str());
  std::puts("");
}

/// What a search made of all queries.
struct Answers {
  int failures = 0;
  int too_near = 0;      ///< paths that come nearer than the robot's radius to something
  double length = 0.0;   ///< m, of all
  double longest = 1.0;  ///< times the exact path on Detour's polygons
};

/// The paths themselves, which need no clock.
void compare(Course& c) {
  constexpr double kSlack = 1e-3;  // m, for Detour's single precision
  const std::vector<Contestant> all = contestants(c);
  std::vector<Answers> answers(all.size());
  const map::Space space = c.ours.nav_mesh().space();
  const auto near = [&](const Path& path) {
    for (std::size_t k = 1; k < path.size(); ++k)
      if (!space.segment_clear(path[k - 1], path[k], c.config.mesh.robot_radius - kSlack))
        return true;
    return false;
  };
  for (const Query& query : c.queries) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Path path = all[i].locate(query) ? all[i].find() : Path{};
      lengths.push_back(length_of(path));
      answers[i].length += lengths.back();
      answers[i].failures += path.empty() ? 1 : 0;
      answers[i].too_near += near(path) ? 1 : 0;
    }
    for (std::size_t i = kOursOnDetours; i < all.size(); ++i)
      answers[i].longest = std::max(answers[i].longest, lengths[i] / lengths[kOursOnDetours]);
  }
  heading("paths", {"none", "too near", "mean, m", "/ exact", "longest /"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Answers& exact = answers[i < kOursOnDetours ? 0 : kOursOnDetours];
    row(all[i].name,
        {static_cast<double>(answers[i].failures), static_cast<double>(answers[i].too_near),
         answers[i].length / Course::kQueries, answers[i].length / exact.length,
         answers[i].longest});
  }
}

/// Turns, without bends, and the least clearance of paths.
struct Followed {
  double length = 0.0;  ///< m, of all
  int turns = 0;
  double nearest = 10.0;  ///< m
  void add(const Path& path, const map::Space& space) {
    length += length_of(path);
    for (std::size_t i = 1; i < path.size(); ++i) {
      for (int k = 0; k <= 20; ++k)
        nearest =
            std::min(nearest, space.clearance(path[i - 1] + k / 20.0 * (path[i] - path[i - 1])));
      if (i + 1 == path.size()) continue;
      const Point in = path[i] - path[i - 1];
      const Point out = path[i + 1] - path[i];
      turns += std::abs(std::atan2(cross(in, out), dot(in, out))) >= smooth::kBend;
    }
  }
};

/// us, of the faster of two equal runs: the other work of the machine falls out of the worst case.
double timed(const std::function<void()>& run) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 2; ++i) {
    const double begin = now();
    run();
    least = std::min(least, 1e6 * (now() - begin));
  }
  return least;
}

/// What a user gets: plan() whole, among 0 to 50 discs that have moved since the plan before, and
/// the path that is followed beside the shortest; then once more, when that path is followed.
void follow(Course& c) {
  constexpr int kPlans = 10000;
  search::Search search(search::SearchMethod::exact);
  std::vector<double> whole, part, again;  // us
  Followed shortest, guide, kept;
  for (int i = 0; i < kPlans; ++i) {
    std::vector<Cylinder> discs = c.discs(i % 51);
    for (Cylinder& disc : discs) disc.center.x += 0.1 * (i % 7);
    c.carved.carve(discs);
    const Query& query = c.queries[static_cast<std::size_t>(i % Course::kQueries)];
    const mesh::Mesh& mesh = c.carved.nav_mesh().mesh();
    const auto from = mesh.locate(query.start, 0.0);
    const auto to = mesh.locate(query.goal, 0.0);
    if (!from || !to) continue;
    plan::Plan plan;
    search::Found found;
    whole.push_back(timed([&] { plan = c.carved.plan(query.start, query.goal); }));
    part.push_back(timed([&] { found = search.find(mesh, *from, *to); }));
    if (plan.status != plan::PlanStatus::found || !found.found) continue;
    plan::Plan next;
    again.push_back(timed([&] { next = c.carved.plan(query.start, query.goal, plan.path); }));
    kept.add(next.path, c.carved.nav_mesh().space());
    guide.add(plan.path, c.carved.nav_mesh().space());
    shortest.add(found.path, c.carved.nav_mesh().space());
  }
  c.carved.carve({});
  heading("plan(), 0 to 50 discs moved",
          {"p50, us", "p99, us", "max, us", "length", "turns/10m", "nearest"});
  const auto print = [&](const std::string& what, std::vector<double> times, const Followed& path) {
    std::sort(times.begin(), times.end());
    row(what, {times[times.size() / 2], times[times.size() * 99 / 100], times.back(),
               path.length / shortest.length, 10.0 * path.turns / path.length, path.nearest});
  };
  print("shortest path, the search alone", part, shortest);
  print("guide path, all of plan()", whole, guide);
  print("the same when it is followed", again, kept);
}

std::size_t bytes_in_use() {
  const struct mallinfo2 memory = mallinfo2();
  return memory.uordblks + memory.hblkhd;
}

/// What a planner keeps of a hall, by the square metre of its mesh.
void weigh(const Course& c) {
  const double area = c.floor_area();
  const std::size_t before = bytes_in_use();
  plan::Planner planner(c.config);
  planner.set_map(voxels_of(c.tree));
  const std::size_t with_mesh = bytes_in_use();
  const mesh::Mesh copy = planner.nav_mesh().mesh();
  const std::size_t with_copy = bytes_in_use();
  std::printf("memory, bytes a square metre: %.0f map and mesh (%.0f the mesh alone)\n",
              static_cast<double>(with_mesh - before) / area,
              static_cast<double>(with_copy - with_mesh) / area);
}

/// Largest difference from brute force, relative, without holes and with some.
void judge(Course& c) {
  search::Search search(search::SearchMethod::exact);
  for (const int count : {0, 10, 50}) {
    c.carved.carve(c.discs(count));
    const mesh::Mesh& mesh = c.carved.nav_mesh().mesh();
    VisibilityGraph truth(mesh);
    double gap = 0.0;
    int differ = 0;
    for (int i = 0; i < kJudged; ++i) {
      const Query& query = c.queries[static_cast<std::size_t>(i)];
      const auto from = mesh.locate(query.start, Course::kNear);
      const auto to = mesh.locate(query.goal, Course::kNear);
      if (!from || !to) continue;
      const search::Found& found = search.find(mesh, *from, *to);
      const std::optional<double> shortest = truth.distance(*from, *to);
      if (found.found != shortest.has_value()) ++differ;
      if (found.found && shortest)
        gap = std::max(gap, std::abs(found.length - *shortest) / *shortest);
    }
    std::printf("exact against a visibility graph, %d holes, %d queries: gap %.1e, %d failed\n",
                count, kJudged, gap, differ);
  }
  c.carved.carve({});
}

void print(const Medians& medians, Course& c) {
  const std::string& name = c.name;
  std::printf("\n== %s, 0.1 m voxels, seed %u: %zu polygons ours, %zu Detour's\n", name.c_str(),
              c.seed, c.ours.nav_mesh().mesh().polygons.size(), c.detour.polygons().size());
  heading("map, ms on the wall", {"", "/ TileCache"});
  for (const std::string& what : {kToFloor, kToMesh, kToTree, kWatershed, kTileCache}) {
    const double took = medians.get(what + name, "real_ms");
    row(what, {took, took / medians.get(kTileCache + name, "real_ms")});
  }
  const auto searches = [&](const std::string& what, const std::string& prefix,
                            const std::vector<Contestant>& all) {
    heading(what, {"p50", "p99", "max", "/ Detour", "p99 /"});
    const std::string last = prefix + all.back().name + name;  // Detour
    for (const Contestant& search : all) {
      const auto get = [&](const char* value) {
        return medians.get(prefix + search.name + name, value);
      };
      row(search.name, {get("p50"), get("p99"), get("max"), get("p50") / medians.get(last, "p50"),
                        get("p99") / medians.get(last, "p99")});
    }
  };
  searches("search, us, all queries asked before", "", contestants(c));
  searches("search, us, 50 discs moved", kAmong, among_discs(c));
  heading("discs moved, exact path out, ms", {"ours", "TileCache", "ratio"});
  for (const int count : kDiscs) {
    const std::string which = std::to_string(count) + name;
    const double ours = medians.get("our replan " + which, "ms");
    const double theirs = medians.get("TileCache replan " + which, "ms");
    row(std::to_string(count), {ours, theirs, ours / theirs});
  }
  compare(c);
  follow(c);
  weigh(c);
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
  Course small({50, 30}, seed), small_cluttered({50, 30, 25}, seed), middle({100, 100}, seed),
      cluttered({100, 100, 25}, seed), large({300, 300}, seed);
  const std::vector<Course*> courses{&small, &small_cluttered, &middle, &cluttered, &large};
  for (Course* course : courses) declare(*course);
  const Medians medians(argc, argv, Medians::Print::nothing);
  for (Course* course : courses) print(medians, *course);
  judge(small);
  return 0;
}
