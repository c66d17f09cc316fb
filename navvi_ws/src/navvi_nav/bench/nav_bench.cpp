// From a map to a mesh, from two points to a path, and from moved things to another path, beside
// TileCache used plainly. Bakes are timed by the clock on the wall, since ours
// may use threads; all else by the processor, so that what else the machine does falls out of it.

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <navvi_floor/octomap_reader.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "course.hpp"
#include "medians.hpp"
#include "octomap_tree.hpp"
#include "plan/worker.hpp"
#include "search/search.hpp"
#include "smooth/guide_cost.hpp"
#include "smooth/turns.hpp"
#include "visibility_graph.hpp"

namespace {

using namespace navvi_nav;
using namespace navvi_nav::bench;
using benchmark::State;
using navvi_bench::Medians;

constexpr double kMoved = 0.3;  // m, discs from one update to the next
const std::vector<int> kDiscs{1, 10, 50, 200};
constexpr int kMostInSession = 50;  // discs that a live session asks for
constexpr double kOneTurn = 1.0;    // m, as PathFollowerConfig's
const std::string kToFloor = "bytes to floor, ours, all threads",
                  kToMesh = "bytes to mesh, ours, all threads",
                  kOneThread = "bytes to mesh, ours, one thread",
                  kChanged = "one box changed, ours, all threads",
                  kToTree = "bytes to tree, octomap", kTileCache = "spans to mesh, TileCache";

/// Times `replan` with the discs here and 0.3 m farther in turn, and a query each time.
void move_discs(State& state, const Course& course, int count, const std::vector<Query>& queries,
                const std::function<void(const std::vector<Cylinder>&, const Query&)>& replan) {
  const std::vector<Cylinder> here = course.discs(count);
  std::vector<Cylinder> there = here;
  for (Cylinder& disc : there) disc.center.x += kMoved;
  replan(here, queries[0]);
  std::size_t turn = 0;
  for (auto _ : state) {
    ++turn;
    replan(turn % 2 == 0 ? here : there, queries[turn % queries.size()]);
  }
  replan({}, queries[0]);
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
  plan::PlannerConfig alone = c.config;
  alone.mesh.threads = 1;
  add(kOneThread, [alone, bytes] { plan::Planner(alone).set_map(bytes()); });
  const auto planner = std::make_shared<plan::Planner>(c.config);
  planner->set_map(bytes());
  const auto turn = std::make_shared<int>(0);
  add(kChanged, [planner, turn, &c] {
    const std::vector<std::int8_t>& data = ++*turn % 2 == 0 ? c.bytes : c.changed_bytes;
    planner->set_map(
        map::MapBytes{data.data(), data.size(), true, "OcTree", c.tree.getResolution()});
  });
  add(kToTree, [&c] {
    std::istringstream stream(std::string(c.bytes.begin(), c.bytes.end()));
    octomap::OcTree(c.tree.getResolution()).readBinaryData(stream);
  });
  add(kTileCache,
      [&c, &mesh] { plain::TileCache(c.columns, mesh.robot_radius, mesh.robot_height, c.tile); });
}

void declare(Course& c) {
  declare_bakes(c);
  for (const int count : kDiscs) {
    const auto add = [&](const std::string& who, const auto& replan) {
      benchmark::RegisterBenchmark(
          (who + std::to_string(count) + c.name).c_str(),
          [&c, count, replan](State& state) { move_discs(state, c, count, c.queries, replan); })
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(
          (who + "across the hall " + std::to_string(count) + c.name).c_str(),
          [&c, count, replan](State& state) { move_discs(state, c, count, c.across, replan); })
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
      c.tile_cache->place(discs);
      if (c.tile_cache_query->locate(query.start, query.goal))
        benchmark::DoNotOptimize(c.tile_cache_query->search());
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

/// Turns as they are announced, and the least clearance of paths.
struct Followed {
  double length = 0.0;  ///< m, of all
  std::size_t turns = 0;
  double nearest = 10.0;  ///< m
  double cost = 0.0;      ///< m, GuideCost of those that begin and end on the mesh
  std::size_t costed = 0;
  void add(const Path& path, const Course& c) {
    const map::Space space = c.carved.nav_mesh().space();
    const smooth::GuideCost guide_cost(c.config.smoothing.cost, c.carved.nav_mesh().mesh(), space,
                                       c.config.mesh.robot_radius);
    if (const double price = guide_cost.of(path); std::isfinite(price)) {
      cost += price;
      ++costed;
    }
    length += length_of(path);
    for (std::size_t i = 1; i < path.size(); ++i) {
      for (int k = 0; k <= 20; ++k)
        nearest =
            std::min(nearest, space.clearance(path[i - 1] + k / 20.0 * (path[i] - path[i - 1])));
    }
    turns += smooth::turns_of(path, kOneTurn).size() - 1;
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
    kept.add(next.path, c);
    guide.add(plan.path, c);
    shortest.add(found.path, c);
  }
  c.carved.carve({});
  heading("plan(), 0 to 50 discs moved", {"p50, us", "p99, us", "max, us", "p99 / p50", "length",
                                          "turns/10m", "nearest", "cost, m"});
  const auto print = [&](const std::string& what, std::vector<double> times, const Followed& path) {
    std::sort(times.begin(), times.end());
    const double p50 = times[times.size() / 2];
    const double p99 = times[times.size() * 99 / 100];
    row(what, {p50, p99, times.back(), p99 / p50, path.length / shortest.length,
               10.0 * static_cast<double>(path.turns) / path.length, path.nearest,
               path.cost / static_cast<double>(path.costed)});
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
  planner.set_map(map::voxels_of(c.tree));
  const std::size_t with_mesh = bytes_in_use();
  const mesh::Mesh copy = planner.nav_mesh().mesh();
  const std::size_t with_copy = bytes_in_use();
  std::printf("memory, bytes a square metre: %.0f map and mesh (%.0f the mesh alone)\n",
              static_cast<double>(with_mesh - before) / area,
              static_cast<double>(with_copy - with_mesh) / area);
}

/// Largest difference from brute force, relative, without holes and with some.
/// \param places  between all pairs of which a path is looked for
void judge(Course& c, std::size_t places) {
  search::Search search(search::SearchMethod::exact);
  for (const int count : {0, 10, 50}) {
    c.carved.carve(c.discs(count));
    const mesh::Mesh& mesh = c.carved.nav_mesh().mesh();
    std::vector<mesh::Mesh::Place> ends;
    for (std::size_t i = 0; i < places; ++i)
      if (const auto place = mesh.locate(c.queries[i].start, Course::kNear)) ends.push_back(*place);
    const auto truth = VisibilityGraph(mesh).distances(ends);
    double gap = 0.0;
    int queries = 0, wrong = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const search::Found& found = search.find(mesh, ends[i], ends[k]);
        const bool exists = truth[i][k] < VisibilityGraph::kNoWay;
        const double away = found.found && exists
                                ? std::abs(length_of(found.path) - truth[i][k]) / std::max(truth[i][k], 1e-3)
                                : 0.0;
        gap = std::max(gap, away);
        wrong += found.found != exists || away > 1e-9;
        ++queries;
      }
    }
    std::printf("exact against a visibility graph, %s, %d holes: %d queries, %d wrong, gap %.1e\n",
                c.name.c_str(), count, queries, wrong, gap);
    std::fflush(stdout);
  }
  c.carved.carve({});
}

/// What a mapper costs that sends a map every half second, with one box more or less each time:
/// ms of the processor a map, of all threads, from the message on.
double map_at_2_hz(const Course& c) {
  constexpr int kMaps = 20;
  constexpr auto kBeat = std::chrono::milliseconds(500);
  plan::Worker worker(c.config, [] {});
  const auto send = [&](int turn) {
    plan::PlanRequest request;
    request.map = std::make_shared<const plan::MapMessage>(plan::MapMessage{
        turn % 2 == 0 ? c.bytes : c.changed_bytes, true, "OcTree", c.tree.getResolution()});
    worker.start(std::move(request));
  };
  const auto taken = [&worker] {
    while (!worker.take()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  };
  send(0);
  taken();
  const double begin = now(CLOCK_PROCESS_CPUTIME_ID);
  for (int turn = 1; turn <= kMaps; ++turn) {
    send(turn);
    std::this_thread::sleep_for(kBeat);
    taken();
  }
  return 1e3 * (now(CLOCK_PROCESS_CPUTIME_ID) - begin) / kMaps;
}

void print_maps(const Medians& medians, const Course& c) {
  heading("map, ms on the wall", {"", "/ TileCache"});
  for (const std::string& what :
       {kToFloor, kToMesh, kOneThread, kChanged, kToTree, kTileCache}) {
    const double took = medians.get(what + c.name, "real_ms");
    row(what, {took, took / medians.get(kTileCache + c.name, "real_ms")});
  }
  heading("one box changed every 0.5 s, processor", {"ms a map", "% of a core"});
  const double took = map_at_2_hz(c);
  row("message to mesh, ours, in the worker", {took, took / 5.0});
}

void print(const Medians& medians, Course& c, bool maps_alone) {
  const std::string& name = c.name;
  std::printf("\n== %s, %g m voxels, seed %u: %zu polygons\n", name.c_str(),
              c.tree.getResolution(), c.seed, c.carved.nav_mesh().mesh().polygons.size());
  std::printf("TileCache with tiles of %d cells: 50 discs moved and a path, ms:", c.tile);
  for (const auto& [tile, took] : c.tiles_tried) std::printf(" %.2f (%d)", took, tile);
  std::puts("");
  print_maps(medians, c);
  if (maps_alone) return;
  for (const std::string across : {"", "across the hall "}) {
    heading("discs moved, exact path out " + across + "in ms", {"ours", "TileCache", "ratio"});
    for (const int count : kDiscs) {
      const std::string which = across + std::to_string(count) + name;
      const double ours = medians.get("our replan " + which, "ms");
      const double theirs = medians.get("TileCache replan " + which, "ms");
      const std::string far = count > kMostInSession ? ", more than a session asks for" : "";
      row(std::to_string(count) + far, {ours, theirs, ours / theirs});
    }
  }
  follow(c);
  weigh(c);
}

}  // namespace

/// Arguments: `--seed=N` for clutter and queries, `--resolution=M` of the maps, `--largest=M` hall,
/// `--maps` to time nothing but maps, `--judge` to check paths in all halls and nothing else, and
/// Google Benchmark's own.
int main(int argc, char** argv) {
  std::uint32_t seed = 1;
  double resolution = 0.1;
  double largest = 300.0;
  bool judges = false, maps = false;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "--seed=", 7) == 0)
      seed = static_cast<std::uint32_t>(std::strtoul(argv[i] + 7, nullptr, 10));
    else if (std::strncmp(argv[i], "--resolution=", 13) == 0)
      resolution = std::strtod(argv[i] + 13, nullptr);
    else if (std::strncmp(argv[i], "--largest=", 10) == 0)
      largest = std::strtod(argv[i] + 10, nullptr);
    else if (std::strcmp(argv[i], "--judge") == 0)
      judges = true;
    else if (std::strcmp(argv[i], "--maps") == 0)
      maps = true;
    else
      argv[kept++] = argv[i];
  }
  std::vector<std::unique_ptr<Course>> courses;
  for (const Hall hall :
       {Hall{50, 30}, Hall{50, 30, 25}, Hall{100, 100}, Hall{100, 100, 25}, Hall{300, 300}})
    if (hall.length <= largest || courses.empty())
      courses.push_back(std::make_unique<Course>(
          Hall{hall.length, hall.width, hall.clutter, seed, resolution}));
  if (judges) {
    for (const auto& course : courses) judge(*course, 125);
    return 0;
  }
  for (const auto& course : courses) maps ? declare_bakes(*course) : declare(*course);
  const Medians medians(kept, argv, Medians::Print::nothing);
  for (const auto& course : courses) print(medians, *course, maps);
  if (!maps) judge(*courses[0], 30);
  return 0;
}
