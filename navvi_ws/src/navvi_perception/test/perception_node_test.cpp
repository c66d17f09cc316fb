// perception_node from outside: a robot with a lidar, a camera and a bumper is played to it.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Obstacles.h>
#include <navvi_msgs/Proximity.h>
#include <octomap_msgs/Octomap.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/Bool.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "measured.hpp"

namespace navvi_perception {
namespace {

constexpr double kPatience = 60.0;  // s
constexpr double kRoom = 3.0;       // m, from the robot to each of four walls
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
bool has_camera = false;   // which must go on once the node has heard it, in later tests too
double clock_ahead = 0.0;  // s, of the wall clock

/// A robot at (10, 0) in a square room; its lidar sits 0.2 m ahead of its middle.
class PerceptionNodeTest : public testing::Test {
 protected:
  PerceptionNodeTest() {
    clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    scans_ = node_.advertise<sensor_msgs::LaserScan>("scan", 5);
    rear_scans_ = node_.advertise<sensor_msgs::LaserScan>("rear/scan", 5);
    clouds_ = node_.advertise<sensor_msgs::PointCloud2>("points", 5);
    bumper_ = node_.advertise<std_msgs::Bool>("bumper", 5);
    subscribers_ = {take<octomap_msgs::Octomap>("octomap_binary", map_),
                    take<navvi_msgs::Obstacles>("navvi/obstacles", obstacles_),
                    take<navvi_msgs::Proximity>("navvi/proximity", near_)};
    contacts_ = take<navvi_msgs::Contact>("navvi/contacts", contact_);
    subscribers_.push_back(node_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "diagnostics", 10, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& msg) {
          sensing_ = msg->status.front().message;
        }));
    timer_ = node_.createWallTimer(ros::WallDuration(0.1),
                                   [this](const ros::WallTimerEvent&) { play(); });
    clock_timer_ = node_.createWallTimer(
        ros::WallDuration(0.01), [this](const ros::WallTimerEvent&) {
          rosgraph_msgs::Clock now;
          now.clock.fromSec(ros::WallTime::now().toSec() + clock_ahead);
          clock_.publish(now);
        });
  }

  template <typename Message>
  ros::Subscriber take(const std::string& topic, std::optional<Message>& into) {
    return node_.subscribe<Message>(
        topic, 10, [&into](const typename Message::ConstPtr& msg) { into = *msg; });
  }

