#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Cue.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Proximity.h>
#include <navvi_msgs/TrialEvent.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/JoyFeedbackArray.h>
#include <std_msgs/Bool.h>
#include <std_msgs/String.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>

#include "measured.hpp"

namespace {

/// The world round the node: what a simulator, a planner and a stick would send, at 50 Hz.
class FeedbackNode : public testing::Test {
 protected:
  void SetUp() override {
    odom_msg_.pose.pose.orientation.w = 1.0;
    proximity_msg_.detection_radius = 5.0;
    proximity_msg_.header.frame_id = "base_link";
    path_msg_.header.frame_id = "map";
    commands_ = node_.subscribe<geometry_msgs::TwistStamped>(
        "navvi/command", 100, [this](const geometry_msgs::TwistStamped::ConstPtr& msg) {
          twist_ = msg->twist;
          ++twists_;
        });
    feedback_ = node_.subscribe<sensor_msgs::JoyFeedbackArray>(
        "joy/set_feedback", 100, [this](const sensor_msgs::JoyFeedbackArray::ConstPtr& msg) {
          left_ = msg->array.at(0).intensity;
          right_ = msg->array.at(1).intensity;
        });
    cues_ = node_.subscribe<navvi_msgs::Cue>("navvi/cues", 100,
                                             [this](const navvi_msgs::Cue::ConstPtr& msg) {
                                               if (msg->modality == navvi_msgs::Cue::SPEECH &&
                                                   msg->stage == navvi_msgs::Cue::QUEUED)
                                                 heard_.push_back(*msg);
                                             });
    markers_ = node_.subscribe<visualization_msgs::MarkerArray>(
        "navvi/markers", 10, [this](const visualization_msgs::MarkerArray::ConstPtr& msg) {
          shown_ = 0;
          for (const auto& marker : msg->markers)
            shown_ += marker.action == visualization_msgs::Marker::ADD ? 1 : 0;
        });
    diagnostics_ = node_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "diagnostics", 10, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& msg) {
          for (const auto& status : msg->status) {
            statuses_.insert(status.name);
            for (const auto& value : status.values) statuses_.insert(value.key);
          }
        });
    ASSERT_TRUE(until([this] { return joy_.getNumSubscribers() > 0 && twist_source(); }))
        << "feedback_node does not listen";
  }

  bool twist_source() const { return commands_.getNumPublishers() > 0; }

  /// Sends the present world until `condition` holds.
  bool until(const std::function<bool()>& condition, double seconds = 6.0) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
    ros::WallRate rate(50.0);
    while (ros::ok() && ros::WallTime::now() < end) {
      send();
      ros::spinOnce();
      if (condition()) return true;
      rate.sleep();
    }
    return false;
  }
  void pass(double seconds) {
    until([] { return false; }, seconds);
  }
  void send() {
    if (stick_) {
      sensor_msgs::Joy joy;
      joy.header.stamp = joy_stamp_;
      joy.axes = {0.0F, *stick_};
      joy.buttons = {0, 0};
      joy_.publish(joy);
    }
    if (sensing_) proximity_.publish(proximity_msg_);
    if (posed_) send_pose();
    odom_.publish(odom_msg_);
    if (guidance_on_) guidance_.publish(guidance_msg_);
  }
  void send_pose() {
    geometry_msgs::TransformStamped pose;
    pose.header.stamp = ros::Time::now();
    pose.header.frame_id = "map";
    pose.child_frame_id = "base_link";
    pose.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(pose);
  }
  void thing(const std::string& thing_class, double gap, double x, double y) {
    navvi_msgs::ProximityThing thing;
    thing.thing_class = thing_class;
    thing.gap = gap;
    thing.nearest.x = x;
    thing.nearest.y = y;
    proximity_msg_.things = {thing};
  }
  /// That is 5 m away.
  void lead_to_a_goal() {
    guidance_msg_.state = navvi_msgs::Guidance::FOLLOWING;
    guidance_msg_.waypoint_is_goal = true;
    guidance_msg_.waypoint_distance = guidance_msg_.goal_distance = 5.0;
    guidance_on_ = true;
  }
  bool heard(const std::string& kind) const {
    return std::any_of(heard_.begin(), heard_.end(), [&](const navvi_msgs::Cue& cue) {
      return cue.kind == kind && !cue.text.empty();
    });
  }

  ros::NodeHandle node_;
  ros::Publisher joy_ = node_.advertise<sensor_msgs::Joy>("joy", 1);
  ros::Publisher proximity_ = node_.advertise<navvi_msgs::Proximity>("navvi/proximity", 1);
  ros::Publisher odom_ = node_.advertise<nav_msgs::Odometry>("odom", 1);
  ros::Publisher guidance_ = node_.advertise<navvi_msgs::Guidance>("navvi/guidance", 1);
  ros::Publisher contacts_ = node_.advertise<navvi_msgs::Contact>("navvi/contacts", 10);
  ros::Publisher path_ = node_.advertise<nav_msgs::Path>("navvi/path", 1, true);
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Subscriber commands_, feedback_, cues_, markers_, diagnostics_;

  std::optional<float> stick_ = 0.0F;
  ros::Time joy_stamp_;
  bool sensing_ = true;
  bool guidance_on_ = false;
  bool posed_ = false;  ///< the robot's place is published
  navvi_msgs::Proximity proximity_msg_;
  nav_msgs::Odometry odom_msg_;
  navvi_msgs::Guidance guidance_msg_;
  nav_msgs::Path path_msg_;

  geometry_msgs::Twist twist_;
  int twists_ = 0;
  double left_ = -1.0;
  double right_ = -1.0;
  int shown_ = -1;
  std::vector<navvi_msgs::Cue> heard_;
  std::set<std::string> statuses_;
};

