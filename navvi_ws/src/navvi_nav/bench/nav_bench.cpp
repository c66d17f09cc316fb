// From a map to a mesh, from two points to a path, and from moved things to another path, beside
// Recast, Detour and TileCache used plainly. Bakes are timed by the clock on the wall, since ours
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

#include "contestant.hpp"
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
constexpr int kMostInSession = 50;              // discs that a live session asks for
const std::vector<int> kSearchedAmong{10, 50};  // discs
constexpr double kOneTurn = 1.0;                // m, as PathFollowerConfig's
const std::string kToFloor = "bytes to floor, ours, all threads",
                  kToMesh = "bytes to mesh, ours, all threads",
                  kOneThread = "bytes to mesh, ours, one thread",
                  kChanged = "one box changed, ours, all threads",
                  kToTree = "bytes to tree, octomap", kWatershed = "spans to mesh, watershed",
                  kTileCache = "spans to mesh, TileCache";

std::string among(int discs) { return "among " + std::to_string(discs) + " discs: "; }

/// Times each search alone, once a query, when all have been asked before; then the same twice
/// more, to tell how many times as long as its own median each took. \param before  each of them,
/// untimed
void ask_all(State& state, const Course& course, const Contestant& search,
             const std::function<void()>& before) {
  std::vector<double> times;
  double worst = 1.0;
  for (const Query& query : course.queries)
    if (search.locate(query)) benchmark::DoNotOptimize(search.find());
  for (auto _ : state) {
    before();
    const Query& query = course.queries[times.size() % course.queries.size()];
    double took[3] = {};
    if (search.locate(query)) {
      for (double& time : took) {
        const double begin = now();
        benchmark::DoNotOptimize(search.find());
        time = now() - begin;
      }
    }
    times.push_back(took[0]);
    state.SetIterationTime(took[0]);
    std::sort(std::begin(took), std::end(took));
    if (took[1] > 0.0) worst = std::max(worst, times.back() / took[1]);
  }
  state.counters["own"] = worst;
  std::sort(times.begin(), times.end());
  state.counters["p50"] = 1e6 * times[times.size() / 2];
  state.counters["p99"] = 1e6 * times[times.size() * 99 / 100];
  state.counters["max"] = 1e6 * times.back();
}

/// Times each search alone, when the discs have moved since the query before.
void ask_among_discs(State& state, const Course& course, const Contestant& search, int discs) {
  const std::vector<Cylinder> here = course.discs(discs);
  std::vector<Cylinder> there = here;
  for (Cylinder& disc : there) disc.center.x += kMoved;
  std::size_t turn = 0;
  search.place({});
  ask_all(state, course, search, [&] { search.place(++turn % 2 == 0 ? here : there); });
  search.place({});
}

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
  add(kWatershed, [&c, &mesh] { plain::Detour(c.columns, mesh.robot_radius, mesh.robot_height); });
  add(kTileCache,
      [&c, &mesh] { plain::TileCache(c.columns, mesh.robot_radius, mesh.robot_height, c.tile); });
}