  /// \param later  s, by which its stamp is ahead
  void frame(const char* parent, const char* child, double x, double z, double later = 0.0) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time::now() + ros::Duration(later);
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    transform.transform.translation.x = x;
    transform.transform.translation.z = z;
    transform.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(transform);
  }

  /// Of the room, with a disc of 0.2 m in it if there is one.
  [[nodiscard]] sensor_msgs::LaserScan scan() const {
    sensor_msgs::LaserScan msg;
    msg.header.stamp = ros::Time::now();
    msg.header.frame_id = "laser";
    msg.angle_increment = static_cast<float>(M_PI / 180.0);
    msg.range_min = 0.05F;
    msg.range_max = 10.0F;
    for (int i = 0; i < 360; ++i) {
      const double x = std::cos(i * M_PI / 180.0), y = std::sin(i * M_PI / 180.0);
      double range =
          std::min(std::abs(x) > 1e-6 ? (x > 0 ? kRoom - 0.2 : kRoom + 0.2) / std::abs(x) : 1e9,
                   std::abs(y) > 1e-6 ? kRoom / std::abs(y) : 1e9);
      if (disc_y_) {
        const double along = 1.3 * x + *disc_y_ * y;
        const double half2 = 0.04 - (1.69 + *disc_y_ * *disc_y_ - along * along);
        if (along > 0 && half2 > 0) range = along - std::sqrt(half2);
      }
      msg.ranges.push_back(static_cast<float>(range));
    }
    return msg;
  }

  /// What faces the robot, 0.3 m wide and 0.1 m high, m in base_link.
  [[nodiscard]] static sensor_msgs::PointCloud2 cloud(float ahead, float foot) {
    sensor_msgs::PointCloud2 cloud;
    cloud.header.stamp = ros::Time::now();
    cloud.header.frame_id = "base_link";
    sensor_msgs::PointCloud2Modifier modifier(cloud);
    modifier.setPointCloud2FieldsByString(1, "xyz");
    modifier.resize(100);
    sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
    for (int i = 0; i < 100; ++i, ++x) {
      x[0] = ahead;
      x[1] = static_cast<float>(i % 10) * 0.03F;
      x[2] = foot + static_cast<float>(i / 10) * 0.01F;
    }
    return cloud;
  }

  /// Of the room behind, from the robot's middle.
  [[nodiscard]] static sensor_msgs::LaserScan rear_scan(sensor_msgs::LaserScan msg) {
    msg.header.frame_id = "rear";
    msg.header.stamp -= ros::Duration(0.05);
    for (std::size_t ray = 0; ray < 360; ++ray) {
      const double angle = static_cast<double>(ray) * M_PI / 180.0;
      const double range = kRoom / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
      msg.ranges[ray] = ray < 85 || ray >= 270 ? kNone : static_cast<float>(range);
    }
    return msg;
  }

  void play() {
    if (!lost_) frame("map", "base_link", 10.0, 0.0);
    frame("base_link", "laser", 0.2, 0.15);
    frame("base_link", "rear", 0.0, 0.15);
    if (disc_y_) *disc_y_ += 0.08;
    sensor_msgs::LaserScan msg = scan();
    if (spoil_) spoil_(msg);
    scans_.publish(msg);
    if (has_camera) clouds_.publish(cloud(kRoom, 0.1F));
    if (!has_rear_) return;
    sensor_msgs::LaserScan rear = rear_scan(scan());
    if (spoil_rear_) spoil_rear_(rear);
    rear_scans_.publish(rear);
  }

  /// The node senses, and hears the bumper, and its contacts are heard.
  bool ready() {
    return until([this] {
      return near_ && bumper_.getNumSubscribers() > 0 && contacts_.getNumPublishers() > 0;
    });
  }

  /// Lets go of the bumper and presses it. \return its contact
  std::optional<navvi_msgs::Contact> bump() {
    contact_.reset();
    std_msgs::Bool pressed;
    bumper_.publish(pressed);
    pressed.data = 1;
    until([&, this] {
      bumper_.publish(pressed);
      return contact_.has_value();
    });
    return contact_;
  }

  /// Sets the clock back, s, and waits until the node has seen something since.
  void set_back(double by) {
    const ros::Time before = ros::Time::now();
    clock_ahead -= by;
    ASSERT_TRUE(until([&] {
      return obstacles_ && (before - obstacles_->header.stamp).toSec() > 0.5 * by;
    }));
  }

  bool until(const std::function<bool()>& done) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
    while (!done() && ros::WallTime::now() < end && ros::ok())
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    return done();
  }

  ros::NodeHandle node_;
  ros::Publisher clock_, scans_, rear_scans_, clouds_, bumper_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber contacts_;
  ros::WallTimer timer_, clock_timer_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::optional<double> disc_y_;  ///< m, in laser
  std::function<void(sensor_msgs::LaserScan&)> spoil_, spoil_rear_;
  bool has_rear_ = false;
  bool lost_ = false;  ///< nothing tells where the robot is
  std::optional<octomap_msgs::Octomap> map_;
  std::optional<navvi_msgs::Obstacles> obstacles_;
  std::optional<navvi_msgs::Proximity> near_;
  std::optional<navvi_msgs::Contact> contact_;
  std::string sensing_;  ///< as in /diagnostics
};

/// With a second lidar, which the node's parameter names.
class TwoLidarsTest : public PerceptionNodeTest {
 protected:
  TwoLidarsTest() { has_rear_ = true; }
};

TEST_F(PerceptionNodeTest, T4_a_transform_from_the_future_keeps_out_none_that_follow) {
  ASSERT_TRUE(until([this] { return near_.has_value(); }));
  frame("map", "base_link", 14.0, 0.0, 1e6);
  // What was seen before it may still be under way.
  const ros::WallTime sent = ros::WallTime::now();
  until([&] { return (ros::WallTime::now() - sent).toSec() > 1.0; });
  obstacles_.reset();
  disc_y_ = -2.0;
  ASSERT_TRUE(until([this] { return obstacles_ && !obstacles_->obstacles.empty(); }));
  EXPECT_NEAR(obstacles_->obstacles[0].pose.position.x, 11.5, 0.3) << "from where the robot is";
}

