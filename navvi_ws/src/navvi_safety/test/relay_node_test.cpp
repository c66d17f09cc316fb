// The relay before a real robot's wheels, seen from outside. All the while, another node wants to
// drive at 0.4 m/s.

#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <rosgraph_msgs/Log.h>
#include <std_msgs/Bool.h>
#include <xmlrpcpp/XmlRpc.h>

#include <cmath>
#include <csignal>
#include <functional>
#include <limits>
#include <navvi_safety/command_input.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <string>
#include <vector>

#include "measured.hpp"

namespace {

class Relay : public testing::Test {
 protected:
  /// \param space  of the relay's names
  explicit Relay(const std::string& space = "") : node_(space) {
    connect();
    wheels_ = node_.subscribe<geometry_msgs::Twist>(
        "cmd_vel", 1, [this](const geometry_msgs::Twist::ConstPtr& msg) {
          speed_ = msg->linear.x;
          EXPECT_NE(speed_, 0.4) << "the wheels obey another node";
        });
    state_ = node_.subscribe<navvi_msgs::DriveState>(
        "navvi/drive_state", 10,
        [this](const navvi_msgs::DriveState::ConstPtr& msg) {
          drive_ = *msg;
          ++states_;
        });
    log_ = node_.subscribe<rosgraph_msgs::Log>(
        "/rosout", 100, [this](const rosgraph_msgs::Log::ConstPtr& msg) {
          if (msg->name == node_.resolveName("relay_node")) logged_ += msg->msg;
        });
  }

  /// By another connection than before.
  void connect() {
    commands_.shutdown();
    commands_ = node_.advertise<geometry_msgs::TwistStamped>("navvi/command", 1);
  }
  /// Sends `speed` at 50 Hz until `done`, for at most 10 s. A speed that is not finite goes out as
  /// it is.
  bool drive_until(double speed, const std::function<bool()>& done) {
    geometry_msgs::TwistStamped command;
    command.twist.linear.x = speed;
    return spin_until(
        [&] {
          command.header.stamp = ros::Time::now() - age_;
          commands_.publish(command);
        },
        done);
  }
  bool wait_until(const std::function<bool()>& done) {
    return spin_until([] {}, done);
  }
  /// \param share  of the stick that the relay lets pass
  void start(double stick = 0.7, double share = 1.0) {
    // What is sent before the relay has connected is lost, the neutral stick with it.
    ASSERT_TRUE(wait_until([&] { return commands_.getNumSubscribers() > 0; }));
    // Once more where a busy machine let a command lapse.
    const auto driven = [&] { return std::abs(speed_ - share * stick) < 1e-9; };
    for (int i = 0; i < 5 && !driven(); ++i) {
      const ros::WallTime begin = ros::WallTime::now();
      ASSERT_TRUE(drive_until(0.0, [&] { return (ros::WallTime::now() - begin).toSec() > 0.6; }));
      (void)drive_until(stick, driven);
    }
    ASSERT_TRUE(driven()) << speed_;
  }

  void expect_stopped_until_neutral() {
    EXPECT_TRUE(drive_until(0.5, [&] { return drive_.state == navvi_msgs::DriveState::STOPPED; }));
    const ros::WallTime stopped = ros::WallTime::now();
    EXPECT_TRUE(drive_until(0.5, [&] {
      EXPECT_NE(speed_, 0.5) << "the commands were never neutral";
      return (ros::WallTime::now() - stopped).toSec() > 1.0;
    }));
  }

  /// What the relay answers, as to a master. \param method  of its own interface
  XmlRpc::XmlRpcValue ask_relay(const char* method) {
    XmlRpc::XmlRpcValue ask, answer, uri;
    ask[0] = ros::this_node::getName();
    ask[1] = node_.resolveName("relay_node");
    EXPECT_TRUE(ros::master::execute("lookupNode", ask, answer, uri, true));
    std::string host;
    std::uint32_t port = 0;
    EXPECT_TRUE(ros::network::splitURI(uri, host, port));
    XmlRpc::XmlRpcClient relay(host.c_str(), static_cast<int>(port));
    EXPECT_TRUE(relay.execute(method, ask, answer));
    return answer[2];
  }

