// trial_node as a process, beside a scripted world. Needs a master: run by rostest.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Cue.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Proximity.h>
#include <navvi_msgs/Scenario.h>
#include <navvi_msgs/StateHash.h>
#include <navvi_msgs/TrialEvent.h>
#include <navvi_msgs/TrialState.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
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
#include <string>
#include <vector>

#include "record/journal.hpp"
#include "record/figures.hpp"
#include "record/row.hpp"

namespace navvi_study {
namespace {

namespace fs = std::filesystem;

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
    navvi_msgs::DriveState state;
    state.header.stamp = stamp();
    state.state = navvi_msgs::DriveState::RUNNING;
    drive_.publish(state);
    navvi_msgs::Scenario scenario;
    scenario.world = "hall, small";
    scenario.world_hash = "c0ffee";
    scenario.seed = 7;
    scenario.start.orientation.w = 1.0;
    scenario.goal.x = 4.0;
    scenario_.publish(scenario);
  }

  /// 20 ms of it.
  void step() {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    ++tick_;
    rosgraph_msgs::Clock now;
    now.clock = stamp();
    clock_.publish(now);
    if (has_goal_ && x_ < goal_x_ && moving) x_ += 0.04;
    nav_msgs::Odometry odom;
    odom.header.stamp = stamp();
    odom.pose.pose.position.x = x_;
    odom.pose.pose.orientation.w = 1.0;
    odom_.publish(odom);
    publish_guidance();
    diagnostic_msgs::DiagnosticArray devices;
    devices.header.stamp = stamp();
    devices.status.resize(1);
    devices.status[0].name = "navvi/audio";
    devices_.publish(devices);
    navvi_msgs::Proximity proximity;
    proximity.header.stamp = stamp();
    proximity.detection_radius = 5.0;
    proximity.things.resize(2);
    proximity.things[0].id = 3;
    proximity.things[0].name = "shelf; 3";
    proximity.things[0].thing_class = "shelf";
    proximity.things[0].gap = std::abs(x_ - 2.0);
    proximity.things[1].id = 4;
    proximity.things[1].name = "worker";
    proximity.things[1].thing_class = "worker";
    proximity.things[1].gap = 4.0;
    proximity.things[1].nearest.y = 2.0;
    proximity_.publish(proximity);
    navvi_msgs::StateHash state;
    state.header.stamp = stamp();
    state.step = static_cast<std::uint64_t>(tick_);
    state.hash = "00000000c0ffee00";
    if (tick_ % 50 == 0) state_.publish(state);
    if (x_ > 2.0 && !hit_) touch();
  }

  bool moving = true;
  std::vector<navvi_msgs::TrialEvent> events;
  std::vector<ros::Time> running;  ///< the stamp of each message that says so

 private:
  [[nodiscard]] ros::Time stamp() const { return ros::Time(10.0) + ros::Duration(0.02 * tick_); }

  void publish_guidance() {
    navvi_msgs::Guidance guidance;
    guidance.header.stamp = stamp();
    guidance.seq = ++seq_;
    if (has_goal_) {
      guidance.state =
          goal_x_ - x_ < 1.0 ? navvi_msgs::Guidance::ARRIVED : navvi_msgs::Guidance::FOLLOWING;
      guidance.goal.x = goal_x_;
      guidance.goal_distance = std::max(0.0, goal_x_ - x_);
      guidance.plans = 1 + (x_ > 1.0 ? 1 : 0);
      guidance.replan_reason = navvi_msgs::Guidance::PERIOD;
    }
    guidance_.publish(guidance);
  }

  void touch() {
    hit_ = true;
    navvi_msgs::Contact contact;
    contact.header.stamp = stamp();
    contact.seq = 2;  // the first one was lost
    contact.thing_class = "shelf";
    contact.name = "shelf; 3";
    contact.robot.position.x = x_;
    contact.robot.orientation.w = 1.0;
    contact.speed = 2.0;
    contact.counts.resize(2);
    contact.counts[0].thing_class = "shelf";
    contact.counts[0].count = 1;
    contact.counts[1].thing_class = "wall";
    contact.counts[1].count = 1;
    contacts_.publish(contact);
    navvi_msgs::Cue cue;
    cue.header.stamp = stamp();
    cue.id = 1;
    cue.stage = navvi_msgs::Cue::STARTED;
    cue.kind = "stuck";
    cue.text = "stuck, shelf ahead";
    cues_.publish(cue);
    navvi_msgs::DriveState state;
    state.header.stamp = stamp();
    state.state = navvi_msgs::DriveState::STOPPED;
    state.reason = navvi_msgs::DriveState::COMMAND_LOST;
    drive_.publish(state);
  }