TEST_F(PerceptionNodeTest, T1_what_is_near_and_what_moves_is_known_within_1_s_of_a_jump_back) {
  ASSERT_TRUE(until([this] { return near_ && obstacles_; }));
  const auto set = navvi_test::Clock::now();
  set_back(97.0);
  near_.reset();
  EXPECT_TRUE(until([this] { return near_.has_value(); }));
  navvi_test::expect_within(1000, set, "sensed again");
}

TEST_F(PerceptionNodeTest, T1_contacts_are_counted_on_where_time_jumps_back) {
  ASSERT_TRUE(ready());
  const auto before = bump();
  ASSERT_TRUE(before);
  set_back(2.0);
  const auto after = bump();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->seq, before->seq + 1);
}

TEST_F(PerceptionNodeTest, H1_uses_scans_as_drivers_send_them) {
  ASSERT_TRUE(until([this] { return near_.has_value(); }));
  struct Habit {
    const char* name;
    std::function<void(sensor_msgs::LaserScan&)> have;
  };
  const std::vector<Habit> habits = {
      {"the stamp of sending, and a sweep of 0.2 s",
       [](auto& msg) { msg.time_increment = 0.2F / 359.0F; }},
      {"a sweep of 0.9 s, whose end no transform reaches in time",
       [](auto& msg) { msg.time_increment = 0.9F / 359.0F; }},
      {"the stamp of the first ray of a sweep that ends now",
       [](auto& msg) {
         msg.time_increment = 0.07F / 359.0F;
         msg.header.stamp -= ros::Duration(0.07);
       }},
      {"delivered 0.2 s late", [](auto& msg) { msg.header.stamp -= ros::Duration(0.2); }},
      {"a frame of ROS 1's first drivers", [](auto& msg) { msg.header.frame_id = "/laser"; }},
      {"most rays 0",
       [](auto& msg) { std::fill(msg.ranges.begin() + 90, msg.ranges.end(), 0.0F); }},
  };
  for (const Habit& habit : habits) {
    int sent = 0, seen = 0;
    spoil_ = [&](auto& msg) {
      ++sent;
      habit.have(msg);
    };
    ASSERT_TRUE(until([&] { return sent >= 5; }));  // of the habit before, none is under way
    sent = 0;
    EXPECT_TRUE(until([&] {
      if (std::exchange(obstacles_, std::nullopt)) ++seen;
      return sent >= 20;
    }));
    EXPECT_GE(seen, 15) << habit.name;
    near_.reset();
    EXPECT_TRUE(until([this] { return near_.has_value(); })) << habit.name;
  }
}

TEST_F(PerceptionNodeTest, H2_loses_sensing_where_no_ray_has_a_measurement) {
  ASSERT_TRUE(until([this] { return near_.has_value(); }));
  int sent = 0;
  spoil_ = [&](auto& msg) {
    ++sent;
    msg.ranges.assign(360, 0.0F);
  };
  ASSERT_TRUE(until([&] { return sent >= 10; }));
  near_.reset();
  ASSERT_TRUE(until([&] { return sent >= 15; }));
  EXPECT_FALSE(near_);
  EXPECT_NE(sensing_.find("no_return"), std::string::npos) << sensing_;
  spoil_ = {};
  EXPECT_TRUE(until([this] { return near_.has_value(); }));
}

TEST_F(PerceptionNodeTest, tells_nothing_of_scans_that_cannot_be_used_and_goes_on_after_them) {
  ASSERT_TRUE(until([this] { return near_.has_value(); }));
  const std::vector<std::function<void(sensor_msgs::LaserScan&)>> faults = {
      [](auto& msg) { msg.angle_increment = std::numeric_limits<float>::quiet_NaN(); },
      [](auto& msg) { msg.ranges.clear(); },
      [](auto& msg) { msg.header.frame_id = "no_such_frame"; },
      [](auto& msg) { msg.header.stamp += ros::Duration(60.0); },
      [](auto& msg) { msg.header.stamp -= ros::Duration(60.0); },
      [](auto& msg) { msg.ranges.assign(1'000'000, 1.0F); },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    int sent = 0;
    // Those sent before may still be under way; after ten bad ones nothing is told any more.
    spoil_ = [&](auto& msg) {
      ++sent;
      faults[i](msg);
    };
    ASSERT_TRUE(until([&] { return sent >= 10; })) << i;
    obstacles_.reset();
    ASSERT_TRUE(until([&] { return sent >= 15; })) << i;
    EXPECT_FALSE(obstacles_) << i;
    spoil_ = {};
    ASSERT_TRUE(until([this] { return obstacles_.has_value(); })) << i;
  }
}

