// Hundreds of seeded trials with the simulated operator, faster than they could be lived:
// `./navvi bench trials --world=busy --seeds=1-20`.

#include <ros/package.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <navvi_config/reader.hpp>
#include <navvi_people/loop/closed_loop.hpp>
#include <navvi_types/angles.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch/loop_trial.hpp"
#include "batch/world_cache.hpp"
#include "record/child_process.hpp"

namespace navvi_study::bench {
namespace {

using batch::LoopTrial;
using navvi_people::loop::ClosedLoop;
using record::Figure;

constexpr const char* kUsage =
    "bench trials [--world=NAME|FILE[,...]] [--seeds=1-10] [--limit=300] [--profile=paper]\n"
    "             [--sensing=truth|lidar|robot] [--jobs=1] [--cache=512] [--csv]\n"
    "             [--out=DIR] [--records=all|failed|none] [--trace[=FROM-TO]] [--check]\n"
    "             [part/name:=value ...]\n"
    "One row a trial; with --csv all figures.\n"
    "--out: keep the records of trials that do not reach their goals, or of all, in DIR.\n"
    "--trace: print the journal, and the track once a second, between FROM and TO (s).\n"
    "--check runs nothing: exit code 2 and a sentence where a parameter would be rejected.\n"
    "--sensing gives guidance and feedback what a lidar, or a lidar and a depth camera, show.\n"
    "--cache: MB of ~/.cache/navvi/worlds, which keeps map, start, goal and mesh of each world "
    "and seed\n"
    "for other trials; 0: nothing is kept.\n"
    "A part is sim, nav, feedback, person, perception or trial, with the names of its node's "
    "parameters, such as\n"
    "nav/replan/hold_time:=3 or sim/goal:=3,4; `./navvi parameters` lists them.\n";

constexpr std::int64_t kMostTrials = 100000;
constexpr int kMostJobs = 256;
constexpr int kMostMegabytes = 1000000;

/// A closed loop, and what its record is to say.
struct LoopTrialConfig {
  navvi_people::loop::ClosedLoopConfig loop;
  trial::TrialNodeConfig trial;