  ros::NodeHandle node_;
  ros::Publisher clock_, odom_, guidance_, proximity_, contacts_, cues_, drive_, scenario_, state_,
      devices_;
  ros::Subscriber goal_, events_, trial_;
  int tick_ = 0;
  std::uint32_t seq_ = 0;
  double x_ = 0.0;
  double goal_x_ = 0.0;
  bool has_goal_ = false;
  bool hit_ = false;
};

class TrialNodeProcess : public testing::Test {
 protected:
  void SetUp() override {
    ros::param::del("/trial_node");  // what the last test's command line set
    std::string pattern = (fs::temp_directory_path() / "navvi_trial_XXXXXX").string();
    out_ = ::mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(out_); }

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
    for (const auto& event : world.events) {
      if (event.type == type) return true;
    }
    return false;
  }

  fs::path out_;
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
  EXPECT_EQ(summary["result"], "reached");
  EXPECT_EQ(summary["world"], "hall, small");
  EXPECT_EQ(summary["seed"], "7");
  EXPECT_EQ(summary["operator"], "scripted");
  EXPECT_EQ(summary["shelf_collision_count"], "1");
  EXPECT_EQ(summary["obstacle_collision_count"], "1")
      << "the lost contact with a wall is made good";
  EXPECT_EQ(summary["missed_messages"], "1");
  EXPECT_EQ(summary["shelf_proximity_count"], "1");
  EXPECT_EQ(summary["obstacle_proximity_count"], "1");
  EXPECT_EQ(summary["stuck_count"], "1");
  EXPECT_EQ(summary["safe_stop_count"], "1");
  EXPECT_EQ(summary["replan_count"], "1");
  EXPECT_EQ(summary["cues_spoken"], "1");
  EXPECT_EQ(summary["state_hash"], "00000000c0ffee00");
  EXPECT_EQ(summary["bag"], "ok");
  EXPECT_NEAR(std::stod(summary["path_length_m"]), 3.0, 0.15);
  EXPECT_FALSE(fs::exists(folder / "trial.bag.active"));

  EXPECT_EQ(std::system((std::string(COUNT_TRIAL) + " bag " + folder.string()).c_str()), 0);
  EXPECT_EQ(std::system((std::string(COUNT_TRIAL) + " journal " + folder.string()).c_str()), 0);

  fs::resize_file(folder / "trial.bag", fs::file_size(folder / "trial.bag") / 2);
  const int damaged = std::system((std::string(COUNT_TRIAL) + " bag " + folder.string()).c_str());
  EXPECT_EQ(WEXITSTATUS(damaged), 2) << "a damaged bag is told, not guessed from";
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
  world.moving = false;
  Process node(command());
  ASSERT_TRUE(run(world, [&] { return has(world, "PROXIMITY_ENTER"); }));
  node.signal(SIGTERM);
  ASSERT_TRUE(run(world, [&] { return !node.running(); }));
  const fs::path folder = only_folder();
  EXPECT_EQ(summary_in(folder)["result"], "aborted");
  EXPECT_TRUE(fs::exists(folder / "trial.bag"));
}

TEST_F(TrialNodeProcess, M2_a_second_node_of_its_name_ends_the_trial_with_its_record_whole) {
  World world;
  world.moving = false;
  Process node(command());
  ASSERT_TRUE(run(world, [&] { return has(world, "PROXIMITY_ENTER"); }));
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
  world.moving = false;
  Process node(command({"_locked:=true", "_record:=none", "_limit:=10"}));
  ASSERT_TRUE(run(world, [&] { return has(world, "PROXIMITY_ENTER"); }));
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
  world.moving = false;
  {
    Process node(command({"_record:=none"}));
    ASSERT_TRUE(run(world, [&] { return has(world, "PROXIMITY_ENTER"); }));
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