// The first, as a busy computer is told of once.
TEST_F(FeedbackNode, stands_with_a_stick_held_from_the_start_and_calls_no_idle_computer_busy) {
  constexpr double kLate = 0.1;  // s
  stick_ = 1.0F;
  ros::WallRate rate(100.0);
  double longest = 0.0;  // s, of this program
  ros::WallTime last = ros::WallTime::now();
  for (int i = 0; i < 300; ++i) {
    // What is sensed makes it beat, for longer than it may sleep.
    if (i % 20 < 14) send();
    ros::spinOnce();
    rate.sleep();
    longest = std::max(longest, (ros::WallTime::now() - last).toSec());
    last = ros::WallTime::now();
  }
  EXPECT_GT(twists_, 0);
  EXPECT_EQ(twist_.linear.x, 0.0);
  EXPECT_TRUE(heard("release_stick"));
  EXPECT_FALSE(heard("machine_slow") && longest < kLate);
}

TEST_F(FeedbackNode, drives_only_after_neutral_and_falls_silent_after_a_stop) {
  pass(0.5);
  stick_ = 1.0F;
  EXPECT_TRUE(until([this] { return twist_.linear.x > 0.5; }));

  stick_.reset();
  EXPECT_TRUE(until([this] { return twist_.linear.x == 0.0; }, 0.6));
  pass(0.2);
  const int count = twists_;
  pass(0.5);
  EXPECT_EQ(twists_, count) << "nothing is published while the stick is lost";
  EXPECT_TRUE(until([this] { return heard("pad_lost"); }));

  stick_ = 1.0F;
  pass(1.0);
  EXPECT_EQ(twist_.linear.x, 0.0) << "held forward when it came back";
}

TEST_F(FeedbackNode, C6_a_stick_that_comes_too_late_or_by_another_clock_moves_nothing) {
  for (const double age : {-3600.0, -1.5, 1.5, 3.0, 1e9}) {
    joy_stamp_ = ros::Time(std::max(1.0, (ros::Time::now() - ros::Duration(age)).toSec()));
    stick_ = 0.0F;
    pass(0.5);
    stick_ = 1.0F;
    pass(0.5);
    EXPECT_EQ(twist_.linear.x, 0.0) << age;
  }
  joy_stamp_ = ros::Time();
  stick_ = 0.0F;
  pass(0.5);
  stick_ = 1.0F;
  EXPECT_TRUE(until([this] { return twist_.linear.x > 0.5; })) << "without a stamp";
}

TEST_F(FeedbackNode, C8_says_that_the_emergency_stop_is_pressed_and_that_the_battery_is_low) {
  ros::Publisher stops = node_.advertise<std_msgs::Bool>("emergency_stop", 1);
  ros::Publisher batteries = node_.advertise<sensor_msgs::BatteryState>("battery", 1);
  ASSERT_TRUE(until([&] { return stops.getNumSubscribers() && batteries.getNumSubscribers(); }));
  sensor_msgs::BatteryState battery;
  for (const float unknown : {std::numeric_limits<float>::quiet_NaN(), -1.0F, 0.5F, 80.0F}) {
    battery.percentage = unknown;
    batteries.publish(battery);
    pass(0.2);
  }
  EXPECT_FALSE(heard("battery_low") || heard("emergency_stop"));
  std_msgs::Bool pressed;
  pressed.data = 1;
  stops.publish(pressed);
  EXPECT_TRUE(until([this] { return heard("emergency_stop"); }));
  battery.percentage = 0.14F;
  batteries.publish(battery);
  EXPECT_TRUE(until([this] { return heard("battery_low"); }));
  pressed.data = 0;
  stops.publish(pressed);
  pass(0.2);
}

TEST_F(FeedbackNode, P3_obeys_no_parameter_that_is_set_while_it_runs) {
  const ros::NodeHandle node("feedback_node");
  node.setParam("drive/max_forward", 1.5);
  node.setParam("drive/dead_zone", 0.0);
  node.setParam("input", "pad");
  pass(0.5);
  stick_ = 1.0F;
  EXPECT_TRUE(until([this] { return twist_.linear.x > 0.89; }));
  pass(1.0);
  EXPECT_LT(twist_.linear.x, 0.91);
}

