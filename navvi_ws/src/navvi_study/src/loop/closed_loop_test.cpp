#include "loop/closed_loop.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <navvi_config/reader.hpp>
#include <sstream>

#include "loop/loop_figures.hpp"
#include "loop/loop_trace.hpp"

namespace navvi_study::loop {
namespace {

namespace fs = std::filesystem;

const std::string kRoom = R"(name: room
things:
  - {name: ground, class: floor, shapes: [{box: [12, 6, 0.1], pose: [0, 0, -0.05]}]}
)";
/// Right across the room.
const std::string kWall =
    "  - {name: wall, class: wall, pose: [0, 0, 1], shapes: [{box: [0.2, 6, 2]}]}\n";
/// The same with a door of 1.2 m, and a pallet robot that has stopped in it for good.
const std::string kDoor = R"(
  - {name: left, class: wall, pose: [0, 1.8, 1], shapes: [{box: [0.2, 2.4, 2]}]}
  - {name: right, class: wall, pose: [0, -1.8, 1], shapes: [{box: [0.2, 2.4, 2]}]}
  - name: mover
    class: pallet_robot
    pose: [0.2, 0, 0]
    shapes: [{box: [0.8, 0.6, 0.4], pose: [0, 0, 0.25]}]
    route: {waypoints: [[0.2, 0], [1.5, 0]], speed: 0.5, delay: 3600}
)";

/// An aisle of 1.8 m with a niche, and a pallet robot that comes along it.
const std::string kNiche = R"(name: niche
things:
  - {name: ground, class: floor, shapes: [{box: [20, 6, 0.1], pose: [0, 0, -0.05]}]}
  - {name: south, class: wall, pose: [0, -1.95, 1], shapes: [{box: [10, 2.1, 2]}]}
  - {name: west, class: wall, pose: [-3.5, 1.95, 1], shapes: [{box: [3, 2.1, 2]}]}
  - {name: east, class: wall, pose: [2.25, 1.95, 1], shapes: [{box: [5.5, 2.1, 2]}]}
  - name: mover
    class: pallet_robot
    pose: [6, 0, 0, 0, 0, 3.14159]
    shapes: [{box: [0.8, 0.6, 0.4], pose: [0, 0, 0.25]}]
    route: {waypoints: [[6, 0], [-8.5, 0]], speed: 0.5, pause: 200}
)";

