// Hundreds of seeded trials with the simulated operator, faster than they could be lived:
// `./navvi bench trials --world=busy --seeds=1-20`.

#include <ros/package.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <navvi_config/reader.hpp>
#include <navvi_people/loop/closed_loop.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch/loop_figures.hpp"
#include "batch/loop_trace.hpp"
#include "batch/world_cache.hpp"
#include "record/child_process.hpp"

namespace navvi_study::bench {
namespace {

using batch::LoopFigures;
using batch::LoopTrace;
using navvi_people::loop::ClosedLoop;
using navvi_people::loop::ClosedLoopConfig;

constexpr const char* kUsage =
    "bench trials [--world=NAME|FILE[,...]] [--seeds=1-10] [--limit=300] [--profile=paper]\n"
    "             [--sensing=truth|lidar|robot] [--jobs=1] [--cache=512] [--csv]\n"
    "             [--trace[=FROM-TO]] [--check] [part/name:=value ...]\n"
    "One row a trial. --trace tells what happens, second by second, between FROM and TO (s).\n"
    "--check runs nothing: exit code 2 and a sentence where a parameter would be rejected.\n"
    "--sensing gives guidance and feedback what a lidar, or a lidar and a depth camera, show.\n"
    "--cache: MB of ~/.cache/navvi/worlds, which keeps map, start, goal and mesh of each world "
    "and seed\n"
    "for other trials; 0: nothing is kept.\n"
    "A part is sim, nav, feedback, person or perception, with the names of its node's "
    "parameters, such as\n"
    "nav/replan/hold_time:=3 or sim/goal:=3,4; `./navvi parameters` tells them all.\n";

constexpr std::int64_t kMostTrials = 100000;
constexpr int kMostJobs = 256;
constexpr int kMostMegabytes = 1000000;

/// A sentence for who typed the command.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Span {
  int from = 1;
  int to = 3;
};

struct Options {
  std::vector<std::string> worlds = {"training", "easy"};
  Span seeds;
  double limit = 300.0;
  std::string profile = "default";
  int jobs = 1;
  int cache = 512;            ///< MB
  std::optional<Span> trace;  ///< s
  std::vector<std::string> parameters;
  bool csv = false;
  bool check = false;
  bool help = false;
};

int number(const std::string& option, const std::string& text, int least, int most = 1000000000) {
  std::size_t used = 0;
  int value = least - 1;
  try {
    value = std::stoi(text, &used);
  } catch (const std::exception&) {
  }
  if (used != text.size() || value < least || value > most)
    throw UsageError(option + " has \"" + text + "\"; allowed are whole numbers from " +
                     std::to_string(least) + " to " + std::to_string(most) + ".");
  return value;
}

/// "3" or "3-8".
Span span(const std::string& option, const std::string& text) {
  const std::size_t dash = text.find('-');
  Span out;
  out.from = number(option, text.substr(0, dash), 0);
  out.to = dash == std::string::npos ? out.from : number(option, text.substr(dash + 1), out.from);
  return out;
}

std::vector<std::string> list(const std::string& text) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) items.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return items;
}

Options read_options(const std::vector<std::string>& words) {
  Options out;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string option = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (word.rfind("--", 0) != 0) {
      out.parameters.push_back(word);
    } else if (option == "--world") {
      out.worlds = list(value);
    } else if (option == "--seeds") {
      out.seeds = span(option, value);
    } else if (option == "--limit") {
      out.limit = number(option, value, 1);
    } else if (option == "--profile") {
      out.profile = value;
    } else if (option == "--sensing") {
      out.parameters.push_back("sim/sensing:=" + value);
    } else if (option == "--jobs") {
      out.jobs = number(option, value, 1, kMostJobs);
    } else if (option == "--cache") {
      out.cache = number(option, value, 0, kMostMegabytes);
    } else if (option == "--trace") {
      out.trace = value.empty() ? Span{0, 1000000} : span(option, value);
    } else if (option == "--csv") {
      out.csv = true;
    } else if (option == "--check") {
      out.check = true;
    } else if (option == "--help") {
      out.help = true;
    } else {
      throw UsageError("\"" + word + "\" is not an option; allowed are:\n" + kUsage);
    }
  }
  if (out.trace && out.csv) throw UsageError("--csv is for rows, --trace for what happens.");
  if (out.trace && out.jobs > 1)
    throw UsageError("--trace tells of one trial after the other: it needs --jobs=1.");
  const std::int64_t trials = (std::int64_t{out.seeds.to} - out.seeds.from + 1) *
                              static_cast<std::int64_t>(out.worlds.size());
  if (trials > kMostTrials)
    throw UsageError("the worlds and seeds make " + std::to_string(trials) +
                     " trials; allowed are " + std::to_string(kMostTrials) + ".");
  return out;
}

