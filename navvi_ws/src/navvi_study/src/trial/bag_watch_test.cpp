#include "trial/bag_watch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "temp_folder.hpp"

namespace navvi_study::trial {
namespace {

namespace fs = std::filesystem;

class Bag : public testing::Test {
 protected:
  /// A recorder that runs `script`; its third argument is the bag.
  [[nodiscard]] std::unique_ptr<BagRecorder> recorder(const std::string& script) const {
    const fs::path program = folder_.write("record", "#!/bin/sh\n" + script + "\n");
    fs::permissions(program, fs::perms::owner_all);
    return std::make_unique<BagRecorder>(folder_ / "trial.bag", "recorder",
                                         std::vector<std::string>{},
                                         std::vector<std::string>{program.string()});
  }
  /// The other process is waited for; no time is measured.
  static bool becomes(const std::function<bool()>& done) {
    for (int i = 0; i < 1000 && !done(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return done();
  }

  navvi_test::TempFolder folder_;
};

TEST_F(Bag, that_nobody_wants_is_soon_ready_and_never_lost) {
  BagWatch bag(nullptr, 10.0);
  EXPECT_FALSE(bag.ready(10.1));
  EXPECT_TRUE(bag.ready(10.6));
  EXPECT_TRUE(bag.growing(1000.0));
  EXPECT_TRUE(bag.close(0.0, 4.0));
  EXPECT_EQ(bag.verdict(), "none");
}

TEST_F(Bag, holds_the_trial_up_until_the_recorder_hears_or_a_minute_has_passed) {
  BagWatch heard(recorder("exec sleep 60"), 10.0);
  EXPECT_FALSE(heard.ready(15.0));
  heard.hears(15.0);
  EXPECT_FALSE(heard.ready(15.1)) << "links settle";
  EXPECT_TRUE(heard.ready(15.6));
  heard.kill();

  BagWatch deaf(recorder("exec sleep 60"), 10.0);
  EXPECT_FALSE(deaf.ready(69.9));
  EXPECT_TRUE(deaf.ready(70.1)) << "without a bag";
  EXPECT_FALSE(deaf.growing(70.2));
  deaf.kill();
  EXPECT_EQ(deaf.verdict(), "bad");
}

TEST_F(Bag, R1_is_lost_when_it_stops_to_grow) {
  BagWatch bag(recorder("echo some >\"$3.active\"; exec sleep 60"), 10.0);
  const fs::path file = folder_ / "trial.bag.active";
  ASSERT_TRUE(becomes([&] { return fs::exists(file) && fs::file_size(file) > 0; }));
  bag.expect_growth(20.0);
  EXPECT_TRUE(bag.growing(29.9));
  EXPECT_TRUE(bag.growing(31.0)) << "it grew just before";
  EXPECT_FALSE(bag.growing(40.0));
  bag.kill();
}

TEST_F(Bag, R1_of_a_recorder_that_is_halted_is_lost_within_three_seconds) {
  auto halted = recorder("kill -STOP $$");
  EXPECT_TRUE(becomes([&] { return halted->halted(); }));
  BagWatch bag(std::move(halted), 10.0);
  bag.hears(10.0);
  bag.expect_growth(20.0);
  EXPECT_TRUE(bag.growing(21.0));
  EXPECT_FALSE(bag.growing(22.9));
  bag.kill();
}

TEST_F(Bag, is_well_only_if_the_recorder_stopped_when_asked_and_left_something) {
  BagWatch bag(recorder("trap 'head -c 5000 /dev/zero >\"$3\"; exit 0' INT; touch \"$3.ready\"\n"
                        "while :; do sleep 0.01; done"),
               10.0);
  bag.hears(10.0);
  ASSERT_TRUE(becomes([&] { return fs::exists(folder_ / "trial.bag.ready"); }));
  EXPECT_FALSE(bag.close(3.9, 4.0)) << "the tail is not over";
  EXPECT_TRUE(becomes([&] { return bag.close(4.1, 4.0); }));
  EXPECT_EQ(bag.verdict(), "ok");
}

TEST_F(Bag, that_still_grows_is_waited_for_and_one_that_does_not_is_killed) {
  BagWatch bag(recorder("trap : INT; echo some >\"$3.active\"\n"
                        "while :; do sleep 0.01; done"),
               10.0);
  ASSERT_TRUE(becomes([&] { return fs::exists(folder_ / "trial.bag.active"); }));
  for (const double age : {3.9, 4.1, 11.0, 18.0, 25.0}) {
    EXPECT_FALSE(bag.close(age, 4.0));
    std::ofstream(folder_ / "trial.bag.active", std::ios::app) << "more";
  }
  EXPECT_FALSE(bag.close(26.0, 4.0));
  EXPECT_FALSE(bag.close(33.9, 4.0));
  EXPECT_TRUE(becomes([&] { return bag.close(34.1, 4.0); }));
  EXPECT_EQ(bag.verdict(), "bad");
}

TEST_F(Bag, R1_of_a_recorder_that_died_is_bad) {
  BagWatch bag(recorder("exit 1"), 10.0);
  bag.hears(10.0);
  EXPECT_TRUE(becomes([&] { return bag.ready(11.0); }));
  EXPECT_TRUE(becomes([&] { return !bag.growing(11.0); }));
  EXPECT_TRUE(bag.close(4.0, 4.0));
  EXPECT_EQ(bag.verdict(), "bad");
}

}  // namespace
}  // namespace navvi_study::trial
