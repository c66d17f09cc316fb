#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "batch/loop_trial.hpp"
#include "record/figures.hpp"
#include "temp_folder.hpp"

namespace navvi_study::batch {
namespace {

namespace fs = std::filesystem;

/// What this process holds.
struct Held {
  int kilobytes = 0, threads = 0, files = 0;

  Held() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
      std::sscanf(line.c_str(), "VmRSS: %d", &kilobytes);
      std::sscanf(line.c_str(), "Threads: %d", &threads);
    }
    files = static_cast<int>(std::distance(fs::directory_iterator("/proc/self/fd"), {}));
  }
};

#ifdef __SANITIZE_ADDRESS__
constexpr int kSeeds = 4, kRounds = 2, kGrowth = 1 << 20;  // kB; freed memory is kept for a while
#else
constexpr int kSeeds = 50, kRounds = 20, kGrowth = 5 << 10;  // kB
#endif

/// Its summary.
std::string drive(int seed) {
  const navvi_test::TempFolder folder;
  navvi_people::loop::ClosedLoopConfig config;
  config.sim.world = "easy";
  config.sim.seed = seed;
  navvi_people::loop::ClosedLoop loop(config, navvi_people::loop::Spoken(NAVVI_PHRASES), nullptr);
  trial::TrialNodeConfig trial_config;
  trial_config.limit = 40.0;
  LoopTrial trial(trial_config, loop, NAVVI_PHRASES);
  trial.keep(folder / "trial-1", 0);
  while (loop.step() && trial.watch()) {
  }
  const std::string row = record::summary_csv(record::summarize(trial.finish()));
  EXPECT_EQ(navvi_files::read_file(folder / "trial-1" / "summary.csv"), row);
  EXPECT_EQ(folder.files().size(), 5u) << "no file that was written aside is left";
  return row;
}

TEST(Soak, S6_a_thousand_trials_in_one_process_repeat_themselves_and_leave_nothing_behind) {
  std::map<int, std::string> first;
  Held before;
  for (int round = 0; round < kRounds; ++round) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const std::string row = drive(seed);
      ASSERT_EQ(first.emplace(seed, row).first->second, row) << "seed " << seed;
    }
    if (round == 0) before = Held();
  }
  const Held after;
  EXPECT_EQ(after.files, before.files);
  EXPECT_EQ(after.threads, before.threads);
  EXPECT_LT(after.kilobytes, before.kilobytes + kGrowth);
  RecordProperty("kilobytes_before", before.kilobytes);
  RecordProperty("kilobytes_after", after.kilobytes);
}

}  // namespace
}  // namespace navvi_study::batch