std::string share(const std::string& package) {
  const std::string path = ros::package::getPath(package);
  if (path.empty())
    throw UsageError("the package " + package + " is not found; source devel/setup.bash first.");
  return path;
}

ClosedLoopConfig configured(const Options& options) {
  ClosedLoopConfig config;
  const auto overlay = [&](auto& part, const std::string& package) {
    const std::string file = share(package) + "/config/" + options.profile + ".yaml";
    navvi_config::read(part, navvi_config::load_yaml(file), file);
  };
  overlay(config.sim, "navvi_sim");
  overlay(config.nav, "navvi_nav");
  overlay(config.feedback, "navvi_feedback");
  navvi_config::read(config, navvi_config::read_words(options.parameters), "the command line");
  return config;
}

struct Task {
  std::string world;
  int seed = 1;
};

record::Fields run_trial(const Options& options, ClosedLoopConfig config,
                         const std::string& phrases, const navvi_files::Cache* cache,
                         const Task& task) {
  config.sim.world = task.world;
  config.sim.seed = task.seed;
  ClosedLoop loop(config, phrases, cache);
  LoopFigures figures(options.limit);
  std::optional<LoopTrace> trace;
  if (options.trace) trace.emplace(std::cout, options.trace->from, options.trace->to);
  bool goes_on = true;
  while (goes_on) {
    if (!loop.step()) throw std::runtime_error("a number in the world is not finite");
    goes_on = figures.watch(loop);
    if (trace) trace->watch(loop);
  }
  return figures.row(loop);
}

/// What a column shows: its title, its width, and the fields in it.
struct Column {
  const char* title;
  int width;
  std::vector<const char*> fields;
};

const std::vector<Column>& columns() {
  static const std::vector<Column> all = {
      {"result", -8, {"result"}},
      {"time", 6, {"time"}},
      {"driven/short", 12, {"driven", "shortest"}},
      {"reroutes", 8, {"reroutes"}},
      {"turns/min", 9, {"turns"}},
      {"flips/reversed/misled", 21, {"flips", "reversed", "misled"}},
      {"cues/words/min talk", 20, {"cues", "words", "talk"}},
      {"repeats/odds/waits/hasty", 24, {"repeats", "at_odds", "waits", "hasty"}},
      {"speechless", 10, {"speechless"}},
      {"turns/left/tail/acts", 20, {"led_turns", "residual", "residual_90", "cue_to_action"}},
      {"gap/motors", 11, {"least_gap", "motors"}},
      {"follow/block/room/noroute/offmesh/other",
       39,
       {"following", "blocked", "make_room", "no_route", "off_mesh", "other"}},
      {"still@", 12, {"still", "still_at"}},
      {"hits", -20, {"hits"}},
      {"passed/missed/ghosts/lag", 24, {"passed", "missed", "ghosts", "lag"}},
      {"late warned", -12, {"late", "warned"}},
      {"at the end of the standstill", -1, {"why"}},
  };
  return all;
}