TEST_F(PerceptionNodeTest, a_bumper_that_is_pressed_is_one_contact_ahead) {
  ASSERT_TRUE(ready());
  for (const std::uint32_t count : {1U, 2U}) {
    const auto contact = bump();
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->thing_class, "other");
    EXPECT_EQ(contact->seq, count);
    EXPECT_NEAR(contact->point.x, 10.35, 1e-6);
  }
}

TEST_F(PerceptionNodeTest, a_bumper_that_is_pressed_where_the_robot_is_lost_is_a_contact) {
  ASSERT_TRUE(ready());
  lost_ = true;
  frame("map", "base_link", 14.0, 0.0, 1.0);  // from the future, so that no place is known
  near_.reset();
  sensing_.clear();
  ASSERT_TRUE(until([this] { return sensing_.find("not sensed") != std::string::npos; }));
  const auto contact = bump();
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->point.x, 10.35, 1e-6) << "where it was last";
  lost_ = false;
}

TEST_F(PerceptionNodeTest, sees_the_room_a_mover_and_what_a_camera_adds) {
  ASSERT_TRUE(until([this] { return near_ && !near_->things.empty(); }));
  EXPECT_EQ(near_->header.frame_id, "base_link");
  EXPECT_EQ(near_->things[0].thing_class, "wall");
  EXPECT_NEAR(near_->things[0].gap, kRoom - 0.35, 0.15);
  ASSERT_TRUE(until([this] { return map_.has_value(); }));
  EXPECT_EQ(map_->id, "OcTree");
  EXPECT_EQ(map_->header.frame_id, "map");

  // The walls are known now; who walks by is a mover.
  disc_y_ = -2.0;
  ASSERT_TRUE(until([this] {
    return obstacles_ && !obstacles_->obstacles.empty() &&
           obstacles_->obstacles[0].velocity.y > 0.5;
  }));
  EXPECT_EQ(obstacles_->header.frame_id, "map");
  EXPECT_EQ(obstacles_->obstacles[0].thing_class, "other");
  EXPECT_NEAR(obstacles_->obstacles[0].pose.position.x, 11.5, 0.3);
  disc_y_.reset();

  has_camera = true;
  // A box too low for the lidar, and one that hangs lower than navigation's robot_height of 1.2 m.
  for (const auto& [ahead, foot] : {std::pair{1.0F, 0.0F}, {1.6F, 1.0F}})
    ASSERT_TRUE(until([this, ahead = ahead, foot = foot] {
      clouds_.publish(cloud(ahead, foot));
      for (const auto& thing : near_->things)
        if (std::abs(thing.gap - (ahead - 0.35F)) < 0.1) return true;
      return false;
    }));
}

TEST_F(TwoLidarsTest, H2_a_lidar_that_never_sent_anything_is_missed) {
  has_rear_ = false;
  EXPECT_TRUE(until([this] { return sensing_.find("rear/scan: no") != std::string::npos; }));
  ASSERT_TRUE(until([this] { return obstacles_.has_value(); })) << "the lidar ahead is seen";
  sensing_.clear();
  ASSERT_TRUE(until([this] { return !sensing_.empty(); }));
  EXPECT_FALSE(near_);
  has_rear_ = true;
  EXPECT_TRUE(until([this] { return near_.has_value(); }));
}

TEST_F(TwoLidarsTest, sees_all_around_by_a_lidar_ahead_and_one_behind_but_not_the_robot) {
  // Each sees its own half; the rear one, half a period later, also a mast of the robot.
  bool behind = false;  // something stands there, 1.5 m from the middle
  spoil_ = [&](auto& msg) {
    for (std::size_t ray = 90; ray < 270; ++ray) msg.ranges[ray] = kNone;
  };
  spoil_rear_ = [&](auto& msg) {
    for (std::size_t ray = 85; ray < 95; ++ray) msg.ranges[ray] = 0.2F;
    for (std::size_t ray = 178; behind && ray <= 186; ++ray) msg.ranges[ray] = 1.5F;
  };
  const auto near = [this](double low, double high) {  // m, of x in base_link; not the walls
    return std::any_of(near_->things.begin(), near_->things.end(), [&](const auto& thing) {
      return thing.nearest.x >= low && thing.nearest.x <= high && thing.gap < 2.0;
    });
  };
  near_.reset();
  ASSERT_TRUE(until([&] { return near_ && !near_->things.empty(); }));
  behind = true;
  disc_y_ = -2.0;
  EXPECT_TRUE(until([&] { return near(-1.7, -1.3) && near(1.0, 1.7); }));
  EXPECT_FALSE(near(-0.35, 0.35)) << "the mast";
}

