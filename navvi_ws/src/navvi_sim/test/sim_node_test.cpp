// sim_node from outside: what it says, and that it stops.

#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Obstacles.h>
#include <navvi_msgs/Proximity.h>
#include <navvi_msgs/Scenario.h>
#include <octomap_msgs/Octomap.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <thread>
#include <vector>

#include "measured.hpp"

namespace {

constexpr double kPatience = 60.0;  // s, wall clock

/// The last message of a topic, and how many came.
template <typename Message>
class Listener {
 public:
  explicit Listener(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe(topic, 100, &Listener::receive, this,
                                                ros::TransportHints().tcpNoDelay())) {}
  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const Message& last() const { return *last_; }

 private:
  void receive(const boost::shared_ptr<Message const>& msg) {
    last_ = msg;
    ++count_;
  }
  boost::shared_ptr<Message const> last_;
  int count_ = 0;
  ros::Subscriber subscriber_;
};

/// Drives and listens. The wall clock bounds every wait.
class SimNode : public testing::Test {
 protected:
  /// One connection for all: a topic that is advertised again at once can end up with two, and the
  /// wheels stand for those.
  static void SetUpTestSuite() {
    commands_ = ros::NodeHandle().advertise<geometry_msgs::TwistStamped>("navvi/command", 1);
  }
  static void TearDownTestSuite() { commands_.shutdown(); }

  bool wait_until(const std::function<bool()>& done, double patience = kPatience) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience);
    while (ros::ok() && ros::WallTime::now() < end) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.005));
      if (done()) return true;
    }
    return false;
  }
  /// Sends at 50 Hz what `linear` gives until `done`.
  bool command_until(const std::function<double()>& linear, const std::function<bool()>& done) {
    ros::WallTime next = ros::WallTime::now();
    return wait_until([&] {
      if (ros::WallTime::now() >= next) {
        send(linear());
        next += ros::WallDuration(0.02);
      }
      return done();
    });
  }
  bool command_until(double linear, const std::function<bool()>& done) {
    return command_until([&] { return linear; }, done);
  }
  void send(double linear) {
    geometry_msgs::TwistStamped command;
    if (odom_.any()) command.header.stamp = odom_.last().header.stamp;
    command.twist.linear.x = linear;
    commands_.publish(command);
  }
  /// Drives until the robot is faster than `least`, and `more` holds: neutral first, and once more
  /// where a busy machine has let a command come too late.
  bool start_moving(
      double least = 0.15, const std::function<bool()>& more = [] { return true; }) {
    const auto runs = [&] { return drive_.any() && drive_.last().state == 1; };
    return command_until([&] { return runs() ? 0.4 : 0.0; },
                         [&] { return speed() > least && more(); });
  }
  [[nodiscard]] double speed() const {
    return odom_.any() ? odom_.last().twist.twist.linear.x : 0.0;
  }

  static inline ros::Publisher commands_;
  Listener<nav_msgs::Odometry> odom_{"odom"};
  Listener<navvi_msgs::DriveState> drive_{"navvi/drive_state"};
};

TEST_F(SimNode, says_everything_that_the_others_rely_on) {
  Listener<rosgraph_msgs::Clock> clock("/clock");
  Listener<octomap_msgs::Octomap> octomap("octomap_binary");
  Listener<visualization_msgs::MarkerArray> cells("occupied_cells_vis_array");
  Listener<visualization_msgs::MarkerArray> scene("navvi/scene");
  Listener<visualization_msgs::MarkerArray> moving("navvi/scene_moving");
  Listener<navvi_msgs::Obstacles> obstacles("navvi/obstacles");
  Listener<navvi_msgs::Proximity> proximity("navvi/proximity");
  Listener<navvi_msgs::Scenario> scenario("navvi/scenario");
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener transforms(buffer);
  ASSERT_TRUE(wait_until([&] {
    return clock.count() > 100 && octomap.any() && cells.any() && scene.any() && moving.any() &&
           obstacles.any() && proximity.any() && scenario.any() && odom_.any() && drive_.any() &&
           buffer.canTransform("map", "base_link", ros::Time(0));
  })) << "clock "
      << clock.count() << ", octomap " << octomap.count() << ", cells " << cells.count()
      << ", scene " << scene.count() << ", moving " << moving.count() << ", obstacles "
      << obstacles.count() << ", proximity " << proximity.count() << ", scenario "
      << scenario.count() << ", odom " << odom_.count() << ", drive_state " << drive_.count();

  EXPECT_STREQ(ros::message_traits::md5sum(octomap.last()), "9a45536b45c5e409cd49f04bb2d9999f");
  EXPECT_TRUE(octomap.last().binary);
  EXPECT_EQ(octomap.last().header.frame_id, "map");
  EXPECT_GT(octomap.last().data.size(), 1000u);
  EXPECT_FALSE(obstacles.last().obstacles.empty());
  EXPECT_EQ(proximity.last().header.frame_id, "base_link");
  EXPECT_EQ(scenario.last().seed, 3u);
  const auto pose = buffer.lookupTransform("map", "base_link", ros::Time(0));
  EXPECT_NEAR(pose.transform.translation.x, scenario.last().start.position.x, 0.01);
  EXPECT_NEAR(pose.transform.translation.y, scenario.last().start.position.y, 0.01);
}