class ClosedLoopIn : public testing::Test {
 protected:
  ClosedLoopIn() {
    std::string pattern = (fs::temp_directory_path() / "navvi_loop_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    config_.sim.start = "-4,0.5,0";
    config_.sim.goal = "4,-0.5";
  }
  ~ClosedLoopIn() override { fs::remove_all(folder_); }

  /// The row of a trial of at most `limit` s.
  record::Fields play(const std::string& world, double limit) {
    config_.sim.world = (folder_ / "world.yaml").string();
    std::ofstream(config_.sim.world) << world;
    ClosedLoop loop(config_, phrases_);
    LoopFigures figures(limit);
    trace_.str("");
    LoopTrace trace(trace_, 0.0, limit);
    bool goes_on = true;
    while (goes_on && loop.step()) {
      goes_on = figures.watch(loop);
      trace.watch(loop);
    }
    return figures.row(loop);
  }

  fs::path folder_;
  ClosedLoopConfig config_;
  std::string phrases_ = NAVVI_PHRASES;
  std::ostringstream trace_;
};

TEST_F(ClosedLoopIn, anEmptyRoomReachesItsGoalWithoutDetourOrContact) {
  const record::Fields row = play(kRoom, 60.0);
  EXPECT_EQ(row.get("result"), "reached");
  EXPECT_EQ(row.get("hits"), "-");
  EXPECT_EQ(row.get("reroutes"), "0");
  EXPECT_EQ(row.get("flips"), "0");
  EXPECT_NEAR(row.number("shortest").value(), 8.06, 0.1);
  EXPECT_LT(row.number("driven").value(), 1.2 * 8.06);
  EXPECT_GT(row.number("driven").value(), 8.06 - 1.2);
  EXPECT_NE(trace_.str().find("says \"Ready. Goal 8 meters"), std::string::npos);
}

TEST_F(ClosedLoopIn, everyLanguageAndWordingLeadsToTheGoalByWordsAlone) {
  config_.feedback.sounds.enabled = false;
  config_.sim.goal = "3,-2";
  navvi_feedback::cues::WordingConfig& wording = config_.feedback.cues.wording;
  for (const char* language : {"en.yaml", "es.yaml"})
    for (const char* directions : {"clock", "left_right", "degrees"})
      for (const char* verbosity : {"brief", "normal", "full"}) {
        phrases_ = std::filesystem::path(NAVVI_PHRASES).replace_filename(language);
        wording.directions = directions;
        wording.verbosity = verbosity;
        wording.units = verbosity == std::string("full") ? "feet" : "meters";
        EXPECT_EQ(play(kRoom, 90.0).get("result"), "reached")
            << language << " " << directions << " " << verbosity << "\n" << trace_.str();
      }
}

TEST_F(ClosedLoopIn, theSameSeedGivesTheSameTrialAndAnotherSeedAnotherOne) {
  const record::Fields first = play(kRoom, 60.0);
  const std::string trace = trace_.str();
  EXPECT_EQ(play(kRoom, 60.0), first);
  EXPECT_EQ(trace_.str(), trace);
  config_.sim.seed = 2;
  EXPECT_NE(play(kRoom, 60.0).get("hash"), first.get("hash"));
}

TEST_F(ClosedLoopIn, aRoomCutInTwoHasItsGoalRefused) {
  const record::Fields row = play(kRoom + kWall, 60.0);
  EXPECT_EQ(row.get("result"), "refused: unreachable");
  EXPECT_LT(row.number("time").value(), 2.0);
}

TEST_F(ClosedLoopIn, aDoorThatSomethingStandsInIsToldAndNotDrivenInto) {
  const record::Fields row = play(kRoom + kDoor, 40.0);
  EXPECT_EQ(row.get("result"), "timeout");
  EXPECT_EQ(row.get("hits"), "-");
  EXPECT_GT(row.number("no_route").value() + row.number("blocked").value(), 30.0);
  EXPECT_GT(row.number("still").value(), 30.0);
}

TEST_F(ClosedLoopIn, anAisleWithRoomForOneMakesRoomForWhatComesAndGoesOnOnceItHasPassed) {
  config_.sim.start = "1,0,0";
  config_.sim.goal = "7,1";
  config_.sim.life.movers.patience = 1000.0;  // it does not back out
  const record::Fields row = play(kNiche, 150.0);
  EXPECT_EQ(row.get("result"), "reached");
  EXPECT_EQ(row.get("hits"), "-");
  EXPECT_EQ(row.get("reroutes"), "0");
  EXPECT_GT(row.number("make_room").value(), 10.0);
  EXPECT_NE(trace_.str().find("says \"make room for the pallet robot, 6 o'clock"),
            std::string::npos);
}

TEST(ClosedLoopConfig, namesEachPartAndRefusesAnUnknownOne) {
  ClosedLoopConfig config;
  navvi_config::read(config, navvi_config::read_words({"nav/replan/period:=3", "sim/seed:=4"}),
                     "test");
  const auto nav = navvi_config::table_of([&](auto& visit) { config.nav.describe(visit); });
  EXPECT_TRUE(std::any_of(nav.begin(), nav.end(), [](const navvi_config::Row& row) {
    return row.key == "replan/period" && std::stod(row.default_value) == 3.0;
  }));
  EXPECT_EQ(config.sim.seed, 4);
  EXPECT_THROW(navvi_config::read(config, navvi_config::read_words({"eyes/open:=1"}), "test"),
               navvi_config::ConfigError);
}

}  // namespace
}  // namespace navvi_study::loop

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