TEST_F(TwoLidarsTest, H2_a_mover_whose_lidar_fell_silent_is_near_until_sensing_is_lost) {
  ASSERT_TRUE(until([this] { return near_.has_value(); }));
  disc_y_ = -2.0;
  const auto holds_mover = [this] {
    return std::any_of(near_->things.begin(), near_->things.end(),
                       [](const auto& thing) { return thing.moving; });
  };
  ASSERT_TRUE(until([&] { return near_ && holds_mover(); }));
  spoil_ = [](auto& msg) { msg.ranges.clear(); };
  const ros::WallTime silent = ros::WallTime::now();
  int told = 0;
  EXPECT_TRUE(until([&] {
    const double since = (ros::WallTime::now() - silent).toSec();
    if (near_) {
      EXPECT_TRUE(holds_mover()) << since;
      ++told;
      near_.reset();
    }
    return since > 3.0;
  }));
  EXPECT_GE(told, 5) << "one frame that is missing takes no sight";
}

TEST_F(TwoLidarsTest, H2_says_why_the_messages_of_one_of_its_sensors_are_dropped) {
  ASSERT_TRUE(until([this] { return near_.has_value(); }));
  spoil_rear_ = [](auto& msg) { msg.angle_increment = kNone; };
  EXPECT_TRUE(until([this] { return sensing_.find("rear/scan: its angles") != std::string::npos; }))
      << sensing_;
}

TEST_F(TwoLidarsTest, H2_loses_sensing_where_one_of_its_sensors_falls_silent) {
  has_camera = true;
  for (bool* const sensor : {&has_rear_, &has_camera}) {
    ASSERT_TRUE(until([this] { return near_.has_value(); }));
    *sensor = false;
    const std::string name = sensor == &has_rear_ ? "rear/scan" : "points";
    EXPECT_TRUE(until([&] { return sensing_.find(name + ": no message") != std::string::npos; }));
    near_.reset();
    sensing_.clear();
    ASSERT_TRUE(until([this] { return !sensing_.empty(); }));
    EXPECT_FALSE(near_) << "the lidar ahead goes on";
    *sensor = true;
    near_.reset();
  }
  EXPECT_TRUE(until([this] { return near_.has_value(); }));
}

TEST_F(TwoLidarsTest, warns_of_a_bumper_that_nothing_publishes_and_tells_of_no_contacts) {
  bool warned = false;
  const ros::Subscriber log = node_.subscribe<rosgraph_msgs::Log>(
      "/rosout", 100, [&](const rosgraph_msgs::Log::ConstPtr& msg) {
        warned = warned || msg->msg.find("Nothing publishes the bumper, no/such") == 0;
      });
  EXPECT_TRUE(until([&] { return warned; }));
  EXPECT_EQ(contacts_.getNumPublishers(), 0U) << "by which others would know that they are counted";
  ros::Publisher late = node_.advertise<std_msgs::Bool>("no/such", 5);
  EXPECT_TRUE(until([this] { return contacts_.getNumPublishers() > 0; }));
  late.shutdown();
  EXPECT_TRUE(until([this] { return contacts_.getNumPublishers() == 0; }));
}

TEST_F(PerceptionNodeTest, T1_a_sensor_that_is_silent_is_missed_when_time_has_jumped_back_too) {
  has_camera = true;
  const ros::WallTime added = ros::WallTime::now();
  ASSERT_TRUE(until([&] { return near_ && (ros::WallTime::now() - added).toSec() > 2.0; }));
  has_camera = false;
  sensing_.clear();
  ASSERT_TRUE(until([this] { return sensing_.find("points: no") != std::string::npos; }));
  near_.reset();
  set_back(2.0);
  const ros::WallTime begin = ros::WallTime::now();
  EXPECT_TRUE(until([&] { return (ros::WallTime::now() - begin).toSec() > 3.0; }));
  EXPECT_FALSE(near_);
  has_camera = true;
  EXPECT_TRUE(until([this] { return near_.has_value(); }));
}

}  // namespace
}  // namespace navvi_perception

int main(int argc, char** argv) {
  ros::init(argc, argv, "perception_node_test");
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
