// Hundreds of seeded trials with the simulated operator, faster than they could be lived:
// `./navvi bench trials --world=busy --seeds=1-20`.

#include <malloc.h>
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
#include <limits>
#include <navvi_config/reader.hpp>
#include <navvi_files/child_process.hpp>
#include <navvi_people/loop/closed_loop.hpp>
#include <navvi_types/angles.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch/loop_trial.hpp"
#include "batch/world_cache.hpp"

namespace navvi_study::bench {
namespace {

using batch::LoopTrial;
using navvi_config::ConfigError;
using navvi_people::loop::Spoken;
using record::Figure;

constexpr std::size_t kMostTrials = 100000;

struct Span {
  int from = 0;
  int to = 0;
};

/// Of "3" or "3-8".
Span span(const std::string& name, const std::string& text) {
  std::smatch numbers;
  Span out;
  if (std::regex_match(text, numbers, std::regex("([0-9]{1,9})(-([0-9]{1,9}))?"))) {
    out.from = std::stoi(numbers[1]);
    out.to = numbers[3].matched ? std::stoi(numbers[3]) : out.from;
    if (out.to >= out.from) return out;
  }
  throw ConfigError(name + " is \"" + text + "\"; allowed are whole numbers such as 3 or 3-8.");
}

/// What is run, a closed loop, and what its record is to say.
struct BenchConfig {
  std::string world = "training,easy", seeds = "1-3", profile = "default";
  std::string out, records = "failed", trace;
  int jobs = 1, cache = 512;
  bool csv = false, check = false;
  navvi_people::loop::ClosedLoopConfig loop;
  trial::TrialNodeConfig trial;

  BenchConfig() { trial.limit = 300.0; }