TEST_F(SimNode, S4_does_not_outrun_the_wall_clock) {
  Listener<rosgraph_msgs::Clock> clock("/clock");
  ASSERT_TRUE(wait_until([&] { return clock.any(); }));
  const ros::WallTime wall = ros::WallTime::now();
  const ros::Time sim = clock.last().clock;
  ASSERT_TRUE(wait_until([&] { return clock.last().clock - sim > ros::Duration(1.0); }));
  EXPECT_GT((ros::WallTime::now() - wall).toSec(), 0.9);
}

TEST_F(SimNode, S4_takes_no_larger_steps_where_others_hold_the_processors) {
  std::vector<std::int64_t> stamps;  // ns
  const ros::Subscriber each = ros::NodeHandle().subscribe<nav_msgs::Odometry>(
      "odom", 1000, [&](const nav_msgs::Odometry::ConstPtr& msg) {
        stamps.push_back(static_cast<std::int64_t>(msg->header.stamp.toNSec()));
      });
  const auto steps = [&] {
    stamps.clear();
    EXPECT_TRUE(wait_until([&] { return stamps.size() > 200; }));
    std::vector<std::int64_t> found(stamps.size());
    std::adjacent_difference(stamps.begin(), stamps.end(), found.begin());
    found.erase(found.begin());
    return found;
  };
  const std::vector<std::int64_t> usual = steps();
  const std::int64_t step = *std::min_element(usual.begin(), usual.end());
  ASSERT_GT(step, 0);
  std::atomic<bool> over{false};
  std::vector<std::thread> others(2 * std::max(1U, std::thread::hardware_concurrency()));
  for (std::thread& other : others)
    other = std::thread([&over] {
      while (!over) continue;
    });
  const std::vector<std::int64_t> crowded = steps();
  over = true;
  for (std::thread& other : others) other.join();
  // Of several steps: messages between two that came were lost on their way here.
  for (const std::int64_t found : crowded) EXPECT_EQ(found % step, 0) << found << " ns";
  EXPECT_GT(std::count(crowded.begin(), crowded.end(), step), 100);
}

TEST_F(SimNode, moves_only_after_a_neutral_command) {
  ASSERT_TRUE(wait_until([&] { return odom_.any() && commands_.getNumSubscribers() > 0; }));
  const int before = odom_.count();
  ASSERT_TRUE(command_until(0.4, [&] { return odom_.count() > before + 60; }));
  EXPECT_EQ(speed(), 0.0);
  EXPECT_TRUE(start_moving());
}

TEST_F(SimNode, C3_counts_commands_that_are_no_numbers_and_does_not_move_for_them) {
  ASSERT_TRUE(wait_until([&] { return drive_.any() && commands_.getNumSubscribers() > 0; }));
  const unsigned before = drive_.last().rejected;
  ASSERT_TRUE(command_until(std::numeric_limits<double>::quiet_NaN(),
                            [&] { return drive_.last().rejected > before + 5; }));
  EXPECT_TRUE(std::isfinite(odom_.last().pose.pose.position.x));
  EXPECT_EQ(speed(), 0.0);
}

TEST_F(SimNode, T1_a_jump_of_the_clock_by_another_publisher_stops_the_wheels_within_250_ms) {
  for (const double jump : {-97.0, 1e6}) {
    ros::Publisher rogue = ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 1);
    ASSERT_TRUE(start_moving(0.15, [&] { return rogue.getNumSubscribers() > 1; }))
        << "the simulator does not listen to clocks";
    rosgraph_msgs::Clock clock;
    clock.clock.fromSec(std::max(0.0, odom_.last().header.stamp.toSec() + jump));
    rogue.publish(clock);
    const auto jumped = navvi_test::Clock::now();
    EXPECT_TRUE(command_until(0.4, [&] { return drive_.last().state == 2; }));
    navvi_test::expect_within(250, jumped, jump < 0.0 ? "stopped, back" : "stopped, ahead");
    EXPECT_EQ(drive_.last().reason, navvi_msgs::DriveState::CLOCK_JUMPED);
    EXPECT_TRUE(command_until(0.4, [&] { return speed() == 0.0; }));
    const int before = odom_.count();
    EXPECT_TRUE(command_until(0.4, [&] { return odom_.count() > before + 100; }));
    EXPECT_EQ(speed(), 0.0) << "the stick was never neutral";
  }
  EXPECT_TRUE(start_moving());
}

TEST_F(SimNode, P3_obeys_no_parameter_that_is_set_while_it_runs) {
  const ros::NodeHandle sim("sim_node");
  sim.setParam("gate/driver", "/nobody");
  sim.setParam("gate/timeout", 100.0);
  sim.setParam("gate/max_linear", 0.1);
  sim.setParam("robot/max_speed", 0.1);
  ros::param::set("/use_sim_time", false);
  ASSERT_TRUE(start_moving(0.35));
  ASSERT_TRUE(wait_until([&] { return drive_.last().state == 2; }));
  EXPECT_EQ(drive_.last().reason, 1) << "COMMAND_LOST, after the timeout of its start";
  EXPECT_TRUE(wait_until([&] { return speed() == 0.0; }));
  ros::param::set("/use_sim_time", true);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "sim_node_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