void print_row(const Task& task, const record::Fields& row) {
  std::printf("%-10s %4d ", task.world.c_str(), task.seed);
  for (const Column& column : columns()) {
    std::string cell;
    for (const char* field : column.fields) cell += (cell.empty() ? "" : "/") + row.get(field);
    std::printf(" %*s", column.width, cell.c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

void print_titles() {
  std::printf("%-10s %4s ", "world", "seed");
  for (const Column& column : columns()) std::printf(" %*s", column.width, column.title);
  std::printf("\n");
  std::fflush(stdout);
}

/// Titles, or a row, as CSV: a cell a field.
void print_csv(const std::string& first, const std::function<std::string(const char*)>& cell) {
  std::cout << first;
  for (const Column& column : columns())
    for (const char* field : column.fields) std::cout << ',' << std::quoted(cell(field), '"', '"');
  std::cout << std::endl;
}

/// All trials in one line.
class Total {
 public:
  void add(const record::Fields& row) {
    ++trials_;
    const bool reached = row.get("result") == "reached";
    reached_ += reached ? 1 : 0;
    for (const char* name : {"time", "driven", "shortest"})
      if (reached) sums_[name] += row.number(name).value_or(0.0);
    for (const char* name : {"reroutes", "turns", "flips", "misled", "still", "cues", "words",
                             "talk", "repeats", "waits", "hasty", "at_odds", "reversed", "late",
                             "speechless", "passed", "missed", "ghosts"})
      sums_[name] += row.number(name).value_or(0.0);
    for (const char* name : {"following", "blocked", "make_room", "no_route", "off_mesh", "other"})
      states_ += row.number(name).value_or(0.0);
    for (const char* name : {"blocked", "make_room", "no_route", "off_mesh"})
      sums_[name] += row.number(name).value_or(0.0);
    clean_ += row.get("hits") == "-" ? 1 : 0;
  }

  void print() const {
    if (trials_ == 0) return;
    const auto mean = [&](const char* name) { return get(name) / trials_; };
    const auto share = [&](const char* name) { return 100.0 * get(name) / std::max(1.0, states_); };
    std::printf(
        "%d of %d reached in %.0f s on the mean, %.2f x the shortest way; %d without a contact; "
        "on the mean %.1f reroutes, %.1f turns/min, %.1f flips, %.1f misled, "
        "longest standstill %.0f s; blocked %.1f %%, make room %.1f %%, no route %.1f %%, off mesh "
        "%.1f %% of the "
        "time; %.1f cues and %.0f words a minute, %.0f %% of the time; %.2f repeats, %.1f words to "
        "wait or stop; in all %.0f of these hasty, %.0f directions reversed, %.0f at odds with "
        "what "
        "is ahead, %.0f pushes without a word, %.0f movers hit that were felt or told of late\n",
        reached_, trials_, reached_ > 0 ? get("time") / reached_ : 0.0,
        get("shortest") > 0.0 ? get("driven") / get("shortest") : 0.0, clean_, mean("reroutes"),
        mean("turns"), mean("flips"), mean("misled"), mean("still"), share("blocked"),
        share("make_room"), share("no_route"), share("off_mesh"), mean("cues"), mean("words"),
        100.0 * mean("talk"), mean("repeats"), mean("waits"), get("hasty"), get("reversed"),
        get("at_odds"), get("speechless"), get("late"));
  }

 private:
  [[nodiscard]] double get(const char* name) const {
    const auto found = sums_.find(name);
    return found == sums_.end() ? 0.0 : found->second;
  }

  int trials_ = 0;
  int reached_ = 0;
  int clean_ = 0;
  double states_ = 0.0;
  std::map<std::string, double> sums_;
};

int run(const Options& options) {
  const ClosedLoopConfig config = configured(options);
  if (options.check) return 0;
  const std::string phrases = share("navvi_feedback") + "/config/phrases/en.yaml";
  const auto cache = batch::world_cache(static_cast<std::uintmax_t>(options.cache));
  const auto seeds = static_cast<std::size_t>(options.seeds.to - options.seeds.from) + 1;
  const auto task_of = [&](std::size_t index) {
    return Task{options.worlds[index / seeds],
                options.seeds.from + static_cast<int>(index % seeds)};
  };
  Total total;
  int failed = 0;
  if (options.csv)
    print_csv("world,seed", [](const char* field) { return std::string(field); });
  else
    print_titles();
  // A child a trial: a crash takes only its own trial away.
  record::run_in_children(
      options.worlds.size() * seeds, static_cast<std::size_t>(options.jobs),
      [&](std::size_t index) {
        const std::string text =
            run_trial(options, config, phrases, cache ? &*cache : nullptr, task_of(index)).format();
        std::cout.flush();
        return text;
      },
      "the trial crashed",
      [&](std::size_t index, const record::Answer& answer) {
        const Task task = task_of(index);
        const auto row = answer.good ? record::Fields::parse(answer.text) : std::nullopt;
        if (row) {
          if (options.csv)
            print_csv(task.world + "," + std::to_string(task.seed),
                      [&](const char* field) { return row->get(field); });
          else
            print_row(task, *row);
          total.add(*row);
        } else {
          std::fprintf(options.csv ? stderr : stdout, "%-10s %4d  %s\n", task.world.c_str(),
                       task.seed, answer.text.c_str());
          ++failed;
        }
      });
  if (!options.csv) total.print();
  return failed == 0 ? 0 : 2;
}

}  // namespace
}  // namespace navvi_study::bench

int main(int argc, char** argv) {
  try {
    const navvi_study::bench::Options options =
        navvi_study::bench::read_options({argv + 1, argv + argc});
    if (options.help) {
      std::cout << navvi_study::bench::kUsage;
      return 0;
    }
    return navvi_study::bench::run(options);
  } catch (const std::exception& error) {
    std::cerr << "navvi: " << error.what() << '\n';
    return 2;
  }
}
