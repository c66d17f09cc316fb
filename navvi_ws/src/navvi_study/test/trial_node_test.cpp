// trial_node as a process, beside a scripted world. Needs a master: run by rostest.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <navvi_msgs/TrialEvent.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Clock.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <navvi_files/files.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <string>
#include <utility>
#include <vector>

#include "measured.hpp"
#include "record/figures.hpp"
#include "record/journal.hpp"
#include "temp_folder.hpp"

namespace navvi_study {
namespace {

namespace fs = std::filesystem;
using navvi_types::DriveState;
using navvi_types::ThingClass;
using navvi_types::to_msg;

/// Starts a program; ends it for sure.
class Process {
 public:
  explicit Process(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
  }
  ~Process() {
    if (running()) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  bool running() {
    if (!over_) over_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return !over_;
  }
  void signal(int number) { ::kill(pid_, number); }
  [[nodiscard]] int exit_code() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

 private:
  pid_t pid_ = -1;
  int status_ = 0;
  bool over_ = false;
};

/// A robot that drives 2 m/s along x to a goal 4 m ahead, once it has been told the goal.
class World {
 public:
  World() {
    clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    odom_ = node_.advertise<nav_msgs::Odometry>("odom", 100);
    guidance_ = node_.advertise<navvi_msgs::Guidance>("navvi/guidance", 100);
    proximity_ = node_.advertise<navvi_msgs::Proximity>("navvi/proximity", 100);
    contacts_ = node_.advertise<navvi_msgs::Contact>("navvi/contacts", 100);
    cues_ = node_.advertise<navvi_msgs::Cue>("navvi/cues", 100);
    devices_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
    drive_ = node_.advertise<navvi_msgs::DriveState>("navvi/drive_state", 1, true);
    state_ = node_.advertise<navvi_msgs::StateHash>("navvi/state_hash", 1, true);
    scenario_ = node_.advertise<navvi_msgs::Scenario>("navvi/scenario", 1, true);
    goal_ = node_.subscribe<geometry_msgs::PoseStamped>(
        "move_base_simple/goal", 1, [this](const geometry_msgs::PoseStamped::ConstPtr& msg) {
          goal_x_ = msg->pose.position.x;
          has_goal_ = true;
        });
    events_ = node_.subscribe<navvi_msgs::TrialEvent>(
        "navvi/events", 1000,
        [this](const navvi_msgs::TrialEvent::ConstPtr& msg) { events.push_back(*msg); });
    trial_ = node_.subscribe<navvi_msgs::TrialState>(
        "navvi/trial_state", 100, [this](const navvi_msgs::TrialState::ConstPtr& msg) {
          if (msg->state == navvi_msgs::TrialState::RUNNING) running.push_back(msg->header.stamp);
        });
    drive_.publish(to_msg(DriveState{DriveState::State::running, {}, 0, now()}));
    scenario_.publish(to_msg(navvi_types::Scenario{"hall, small", "c0ffee", 7, {4.0, 0.0}}));
  }

