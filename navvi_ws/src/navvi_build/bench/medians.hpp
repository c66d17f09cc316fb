#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace navvi_bench {

/// Why a run has no result, or nothing: Google Benchmark 1.8 has another name for it than 1.7.
template <typename Run>
auto failure(const Run& run, int) -> decltype(std::string(run.skip_message)) {
  return run.skip_message;
}
template <typename Run>
std::string failure(const Run& run, long) {
  return run.error_occurred ? run.error_message : "";
}

/// Runs all benchmarks several times in mixed order, so that what else the machine does falls on
/// all of them alike, and keeps the median of every time and counter.
class Medians : public benchmark::ConsoleReporter {
 public:
  enum class Print { medians, nothing };

  /// \param argv  of main; its flags go before the ones set here
  Medians(int argc, char** argv, Print print) : ConsoleReporter(OO_Tabular), print_(print) {
    std::vector<std::string> words{argv[0], "--benchmark_repetitions=3", "--benchmark_min_time=0.2",
                                   "--benchmark_enable_random_interleaving=true"};
    words.insert(words.end(), argv + 1, argv + argc);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    int count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    benchmark::RunSpecifiedBenchmarks(this);
  }

  bool ReportContext(const Context& context) override {
    return print_ == Print::nothing || ConsoleReporter::ReportContext(context);
  }
  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> shown;
    for (const Run& run : runs) {
      if (const std::string why = failure(run, 0); !why.empty())
        std::fprintf(stderr, "%s: %s\n", run.benchmark_name().c_str(), why.c_str());
      if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "median") continue;
      auto& values = values_[run.run_name.function_name];
      values["ms"] = 1e3 * run.cpu_accumulated_time / static_cast<double>(run.iterations);
      values["real_ms"] = 1e3 * run.real_accumulated_time / static_cast<double>(run.iterations);
      for (const auto& [counter, value] : run.counters) values[counter] = value;
      shown.push_back(run);
    }
    if (print_ == Print::medians && !shown.empty()) ConsoleReporter::ReportRuns(shown);
  }

  /// A counter of a benchmark, or its processor time "ms" or wall time "real_ms"; 0 if it was
  /// filtered out.
  [[nodiscard]] double get(const std::string& benchmark, const std::string& value) const {
    const auto values = values_.find(benchmark);
    if (values == values_.end()) return 0.0;
    const auto found = values->second.find(value);
    return found == values->second.end() ? 0.0 : found->second;
  }

 private:
  Print print_;
  std::map<std::string, std::map<std::string, double>> values_;
};

}  // namespace navvi_bench