  void describe(navvi_config::Visitor& visit) {
    using namespace navvi_config;
    visit(world, "world", Any{}, "", "names or files, with commas between");
    visit(seeds, "seeds", Any{}, "", "of worlds, starts and goals, such as 7 or 1-10");
    visit(trial.limit, "limit", Range{1.0, 1e9}, "s", "of a trial");
    visit(profile, "profile", Any{}, "", "of the parameters");
    visit(jobs, "jobs", Range{1.0, 256.0}, "", "trials at a time");
    visit(cache, "cache", Range{0.0, 1e6}, "MB",
          "of ~/.cache/navvi/worlds, which keeps map, start, goal and mesh of each world and seed");
    visit(csv, "csv", Any{}, "", "a row with all figures, as CSV");
    visit(out, "out", Any{}, "", "folder of records; empty: none are kept");
    visit(records, "records", navvi_config::OneOf{{"all", "failed", "none"}}, "",
          "which are kept; failed: of trials that do not reach their goals");
    visit(trace, "trace", Any{}, "s",
          "print the journal, and the track once a second, such as 30-60; true: all");
    visit(check, "check", Any{}, "", "run nothing, but reject what a trial would reject");
    loop.describe(visit);
    visit.group("trial", trial);
  }
};

std::string share(const std::string& package) {
  const std::string path = ros::package::getPath(package);
  if (path.empty())
    throw ConfigError("the package " + package + " is not found; source devel/setup.bash first.");
  return path;
}

/// \param options  such as --jobs=2 and --csv, which are jobs:=2 and csv:=true, and parameters
BenchConfig configured(const std::vector<std::string>& options) {
  BenchConfig config;
  std::vector<std::string> words;
  for (const std::string& option : options) {
    std::string word = std::regex_replace(option, std::regex("^--([^=]*)$"), "$1:=true");
    word = std::regex_replace(word, std::regex("^--([^=]*)="), "$1:=");
    if (word.rfind("sensing:=", 0) == 0) word = "sim/" + word;
    if (word.find('/') < word.find(":="))
      config.trial.parameters += (config.trial.parameters.empty() ? "" : " ") + word;
    words.push_back(word);
  }
  const YAML::Node given = navvi_config::read_words(words);
  if (given["profile"]) config.profile = given["profile"].as<std::string>();
  const auto overlay = [&](auto& part, const std::string& package) {
    const std::string file = share(package) + "/config/" + config.profile + ".yaml";
    navvi_config::read(part, navvi_config::load_yaml(file), file);
  };
  overlay(config.loop.sim, "navvi_sim");
  overlay(config.loop.nav, "navvi_nav");
  overlay(config.loop.feedback, "navvi_feedback");
  config.trial.profile = config.profile;
  navvi_config::read(config, given, "the command line");
  trial::check(config.trial);
  if (config.records == "all" && config.out.empty())
    throw ConfigError("records=all needs out=DIR.");
  if (config.records == "none") config.out.clear();
  if (!config.trace.empty() && config.trace != "true") (void)span("trace", config.trace);
  if (!config.trace.empty() && (config.csv || config.jobs > 1))
    throw ConfigError("trace needs jobs=1 and goes without csv: it prints trial after trial.");
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

record::Trial play(const BenchConfig& config, const Spoken& spoken,
                   const navvi_files::Cache* cache, const std::filesystem::path& folder) {
  navvi_people::loop::ClosedLoop loop(config.loop, spoken, cache);
  LoopTrial trial(config.trial, loop, spoken.file);
  const auto utc = std::chrono::system_clock::now().time_since_epoch();
  if (!folder.empty())
    trial.keep(folder, std::chrono::duration_cast<std::chrono::nanoseconds>(utc).count());
  do {
    if (!loop.step()) throw std::runtime_error("a number in the world is not finite");
  } while (trial.watch());
  return trial.finish();
}

record::Fields run_trial(BenchConfig config, const Spoken& spoken,
                         const navvi_files::Cache* cache, const Task& task) {
  config.loop.sim.world = task.world;
  config.loop.sim.seed = task.seed;
  const bool all = config.records == "all";
  std::filesystem::path folder;
  if (!config.out.empty()) folder = std::filesystem::path(config.out) / name_of(task);
  record::Trial trial = play(config, spoken, cache, all ? folder : "");
  // The same trial once more: only one in many is kept, and it is the same bit for bit.
  const bool failed = trial.last("TRIAL_END")->fields.get("result") != "reached";
  if (failed && !folder.empty() && !all) trial = play(config, spoken, cache, folder);
  if (!config.trace.empty())
    print_trace(trial, config.trace == "true" ? Span{0, 1000000} : span("trace", config.trace));
  record::Fields row;
  for (const Figure& figure : record::figures())
    if (figure.kind == Figure::Kind::counted) row.set(figure.name, figure.of(trial));
  return row;
}

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

int run(const BenchConfig& config) {
  const Span span_of_seeds = span("seeds", config.seeds);
  const auto seeds = static_cast<std::size_t>(span_of_seeds.to - span_of_seeds.from) + 1;
  std::vector<std::string> worlds;
  std::istringstream names(config.world);
  for (std::string name; std::getline(names, name, ',');)
    if (!name.empty()) worlds.push_back(name);
  if (worlds.size() * seeds > kMostTrials)
    throw ConfigError("the worlds and seeds make " + std::to_string(worlds.size() * seeds) +
                     " trials; allowed are " + std::to_string(kMostTrials) + ".");
  if (config.check) {
    const navvi_nav::lockstep::Navigation reads_its_files(config.loop.nav);
    return 0;
  }
  const Spoken spoken(share("navvi_feedback") + "/config/phrases/en.yaml");
  const auto cache = batch::world_cache(static_cast<std::uintmax_t>(config.cache));
  const auto task_of = [&](std::size_t index) {
    return Task{worlds[index / seeds], span_of_seeds.from + static_cast<int>(index % seeds)};
  };
  int failed = 0;
  const auto title = [](const std::string& name) { return name; };
  if (config.csv)
    print_csv("world,seed", title);
  else
    print_row("world", "seed", title);
  // A child a trial: a crash takes only its own trial away.
  navvi_files::run_in_children(
      worlds.size() * seeds, static_cast<std::size_t>(config.jobs),
      [&](std::size_t index) {
        const std::string text =
            run_trial(config, spoken, cache ? &*cache : nullptr, task_of(index)).format();
        std::cout.flush();
        return text;
      },
      "the trial crashed",
      [&](std::size_t index, const navvi_files::Answer& answer) {
        const Task task = task_of(index);
        const auto row = answer.good ? record::Fields::parse(answer.text) : std::nullopt;
        const std::string seed = std::to_string(task.seed);
        const auto cell = [&](const std::string& name) { return row->get(name); };
        if (row && config.csv) {
          print_csv(task.world + "," + seed, cell);
        } else if (row) {
          print_row(task.world, seed, cell);
        } else {
          std::fprintf(config.csv ? stderr : stdout, "%-10s %4d  %s\n", task.world.c_str(),
                       task.seed, answer.text.c_str());
          ++failed;
        }
      });
  return failed == 0 ? 0 : 2;
}

}  // namespace
}  // namespace navvi_study::bench

int main(int argc, char** argv) {
  using navvi_study::bench::BenchConfig;
  try {
    const std::vector<std::string> options{argv + 1, argv + argc};
    // What a trial frees it soon needs again, and the kernel would clear it anew.
    mallopt(M_MMAP_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    if (options != std::vector<std::string>{"--help"})
      return navvi_study::bench::run(navvi_study::bench::configured(options));
    for (const navvi_config::Row& row : navvi_config::table<BenchConfig>())
      if (row.key.find('/') == std::string::npos)
        std::cout << "--" << row.key << '=' << row.default_value << "  " << row.help << '\n';
    std::cout << "Parameters are given with their part (sim, nav, feedback, person, perception, "
                 "trial), such as nav/replan/hold_time:=3; `./navvi parameters` lists them.\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "navvi: " << error.what() << '\n';
    return 2;
  }
}