  /// 20 ms of it.
  void step() {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    ++tick_;
    rosgraph_msgs::Clock clock;
    clock.clock = navvi_types::from_ns(now());
    clock_.publish(clock);
    if (has_goal_ && x_ < goal_x_ && moving) x_ += 0.04;
    odom_.publish(to_msg(navvi_types::Odometry{now(), {{x_, 0.0}}}));
    if (x_ > 1.5 && !std::exchange(strayed_, true))
      odom_.publish(to_msg(navvi_types::Odometry{now() + 3600'000'000'000, {{x_, 0.0}}}));
    publish_guidance();
    diagnostic_msgs::DiagnosticArray devices;
    devices.header.stamp = clock.clock;
    devices.status.resize(1);
    devices.status[0].name = "navvi/audio";
    devices_.publish(devices);
    proximity_.publish(to_msg(navvi_types::Proximity{
        now(),
        {{ThingClass::shelf, 3, std::abs(x_ - 2.0), {}, false, "shelf; 3"},
         {ThingClass::worker, 4, 4.0, {0.0, 2.0}, false, "worker"}}}));
    if (tick_ % 50 == 0)
      state_.publish(to_msg(
          navvi_types::StateHash{now(), static_cast<std::uint64_t>(tick_), 0xc0ffee00}));
    if (x_ > 2.0 && !hit_) touch();
  }

  bool moving = true;
  std::vector<navvi_msgs::TrialEvent> events;
  std::vector<ros::Time> running;  ///< the stamp of each message that says so

 private:
  /// ns, ROS time
  [[nodiscard]] std::int64_t now() const { return 10'000'000'000 + 20'000'000 * tick_; }

  void publish_guidance() {
    using State = navvi_types::Guidance::State;
    navvi_types::Guidance guidance;
    guidance.stamp = now();
    guidance.seq = ++seq_;
    if (has_goal_) {
      guidance.state = goal_x_ - x_ < 1.0 ? State::arrived : State::following;
      guidance.goal.x() = goal_x_;
      guidance.goal_distance = std::max(0.0, goal_x_ - x_);
      guidance.plans = 1 + (x_ > 1.0 ? 1 : 0);
      guidance.replan_reason = navvi_types::Guidance::Replan::period;
    }
    guidance_.publish(to_msg(guidance));
  }

  void touch() {
    hit_ = true;
    navvi_types::Contact contact{ThingClass::shelf, {x_, 0.0}, 3, "shelf; 3", 0.0, {{x_, 0.0}}};
    contact.speed = 2.0;
    contact.counts = {{ThingClass::shelf, 1}, {ThingClass::wall, 1}};
    contact.seq = 2;  // the first one was lost
    contact.stamp = now();
    contacts_.publish(to_msg(contact));
    navvi_types::CueEvent cue{1, navvi_types::CueStage::started, navvi_types::CueKind::stuck,
                              "stuck, shelf ahead"};
    cue.stamp = now();
    cues_.publish(to_msg(cue));
    drive_.publish(
        to_msg(DriveState{DriveState::State::stopped, DriveState::Reason::command_lost, 0, now()}));
  }

  ros::NodeHandle node_;
  ros::Publisher clock_, odom_, guidance_, proximity_, contacts_, cues_, drive_, scenario_, state_,
      devices_;
  ros::Subscriber goal_, events_, trial_;
  std::int64_t tick_ = 0;
  std::uint32_t seq_ = 0;
  double x_ = 0.0;
  double goal_x_ = 0.0;
  bool has_goal_ = false;
  bool hit_ = false;
  bool strayed_ = false;  ///< one report was stamped far ahead
};

class TrialNodeProcess : public testing::Test {
 protected:
  void SetUp() override {
    ros::param::del("/trial_node");  // what the last test's command line set
  }

  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {TRIAL_NODE, "_out:=" + out_.string(), "_tail:=0.5",
                                      "_operator:=scripted"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// Steps the world until `done` or 40 s have passed.
  template <typename Done>
  bool run(World& world, Done done) {
    const ros::WallTime limit = ros::WallTime::now() + ros::WallDuration(40.0);
    while (!done()) {
      if (ros::WallTime::now() > limit) return false;
      world.step();
    }
    return true;
  }
  [[nodiscard]] fs::path only_folder() const {
    fs::path folder;
    for (const auto& entry : fs::directory_iterator(out_)) folder = entry.path();
    return folder;
  }
  [[nodiscard]] static std::map<std::string, std::string> summary_in(const fs::path& folder) {
    const auto summary =
        record::parse_summary(navvi_files::read_file(folder / "summary.csv").value_or(""));
    if (!summary) return {};
    return {summary->begin(), summary->end()};
  }
  static bool has(const World& world, const std::string& type) {
    return std::any_of(world.events.begin(), world.events.end(),
                       [&](const auto& event) { return event.type == type; });
  }
  /// Of a trial that has begun, and whose robot stands.
  void begin(World& world) {
    world.moving = false;
    ASSERT_TRUE(run(world, [&] { return has(world, "PROXIMITY_ENTER"); }));
  }

  const navvi_test::TempFolder folder_;
  const fs::path& out_ = folder_;
};

TEST_F(TrialNodeProcess, R2_a_reached_goal_leaves_journal_events_summary_and_bag_that_agree) {
  World world;
  Process node(command());
  ASSERT_TRUE(run(world, [&] { return !node.running(); })) << "it did not end by itself";
  EXPECT_EQ(node.exit_code(), 0);
  const fs::path folder = only_folder();

  const auto journal =
      record::read_journal(navvi_files::read_file(folder / "journal.csv").value_or(""));
  EXPECT_EQ(journal.damage, "");
  // What was published is what is on the disk; the row on the closed bag may come too late to hear.
  ASSERT_GE(world.events.size() + 1, journal.rows.size());
  for (std::size_t i = 0; i < world.events.size(); ++i) {
    EXPECT_EQ(world.events[i].seq, journal.rows[i].seq);
    EXPECT_EQ(world.events[i].type, journal.rows[i].type);
    EXPECT_EQ(world.events[i].fields, journal.rows[i].fields.format());
  }

  auto summary = summary_in(folder);
  for (const auto& [column, cell] : std::map<std::string, std::string>{
           {"result", "reached"}, {"world", "hall, small"}, {"seed", "7"}, {"operator", "scripted"},
           {"shelf_collision_count", "1"}, {"shelf_proximity_count", "1"},
           {"obstacle_collision_count", "1"},  // the lost contact with a wall is made good
           {"obstacle_proximity_count", "1"}, {"missed_messages", "1"}, {"stuck_count", "1"},
           {"safe_stop_count", "1"}, {"replan_count", "1"}, {"cues_spoken", "1"},
           {"state_hash", "00000000c0ffee00"}, {"bag", "ok"}})
    EXPECT_EQ(summary[column], cell) << column;
  EXPECT_NEAR(std::stod(summary["path_length_m"]), 3.0, 0.15);
  EXPECT_FALSE(fs::exists(folder / "trial.bag.active"));

  const auto recount = [&](const std::string& of) {
    return navvi_test::run(COUNT_TRIAL " " + of + " " + folder.string()).code;
  };
  EXPECT_EQ(recount("bag"), 0);
  EXPECT_EQ(recount("journal"), 0);
  fs::resize_file(folder / "trial.bag", fs::file_size(folder / "trial.bag") / 2);
  EXPECT_EQ(recount("bag"), 2) << "a damaged bag is told, not guessed from";
}

TEST_F(TrialNodeProcess, T1_a_bag_has_the_time_that_the_node_goes_by) {
  ros::param::set("/robot_time", true);
  ros::param::set("/use_sim_time", false);
  World world;
  Process node(command({"/use_sim_time:=/robot_time"}));
  EXPECT_TRUE(run(world, [&] { return !node.running(); }));
  ros::param::set("/use_sim_time", true);
  rosbag::Bag bag((only_folder() / "trial.bag").string());
  EXPECT_LT(rosbag::View(bag).getBeginTime(), ros::Time(1000.0)) << "of the scripted world";
}

TEST_F(TrialNodeProcess, the_state_is_repeated_with_the_time_at_which_the_trial_began) {
  World world;
  world.moving = false;
  Process node(command({"_record:=none"}));
  ASSERT_TRUE(run(world, [&] { return world.running.size() > 4; }));
  EXPECT_EQ(world.running.front(), world.running.back());
}

TEST_F(TrialNodeProcess, L5_a_signal_closes_the_trial_as_aborted_and_keeps_its_bag) {
  World world;
  Process node(command());
  begin(world);
  node.signal(SIGTERM);
  const auto signalled = navvi_test::Clock::now();
  ASSERT_TRUE(run(world, [&] { return !node.running(); }));
  navvi_test::expect_within(2000, signalled, "trial and bag closed");
  const fs::path folder = only_folder();
  auto summary = summary_in(folder);
  EXPECT_EQ(summary["result"], "aborted");
  EXPECT_EQ(summary["bag"], "ok");
  EXPECT_TRUE(fs::exists(folder / "trial.bag"));
  const auto journal =
      record::read_journal(navvi_files::read_file(folder / "journal.csv").value_or(""));
  EXPECT_TRUE(std::any_of(journal.rows.begin(), journal.rows.end(),
                          [](const auto& row) { return row.type == "TRIAL_END"; }));
}

TEST_F(TrialNodeProcess, M2_a_second_node_of_its_name_ends_the_trial_with_its_record_whole) {
  World world;
  Process node(command());
  begin(world);
  fs::create_directory(out_ / "twin");
  const Process twin({TRIAL_NODE, "_out:=" + (out_ / "twin").string()});
  ASSERT_TRUE(run(world, [&] { return !node.running(); }));
  EXPECT_EQ(node.exit_code(), 3);
  fs::remove_all(out_ / "twin");
  auto summary = summary_in(only_folder());
  EXPECT_EQ(summary["result"], "aborted");
  EXPECT_EQ(summary["reason"], "name_taken");
  EXPECT_EQ(summary["bag"], "ok");
  EXPECT_TRUE(fs::exists(only_folder() / "events.csv"));
}

TEST_F(TrialNodeProcess, P3_records_a_parameter_that_is_set_while_a_condition_is_locked) {
  World world;
  Process node(command({"_locked:=true", "_record:=none", "_limit:=10"}));
  begin(world);
  ros::param::set("/trial_node/limit", 1.0);
  ASSERT_TRUE(run(world, [&] { return has(world, "PARAMETER_SET"); }));
  EXPECT_FALSE(has(world, "TRIAL_END"));
}

TEST_F(TrialNodeProcess, what_it_records_is_its_owners_alone) {
  World world;
  Process node(command({"_out:=" + (out_ / "a/b").string()}));
  ASSERT_TRUE(run(world, [&] { return !node.running(); }));
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out_)) {
    const fs::perms all = fs::status(entry).permissions();
    EXPECT_EQ(all & ~fs::perms::owner_all, fs::perms::none) << entry.path();
    if (entry.is_regular_file()) ++files;
  }
  EXPECT_EQ(files, 5U) << "journal, track, events, summary and bag";
}

TEST_F(TrialNodeProcess, a_killed_trial_is_closed_by_the_next_start) {
  fs::path first;
  World world;
  {
    Process node(command({"_record:=none"}));
    begin(world);
    first = only_folder();
    node.signal(SIGKILL);
    ASSERT_TRUE(run(world, [&] { return !node.running(); }));
  }
  EXPECT_FALSE(fs::exists(first / "summary.csv"));
  world.events.clear();
  Process node(command({"_record:=none"}));
  ASSERT_TRUE(run(world, [&] { return has(world, "TRIAL_START"); }));
  EXPECT_EQ(summary_in(first)["result"], "aborted");
}

TEST_F(TrialNodeProcess, a_limit_ends_the_trial_in_ros_time) {
  World world;
  world.moving = false;
  Process node(command({"_record:=none", "_limit:=1.0"}));
  ASSERT_TRUE(run(world, [&] { return !node.running(); }));
  EXPECT_EQ(node.exit_code(), 0);
  EXPECT_EQ(summary_in(only_folder())["result"], "timeout");
  EXPECT_EQ(summary_in(only_folder())["elapsed_s"], "1.000");
}

TEST_F(TrialNodeProcess, L2_a_folder_that_cannot_be_made_refuses_the_trial) {
  World world;
  Process node({TRIAL_NODE, "_out:=/proc/trials"});
  ASSERT_TRUE(run(world, [&] { return !node.running(); }));
  EXPECT_EQ(node.exit_code(), 3);
}

}  // namespace
}  // namespace navvi_study

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "scripted_world");
  return RUN_ALL_TESTS();
}