void declare(Course& c) {
  declare_bakes(c);
  for (const Contestant& search : contestants(c))
    benchmark::RegisterBenchmark((search.name + c.name).c_str(),
                                 [&c, search](State& state) { ask_all(state, c, search, [] {}); })
        ->Iterations(Course::kQueries)
        ->UseManualTime();
  for (const int discs : kSearchedAmong) {
    for (const Contestant& search : among_discs(c))
      benchmark::RegisterBenchmark(
          (among(discs) + search.name + c.name).c_str(),
          [&c, search, discs](State& state) { ask_among_discs(state, c, search, discs); })
          ->Iterations(Course::kQueries)
          ->UseManualTime();
  }
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

/// What a better heuristic could spare: nodes expanded beside the polygons that the path crosses,
/// each of which every search must expand.
void count_nodes(Course& c) {
  constexpr double kStep = 0.05;  // m, between places at which the path's polygon is looked up
  search::Search search(search::SearchMethod::exact);
  const mesh::Mesh& mesh = c.ours.nav_mesh().mesh();
  std::vector<double> expanded, crossed, share;
  for (const Query& query : c.queries) {
    const auto from = mesh.locate(query.start, Course::kNear);
    const auto to = mesh.locate(query.goal, Course::kNear);
    if (!from || !to) continue;
    const search::Found& found = search.find(mesh, *from, *to);
    if (!found.found || found.nodes_expanded == 0) continue;
    int polygons = 0, last = -1;
    for (std::size_t i = 1; i < found.path.size(); ++i) {
      const Point leg = found.path[i] - found.path[i - 1];
      const int steps = static_cast<int>(std::ceil(norm(leg) / kStep));
      for (int k = 0; k <= steps; ++k) {
        const auto here =
            mesh.locate(found.path[i - 1] + k / std::max(1.0, 1.0 * steps) * leg, 0.0);
        if (!here || here->polygon == last) continue;
        last = here->polygon;
        ++polygons;
      }
    }
    expanded.push_back(static_cast<double>(found.nodes_expanded));
    crossed.push_back(polygons);
    share.push_back(polygons / expanded.back());
  }
  heading("nodes of the exact search", {"p50", "p99"});
  const auto print = [](const std::string& what, std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    row(what, {values[values.size() / 2], values[values.size() * 99 / 100]});
  };
  print("expanded", expanded);
  print("polygons that the path crosses", crossed);
  print("crossed / expanded", share);
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

/// The first query on a mesh that was just baked, and the same asked again.
void ask_first(Course& c) {
  constexpr std::size_t kBakes = 10;
  std::vector<double> ours[2], theirs[2];  // us
  const auto time_twice = [](std::vector<double>* times, const auto& find) {
    for (int i = 0; i < 2; ++i) {
      const double begin = now();
      find();
      times[i].push_back(1e6 * (now() - begin));
    }
  };
  for (std::size_t i = 0; i < kBakes; ++i) {
    const Query& query = c.queries[i];
    plan::Planner planner(c.config);
    planner.set_map(map::voxels_of(c.tree));
    const mesh::Mesh& mesh = planner.nav_mesh().mesh();
    search::Search search(search::SearchMethod::exact);
    const auto from = mesh.locate(query.start, Course::kNear);
    const auto to = mesh.locate(query.goal, Course::kNear);
    if (from && to)
      time_twice(ours, [&] { benchmark::DoNotOptimize(search.find(mesh, *from, *to)); });
    const plain::Detour detour(c.columns, c.config.mesh.robot_radius, c.config.mesh.robot_height);
    plain::Query detours(detour.mesh());
    if (detours.locate(query.start, query.goal))
      time_twice(theirs, [&] { benchmark::DoNotOptimize(detours.search()); });
  }
  heading("first query on a new mesh, us", {"p50", "max", "again p50", "/ Detour"});
  const auto median = [](std::vector<double>& times) {
    std::sort(times.begin(), times.end());
    return times.empty() ? 0.0 : times[times.size() / 2];
  };
  const double first = median(theirs[0]);
  for (auto* times : {ours, theirs}) {
    const double p50 = median(times[0]);
    row(times == ours ? "exact, our mesh" : "Detour",
        {p50, times[0].back(), median(times[1]), p50 / first});
  }
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
                                ? std::abs(found.length - truth[i][k]) / std::max(truth[i][k], 1e-3)
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
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  for (int turn = 1; turn <= kMaps; ++turn) {
    send(turn);
    std::this_thread::sleep_for(kBeat);
    taken();
  }
  return (now() - begin) / kMaps;
}

void print_maps(const Medians& medians, const Course& c) {
  heading("map, ms on the wall", {"", "/ TileCache"});
  for (const std::string& what :
       {kToFloor, kToMesh, kOneThread, kChanged, kToTree, kWatershed, kTileCache}) {
    const double took = medians.get(what + c.name, "real_ms");
    row(what, {took, took / medians.get(kTileCache + c.name, "real_ms")});
  }
  heading("one box changed every 0.5 s, processor", {"ms a map", "% of a core"});
  const double took = map_at_2_hz(c);
  row("message to mesh, ours, in the worker", {took, took / 5.0});
}

void print(const Medians& medians, Course& c, bool maps_alone) {
  const std::string& name = c.name;
  std::printf("\n== %s, %g m voxels, seed %u: %zu polygons ours, %zu Detour's\n", name.c_str(),
              c.tree.getResolution(), c.seed, c.ours.nav_mesh().mesh().polygons.size(),
              c.detour.polygons().size());
  std::printf("TileCache with tiles of %d cells: 50 discs moved and a path, ms:", c.tile);
  for (const auto& [tile, took] : c.tiles_tried) std::printf(" %.2f (%d)", took, tile);
  std::puts("");
  print_maps(medians, c);
  if (maps_alone) return;
  const auto searches = [&](const std::string& what, const std::string& prefix,
                            const std::vector<Contestant>& all) {
    heading(what, {"p50", "p99", "max", "/ Detour", "p99 /", "/ own p50"});
    const std::string last = prefix + all.back().name + name;  // Detour
    for (const Contestant& search : all) {
      const auto get = [&](const char* value) {
        return medians.get(prefix + search.name + name, value);
      };
      row(search.name, {get("p50"), get("p99"), get("max"), get("p50") / medians.get(last, "p50"),
                        get("p99") / medians.get(last, "p99"), get("own")});
    }
  };
  searches("search, us, all queries asked before", "", contestants(c));
  for (const int discs : kSearchedAmong)
    searches("search, us, " + std::to_string(discs) + " discs moved", among(discs), among_discs(c));
  ask_first(c);
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
  count_nodes(c);
  compare(c);
  follow(c);
  weigh(c);
}

}  // namespace

/// Arguments: `--seed=N` for clutter and queries, `--resolution=M` of the maps, `--largest=M` hall,
/// `--maps` to time nothing but maps, `--nodes` to count nodes and nothing else, `--judge` to check
/// paths in all halls and nothing else, and Google Benchmark's own.
int main(int argc, char** argv) {
  std::uint32_t seed = 1;
  double resolution = 0.1;
  double largest = 300.0;
  bool judges = false, maps = false, nodes = false;
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
    else if (std::strcmp(argv[i], "--nodes") == 0)
      nodes = true;
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
          Hall{hall.length, hall.width, hall.clutter, seed, resolution}, seed));
  if (judges) {
    for (const auto& course : courses) judge(*course, 125);
    return 0;
  }
  if (nodes) {
    for (const auto& course : courses) {
      std::printf("\n== %s", course->name.c_str());
      count_nodes(*course);
    }
    return 0;
  }
  for (const auto& course : courses) maps ? declare_bakes(*course) : declare(*course);
  const Medians medians(kept, argv, Medians::Print::nothing);
  for (const auto& course : courses) print(medians, *course, maps);
  if (!maps) judge(*courses[0], 30);
  return 0;
}