  double speed_ = std::numeric_limits<double>::quiet_NaN();
  navvi_msgs::DriveState drive_;
  int states_ = 0;  ///< that came
  std::string logged_;
  ros::Duration age_;  ///< of commands as they are sent

 private:
  bool spin_until(const std::function<void()>& send, const std::function<bool()>& done) {
    ros::WallRate rate(50);
    for (int i = 0; i < 500 && ros::ok(); ++i) {
      send();
      ros::spinOnce();
      if (done()) return true;
      rate.sleep();
    }
    return false;
  }

  ros::NodeHandle node_;
  ros::Publisher commands_;
  ros::Subscriber wheels_, state_, log_;
};

TEST_F(Relay, C8_stands_while_the_emergency_stop_is_pressed_and_until_the_stick_was_neutral) {
  ros::NodeHandle node;
  ros::Publisher emergency = node.advertise<std_msgs::Bool>("emergency_stop", 1);
  const auto press = [&emergency](bool pressed) {
    std_msgs::Bool msg;
    msg.data = pressed;
    emergency.publish(msg);
  };
  ASSERT_TRUE(wait_until([&] { return emergency.getNumSubscribers() > 0; }));
  press(true);
  EXPECT_TRUE(wait_until([&] { return drive_.reason == navvi_msgs::DriveState::EMERGENCY_STOP; }))
      << "before the first command, as no other test has sent one yet";
  EXPECT_EQ(drive_.state, navvi_msgs::DriveState::STOPPED);
  press(false);
  start();
  press(true);
  const auto pressed = navvi_test::Clock::now();
  EXPECT_TRUE(drive_until(0.7, [&] {
    return speed_ == 0.0 && drive_.reason == navvi_msgs::DriveState::EMERGENCY_STOP;
  }));
  navvi_test::expect_within(250, pressed, "stopped");
  // Neither a held nor a neutral stick moves the wheels, nor does one that is pushed after it.
  const auto stand = [&](double stick, double seconds) {
    const ros::WallTime begin = ros::WallTime::now();
    EXPECT_TRUE(drive_until(stick, [&] {
      EXPECT_EQ(speed_, 0.0);
      return (ros::WallTime::now() - begin).toSec() > seconds;
    }));
  };
  for (const double stick : {0.7, 0.0, 0.7}) stand(stick, 0.6);
  press(false);
  stand(0.7, 0.6);
  EXPECT_EQ(drive_.reason, navvi_msgs::DriveState::EMERGENCY_STOP) << "until it was neutral";
  start(0.6);
  for (const bool on : {true, false}) press(on);  // within one step
  EXPECT_TRUE(
      drive_until(0.6, [&] { return drive_.reason == navvi_msgs::DriveState::EMERGENCY_STOP; }));
}

TEST_F(Relay, C8_warns_where_nothing_publishes_the_emergency_stop) {
  const auto warned = [this] {
    return logged_.find("Nothing publishes the emergency stop, emergency_stop.") != logged_.npos;
  };
  EXPECT_TRUE(wait_until(warned) || wait_until(warned));
}

TEST_F(Relay, stops_the_wheels_when_only_bad_commands_come) {
  start();
  EXPECT_TRUE(drive_until(std::numeric_limits<double>::quiet_NaN(), [&] {
    return speed_ == 0.0 && drive_.reason == navvi_msgs::DriveState::COMMAND_INVALID &&
           logged_.find("commands rejected") != logged_.npos;
  }));
  EXPECT_GT(drive_.rejected, 0u);
  EXPECT_EQ(logged_.find(" 0 commands rejected"), logged_.npos);
}

TEST_F(Relay, names_the_other_node_that_wants_to_drive_and_goes_on_with_its_driver) {
  start();
  EXPECT_TRUE(drive_until(0.7, [&] { return drive_.intruder == "/intruder"; }));
  start(0.6);
}

TEST_F(Relay, M2_wants_a_driver_that_has_connected_anew_to_be_neutral_first) {
  start();
  logged_.clear();
  connect();
  expect_stopped_until_neutral();
  // Where connecting took longer than the timeout, the commands had been lost before.
  EXPECT_TRUE(drive_until(0.5, [&] {
    return drive_.reason == navvi_msgs::DriveState::DRIVER_CHANGED &&
           logged_.find("by another connection") != logged_.npos;
  }));
  start(0.6);
}

TEST_F(Relay, P3_obeys_no_parameter_that_is_set_while_it_runs) {
  start();
  const ros::NodeHandle relay("relay_node");
  for (const auto& [name, value] :
       {std::pair{"max_linear", 0.1}, {"timeout", 100.0}, {"neutral_hold", 0.0}})
    relay.setParam(name, value);
  relay.setParam("driver", "/intruder");
  const ros::WallTime set = ros::WallTime::now();
  EXPECT_TRUE(drive_until(0.7, [&] {
    EXPECT_EQ(speed_, 0.7);
    return (ros::WallTime::now() - set).toSec() > 1.0;
  }));
  EXPECT_TRUE(wait_until([&] { return speed_ == 0.0; })) << "within the timeout of its start";
  EXPECT_TRUE(wait_until([&] { return drive_.state == navvi_msgs::DriveState::STOPPED; }));
  EXPECT_EQ(drive_.reason, navvi_msgs::DriveState::COMMAND_LOST);
  start(0.6);
}

TEST_F(Relay, drops_commands_that_piled_up_while_it_was_halted) {
  start();
  const pid_t relay = static_cast<int>(ask_relay("getPid"));
  ASSERT_GT(relay, 0);
  ASSERT_EQ(kill(relay, SIGSTOP), 0);
  const ros::WallTime halted = ros::WallTime::now();
  EXPECT_TRUE(drive_until(0.5, [&] { return (ros::WallTime::now() - halted).toSec() > 1.0; }));
  ASSERT_EQ(kill(relay, SIGCONT), 0);
  expect_stopped_until_neutral();
}

TEST_F(Relay, publishes_its_time_and_twice_a_second_the_state_of_the_connection) {
  ros::NodeHandle node;
  int links = 0, slow = 0, clocks = 0;
  const ros::Subscriber link = node.subscribe<navvi_msgs::LinkState>(
      "navvi/link", 10, [&](const navvi_msgs::LinkState::ConstPtr& msg) {
        ++links;
        slow += msg->late == navvi_msgs::LinkState::SLOW;
      });
  const ros::Subscriber clock = node.subscribe<rosgraph_msgs::Clock>(
      "navvi/clock", 100, [&](const rosgraph_msgs::Clock::ConstPtr& msg) {
        clocks += std::abs((msg->clock - ros::Time::now()).toSec()) < 1.0;
      });
  ASSERT_TRUE(wait_until([&] { return links > 0 && states_ > 0; })) << "the state is latched";
  links = clocks = 0;
  const ros::WallTime begin = ros::WallTime::now();
  EXPECT_TRUE(wait_until([&] { return (ros::WallTime::now() - begin).toSec() > 3.0; }));
  EXPECT_GE(links, 4);
  EXPECT_LE(links, 7);
  EXPECT_GT(clocks, 30);
  EXPECT_LE(states_, 3) << "the state is published where it changes";
  start();
  age_.fromSec(0.5);
  const ros::WallTime late = ros::WallTime::now();
  EXPECT_TRUE(drive_until(0.7, [&] { return (ros::WallTime::now() - late).toSec() > 1.5; }));
  EXPECT_GE(slow, 1);
  EXPECT_LE(slow, 8) << "once where commands begin to come late";
}

/// A relay that assists, and is to have zones.
class Careful : public Relay {
 protected:
  Careful() : Relay("careful") {}
};

TEST_F(Careful, creeps_until_it_knows_what_is_near_and_is_slow_until_it_knows_the_zones) {
  ros::NodeHandle node("careful");
  ros::Publisher near = node.advertise<navvi_msgs::Proximity>("navvi/proximity", 1);
  ros::Publisher zones = node.advertise<navvi_msgs::Zone>("navvi/zone", 1);
  navvi_msgs::Proximity nothing;
  nothing.header.frame_id = "base_link";
  nothing.detection_radius = 2.0;
  navvi_types::ZoneState zone;
  const auto drives = [&](double at, bool sees, bool knows) {
    return drive_until(0.7, [&] {
      nothing.header.stamp = ros::Time::now();
      if (sees) near.publish(nothing);
      if (knows) zones.publish(navvi_types::to_msg(zone));
      return std::abs(speed_ - at) < 1e-9;
    });
  };
  start(0.7, 0.25);
  EXPECT_TRUE(drives(0.2, true, false));
  zone.forward = 0.5;
  EXPECT_TRUE(drives(0.5, true, true));
  EXPECT_TRUE(drives(0.25 * 0.7, false, true)) << "nothing of what is near came of late";
}

/// Relays that end while the robot drives.
class Ending : public Relay, public testing::WithParamInterface<std::pair<const char*, int>> {
 protected:
  Ending() : Relay(GetParam().first) {}
};

TEST_P(Ending, leaves_zero_to_the_wheels) {
  const pid_t relay = static_cast<int>(ask_relay("getPid"));
  start();
  if (const int signal = GetParam().second)
    kill(relay, signal);
  else
    ask_relay("shutdown");
  EXPECT_TRUE(drive_until(0.7, [&] { return speed_ == 0.0; }));
}

INSTANTIATE_TEST_SUITE_P(each, Ending,
                         testing::Values(std::pair{"interrupted", SIGINT},
                                         std::pair{"terminated", SIGTERM},
                                         std::pair{"hung_up", SIGHUP},
                                         std::pair{"replaced", 0}));

TEST(CommandTransport, is_a_datagram_from_another_machine_alone) {
  for (const char* const host : {"localhost", "127.0.0.1"})
    EXPECT_EQ(navvi_safety::command_transport(host).getTransports(), ros::V_string{"TCP"});
  EXPECT_EQ(navvi_safety::command_transport("192.168.1.5").getTransports(), (ros::V_string{"UDP", "TCP"}));
}

TEST(ClockLink, passes_on_time_that_a_robot_sets_back_but_not_what_was_overtaken) {
  ros::NodeHandle node;
  std::vector<double> heard;
  const ros::Subscriber here = node.subscribe<rosgraph_msgs::Clock>(
      "person/clock", 10, [&](const rosgraph_msgs::Clock::ConstPtr& msg) {
        heard.push_back(msg->clock.toSec());
      });
  ros::Publisher robot = node.advertise<rosgraph_msgs::Clock>("person/robot_clock", 10);
  ros::WallRate rate(20);
  for (int i = 0; i < 200 && (robot.getNumSubscribers() == 0 || here.getNumPublishers() == 0); ++i)
    rate.sleep();
  for (const double time : {10.0, 9.9, 10.0, 7.1, 6.9, 7.0}) {
    rosgraph_msgs::Clock msg;
    msg.clock = ros::Time(time);
    robot.publish(msg);
    rate.sleep();
    ros::spinOnce();
  }
  for (int i = 0; i < 100 && heard.size() < 4; ++i, rate.sleep()) ros::spinOnce();
  EXPECT_EQ(heard, (std::vector<double>{10.0, 10.0, 6.9, 7.0}));
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "relay_node_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