  void describe(navvi_config::Visitor& visit) {
    loop.describe(visit);
    visit.group("trial", trial);
  }
};

/// Message for the user.
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
  std::string out;            ///< folder of records; empty: none are kept
  bool all_records = false;
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
  std::string records = "failed";
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
    } else if (option == "--out") {
      out.out = value;
    } else if (option == "--records") {
      records = value;
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
  if (records != "all" && records != "failed" && records != "none")
    throw UsageError("--records has \"" + records + "\"; allowed are all, failed and none.");
  out.all_records = records == "all";
  if (out.all_records && out.out.empty()) throw UsageError("--records=all needs --out=DIR.");
  if (records == "none") out.out.clear();
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

LoopTrialConfig configured(const Options& options) {
  LoopTrialConfig config;
  const auto overlay = [&](auto& part, const std::string& package) {
    const std::string file = share(package) + "/config/" + options.profile + ".yaml";
    navvi_config::read(part, navvi_config::load_yaml(file), file);
  };
  overlay(config.loop.sim, "navvi_sim");
  overlay(config.loop.nav, "navvi_nav");
  overlay(config.loop.feedback, "navvi_feedback");
  config.trial.profile = options.profile;
  config.trial.limit = options.limit;
  navvi_config::read(config, navvi_config::read_words(options.parameters), "the command line");
  trial::check(config.trial);
  for (const std::string& word : options.parameters)
    config.trial.parameters += (config.trial.parameters.empty() ? "" : " ") + word;
  return config;
}

struct Task {
  std::string world;
  int seed = 1;
};

/// Of a trial in the folder of records, such as trial-busy-7.
std::string name_of(const Task& task) {
  std::string name = "trial-" + std::filesystem::path(task.world).stem().string() + "-" +
                     std::to_string(task.seed);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return name;
}

/// Rows of the journal, and one of the track a second, between `span` s since the trial began.
void print_trace(const record::Trial& trial, const Span& span) {
  double next = 0.0;  // s
  auto at = trial.track.begin();
  const auto track_until = [&](double time) {
    for (; at != trial.track.end() && at->time - trial.begin() <= time; ++at) {
      const double since = at->time - trial.begin();
      if (since < next || since < span.from || since > span.to) continue;
      next = std::floor(since) + 1.0;
      std::printf("%7.2f  robot %.2f,%.2f heading %.0f, %.2f m/s | %s, steer %+.0f | stick %+.2f "
                  "forward %+.2f left | near %s %.2f m\n",
                  since, at->x, at->y, navvi_types::degrees(at->yaw), at->speed,
                  at->state.text().c_str(), navvi_types::degrees(at->steer), at->stick_forward,
                  at->stick_left, at->nearest.text().c_str(), at->gap);
    }
  };
  for (const record::Row& row : trial.rows) {
    const double since = record::time_of(row) - trial.begin();
    track_until(since);
    if (since >= span.from && since <= span.to)
      std::printf("%7.2f  %s %s\n", since, row.type.c_str(), row.fields.format().c_str());
  }
  std::fflush(stdout);
}

record::Trial play(const LoopTrialConfig& config, const std::string& phrases,
                   const navvi_files::Cache* cache, const std::filesystem::path& folder) {
  ClosedLoop loop(config.loop, phrases, cache);
  LoopTrial trial(config.trial, loop, phrases);
  const auto utc = std::chrono::system_clock::now().time_since_epoch();
  if (!folder.empty())
    trial.keep(folder, std::chrono::duration_cast<std::chrono::nanoseconds>(utc).count());
  do {
    if (!loop.step()) throw std::runtime_error("a number in the world is not finite");
  } while (trial.watch());
  return trial.finish();
}

/// The figures of a simulated trial, by name.
record::Fields run_trial(const Options& options, LoopTrialConfig config,
                         const std::string& phrases, const navvi_files::Cache* cache,
                         const Task& task) {
  config.loop.sim.world = task.world;
  config.loop.sim.seed = task.seed;
  std::filesystem::path folder;
  if (!options.out.empty()) folder = std::filesystem::path(options.out) / name_of(task);
  record::Trial trial = play(config, phrases, cache, options.all_records ? folder : "");
  // The same trial once more: only one in many is kept, and it is the same bit for bit.
  const bool failed = trial.last("TRIAL_END")->fields.get("result") != "reached";
  if (failed && !folder.empty() && !options.all_records) trial = play(config, phrases, cache, folder);
  if (options.trace) print_trace(trial, *options.trace);
  record::Fields row;
  for (const Figure& figure : record::figures())
    if (figure.kind == Figure::Kind::counted) row.set(figure.name, figure.of(trial, figure.name));
  return row;
}

/// What stands in a row on the screen.
constexpr const char* kShown[] = {"result",          "reason",   "elapsed_s", "path_length_m",
                                  "shortest_path_m", "contacts", "hits",      "reroute_count",
                                  "cues_per_min",    "misled",   "still_s",   "still_about"};

template <typename Cell>
void print_row(const std::string& world, const std::string& seed, const Cell& cell) {
  std::printf("%-10s %4s", world.c_str(), seed.c_str());
  for (const char* name : kShown)
    std::printf("  %*s", -std::max(8, static_cast<int>(std::strlen(name))), cell(name).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

/// Titles, or a row, as CSV: a cell a figure.
template <typename Cell>
void print_csv(const std::string& first, const Cell& cell) {
  std::cout << first;
  for (const Figure& figure : record::figures())
    if (figure.kind == Figure::Kind::counted)
      std::cout << ',' << std::quoted(cell(figure.name), '"', '"');
  std::cout << std::endl;
}

int run(const Options& options) {
  const LoopTrialConfig config = configured(options);
  if (options.check) return 0;
  const std::string phrases = share("navvi_feedback") + "/config/phrases/en.yaml";
  const auto cache = batch::world_cache(static_cast<std::uintmax_t>(options.cache));
  const auto seeds = static_cast<std::size_t>(options.seeds.to - options.seeds.from) + 1;
  const auto task_of = [&](std::size_t index) {
    return Task{options.worlds[index / seeds],
                options.seeds.from + static_cast<int>(index % seeds)};
  };
  int failed = 0;
  const auto title = [](const std::string& name) { return name; };
  if (options.csv)
    print_csv("world,seed", title);
  else
    print_row("world", "seed", title);
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
        const std::string seed = std::to_string(task.seed);
        const auto cell = [&](const std::string& name) { return row->get(name); };
        if (row && options.csv) {
          print_csv(task.world + "," + seed, cell);
        } else if (row) {
          print_row(task.world, seed, cell);
        } else {
          std::fprintf(options.csv ? stderr : stdout, "%-10s %4d  %s\n", task.world.c_str(),
                       task.seed, answer.text.c_str());
          ++failed;
        }
      });
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
