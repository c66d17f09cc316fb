#include "batch/world_cache.hpp"
#include "record/events.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <navvi_config/reader.hpp>
#include <navvi_people/loop/closed_loop.hpp>
#include <sstream>

#include "batch/loop_trial.hpp"
#include "temp_folder.hpp"
#include "trial/conditions.hpp"

namespace navvi_study::batch {
namespace {

namespace fs = std::filesystem;
using navvi_files::Cache;
using navvi_people::loop::ClosedLoop;
using navvi_people::loop::ClosedLoopConfig;

class WorldCache : public testing::Test {
 protected:
  WorldCache() {
    config_.sim.world = "easy";
    config_.sim.seed = 4;
  }

  /// All that is told in a trial of at most 40 s, and its row.
  [[nodiscard]] std::string play(const Cache* cache) const {
    ClosedLoop loop(config_, navvi_people::loop::Spoken(NAVVI_PHRASES), cache);
    trial::TrialNodeConfig config;
    config.limit = 40.0;
    LoopTrial trial(config, loop, NAVVI_PHRASES);
    std::ostringstream told;
    told.precision(17);
    while (loop.step() && trial.watch()) {
      const auto& place = loop.told().odometry.pose.pose.position;
      told << place.x << ' ' << place.y << '\n';
    }
    return told.str() + record::events_csv(trial.finish()) + record::summary_csv(record::summarize(trial.finish()));
  }

  navvi_test::TempFolder folder_;
  ClosedLoopConfig config_;
};

TEST_F(WorldCache, leaves_each_trial_as_it_is_fresh_kept_damaged_and_of_another_build) {
  const Cache cache({folder_, 16, "one"});
  const std::string fresh = play(nullptr);
  ASSERT_GT(fresh.size(), 10'000u);
  EXPECT_EQ(play(&cache), fresh);
  EXPECT_EQ(folder_.files().size(), 2u) << "map, start and goal; mesh";
  EXPECT_EQ(play(&cache), fresh);
  for (const fs::path& file : folder_.files()) {
    const auto middle = static_cast<std::streamoff>(fs::file_size(file) / 2);
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(middle);
    const auto byte = static_cast<char>(stream.get() ^ 0x10);
    stream.seekp(middle);
    stream.put(byte);
  }
  EXPECT_EQ(play(&cache), fresh);
  const Cache other({folder_, 16, "another"});
  EXPECT_EQ(play(&other), fresh);
  EXPECT_EQ(folder_.files().size(), 4u);
}

TEST_F(WorldCache, leaves_trials_as_they_are_that_two_processes_run_at_once) {
  const Cache cache({folder_, 16, "one"});
  const std::string fresh = play(nullptr);
  std::vector<pid_t> players;
  for (int i = 0; i < 2; ++i) {
    players.push_back(::fork());
    if (players.back() == 0) ::_exit(play(&cache) == fresh && play(&cache) == fresh ? 0 : 1);
  }
  for (const pid_t id : players) {
    int status = -1;
    ASSERT_EQ(::waitpid(id, &status, 0), id);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(folder_.files().size(), 2u) << "no file that was written aside is left";
}

TEST_F(WorldCache, is_shared_by_conditions_that_do_not_shape_the_world) {
  const Cache cache({folder_, 16, "one"});
  (void)play(&cache);
  navvi_config::read(
      config_,
      navvi_config::read_words({"nav/replan/period:=3", "speech:=false", "person/seed:=5"}),
      "test");
  const std::string fresh = play(nullptr);
  EXPECT_EQ(play(&cache), fresh);
  EXPECT_EQ(folder_.files().size(), 2u);
  navvi_config::read(config_, navvi_config::read_words({"nav/mesh/robot_radius:=0.36"}), "test");
  const std::string wider = play(nullptr);
  EXPECT_NE(wider, fresh);
  EXPECT_EQ(play(&cache), wider);
  EXPECT_EQ(folder_.files().size(), 3u);
}

TEST_F(WorldCache, lies_in_the_users_cache_folder) {
  ASSERT_EQ(::setenv("XDG_CACHE_HOME", folder_.string().c_str(), 1), 0);
  EXPECT_FALSE(world_cache(0));
  const auto cache = world_cache(16);
  ASSERT_TRUE(cache);
  cache->keep("key", "bytes");
  ASSERT_EQ(folder_.files().size(), 1u);
  EXPECT_EQ(folder_.files()[0].parent_path().parent_path(), folder_ / "navvi" / "worlds");
  ASSERT_EQ(::setenv("XDG_CACHE_HOME", "relative", 1), 0);
  const char* home = std::getenv("HOME");
  const std::string before = home == nullptr ? "" : home;
  ASSERT_EQ(::setenv("HOME", folder_.string().c_str(), 1), 0);
  const auto at_home = world_cache(16);
  ASSERT_TRUE(at_home);
  at_home->keep("key", "bytes");
  EXPECT_TRUE(fs::exists(folder_ / ".cache" / "navvi" / "worlds"));
  ASSERT_EQ(::unsetenv("HOME"), 0);
  EXPECT_FALSE(world_cache(16));
  ASSERT_EQ(::setenv("HOME", before.c_str(), 1), 0);
  ASSERT_EQ(::unsetenv("XDG_CACHE_HOME"), 0);
}

TEST(BuildIds, are_those_of_the_program_and_all_its_libraries) {
  const auto ids = trial::build_ids();
  ASSERT_TRUE(ids);
  EXPECT_GE(ids->size(), 10 * 20u) << "20 bytes each";
  EXPECT_EQ(trial::build_ids(), ids);
}

}  // namespace
}  // namespace navvi_study::batch