TEST_F(FeedbackNode, M2_says_that_another_node_drives_under_its_name) {
  ros::Publisher gate = node_.advertise<navvi_msgs::DriveState>("navvi/drive_state", 1);
  ASSERT_TRUE(until([&] { return gate.getNumSubscribers() > 0; }));
  navvi_msgs::DriveState state;
  state.state = navvi_msgs::DriveState::STOPPED;
  state.reason = navvi_msgs::DriveState::DRIVER_CHANGED;
  state.intruder = "/feedback_node";
  gate.publish(state);
  EXPECT_TRUE(until([this] { return heard("two_drivers"); }));
  EXPECT_FALSE(heard("intruder")) << "it is not ignored";
  state.state = navvi_msgs::DriveState::RUNNING;
  gate.publish(state);
  pass(0.1);
}

TEST_F(FeedbackNode, makes_a_thing_on_the_left_felt_on_the_left_and_stops_when_sensing_dies) {
  ros::WallTime felt = ros::WallTime::now();
  const auto calm = [&] {
    if (left_ != 0.0) felt = ros::WallTime::now();
    return ros::WallTime::now() - felt > ros::WallDuration(1.0);
  };
  EXPECT_TRUE(until(calm)) << "what was felt before is over";
  thing("box", std::numeric_limits<double>::quiet_NaN(), 0.5, 1.4);
  pass(0.5);
  EXPECT_EQ(left_, 0.0) << "a gap that is no number";
  thing("box", 1.0, 0.5, 1.4);
  EXPECT_TRUE(until([this] { return left_ > 0.3 && right_ == 0.0; }));
  sensing_ = false;
  EXPECT_TRUE(until([this] { return left_ == 0.0 && right_ == 0.0; }, 2.0));
}

TEST_F(FeedbackNode, says_what_was_hit_but_nothing_of_a_contact_that_is_not_finite) {
  pass(0.5);
  navvi_msgs::Contact contact;
  contact.seq = 1;
  contact.thing_class = "shelf";
  contact.robot.orientation.w = 1.0;
  contact.point.x = std::numeric_limits<double>::quiet_NaN();
  contacts_.publish(contact);
  pass(0.5);
  EXPECT_FALSE(heard("collision_shelf"));
  contact.point.x = 0.35;
  contacts_.publish(contact);
  EXPECT_TRUE(until([this] { return heard("collision_shelf"); }));
}

TEST_F(FeedbackNode, N1_takes_direction_and_path_back_when_the_guide_is_lost) {
  path_msg_.poses.resize(2);
  path_msg_.poses[1].pose.position.y = -5.0;
  path_.publish(path_msg_);
  lead_to_a_goal();
  guidance_msg_.goal.y = guidance_msg_.waypoint.y = -5.0;
  guidance_msg_.waypoint_angle = guidance_msg_.steer_angle = 1.5708;
  const auto direction = [this] {
    for (const auto& cue : heard_) {
      if (cue.text.find("3 o'clock") != std::string::npos) return true;
    }
    return false;
  };
  EXPECT_TRUE(until(direction, 10.0));
  EXPECT_TRUE(until([this] { return shown_ >= 5; }));

  guidance_on_ = false;
  const auto lost = navvi_test::Clock::now();
  EXPECT_TRUE(until([this] { return shown_ == 0; }, 3.0));
  EXPECT_TRUE(until([this] { return heard("guidance_lost"); }));
  navvi_test::expect_within(1000, lost, "guidance lost");
}

TEST_F(FeedbackNode, says_where_the_robot_is_by_no_pose_that_is_stale) {
  ros::Publisher asks = node_.advertise<std_msgs::String>("navvi/ask", 10);
  std_msgs::String where;
  where.data = "where";
  lead_to_a_goal();
  guidance_msg_.goal.x = guidance_msg_.waypoint.x = 5.0;
  posed_ = true;
  for (int asked = 0; asked < 5 && !heard("where_goal"); ++asked) {
    until([&] { return asks.getNumSubscribers() > 0; });
    asks.publish(where);
    until([this] { return heard("where_goal"); }, 3.0);
  }
  ASSERT_TRUE(heard("where_goal"));

  posed_ = false;
  pass(1.5);
  heard_.clear();
  asks.publish(where);
  EXPECT_TRUE(until([this] { return !heard_.empty(); }, 10.0));
  pass(1.0);
  EXPECT_FALSE(heard("where_goal"));
}

TEST_F(FeedbackNode, reports_its_hardware_and_the_age_of_what_is_near_and_felt_once_a_second) {
  EXPECT_TRUE(until([this] {
    proximity_msg_.header.stamp = ros::Time::now();
    return statuses_.count("navvi/pad") && statuses_.count("navvi/audio") &&
           statuses_.count("navvi/speech") && statuses_.count("sensed_p99_ms") &&
           statuses_.count("motors_p99_ms");
  }));
}

TEST_F(FeedbackNode, says_that_the_time_is_up) {
  ros::Publisher events = node_.advertise<navvi_msgs::TrialEvent>("navvi/events", 10);
  ASSERT_TRUE(until([&] { return events.getNumSubscribers() > 0; }));
  navvi_msgs::TrialEvent end;
  end.type = "TRIAL_END";
  end.fields = "result=timeout;reason=limit";
  events.publish(end);
  EXPECT_TRUE(until([this] { return heard("trial_time_up"); }));
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "feedback_node_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
