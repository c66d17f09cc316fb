#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace navvi_sim {

/// Runs all benchmarks several times in mixed order, so that what else the machine does falls on
/// all of them alike; prints and keeps their medians. Times are of the processor.
class Medians : public benchmark::ConsoleReporter {
 public:
  /// \param argv  of main; its flags go before the ones set here
  Medians(int argc, char** argv) : ConsoleReporter(OO_Tabular) {
    std::vector<std::string> words{argv[0], "--benchmark_repetitions=3", "--benchmark_min_time=0.2",
                                   "--benchmark_enable_random_interleaving=true"};
    words.insert(words.end(), argv + 1, argv + argc);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    int count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    benchmark::RunSpecifiedBenchmarks(this);
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> shown;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "median") continue;
      times_[run.run_name.function_name] =
          run.cpu_accumulated_time / static_cast<double>(run.iterations);
      shown.push_back(run);
    }
    if (!shown.empty()) ConsoleReporter::ReportRuns(shown);
  }

  /// s; nothing if it was filtered out.
  [[nodiscard]] std::optional<double> time(const std::string& name) const {
    const auto found = times_.find(name);
    return found == times_.end() ? std::nullopt : std::make_optional(found->second);
  }

  /// One line of the table: how many times the time of `plain` is the time of `ours`. Nothing if
  /// either was filtered out.
  void ratio(const std::string& ours, const std::string& plain) const {
    const auto a = times_.find(ours);
    const auto b = times_.find(plain);
    if (a == times_.end() || b == times_.end()) return;
    std::printf("%7.3f x  %s / %s\n", a->second / b->second, ours.c_str(), plain.c_str());
  }

 private:
  std::map<std::string, double> times_;  ///< s, by name
};

}  // namespace navvi_sim
