#include "navvi_types/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

#include "fuzz_message.hpp"
#include "navvi_types/limits.hpp"

namespace navvi_types {
namespace {

constexpr std::int64_t kStamp = 12'000'000'345;

using Values = std::vector<double>;

/// A number of a message, and the values next to its range that it must not have.
struct Number {
  double* at;
  Values beyond;
};

/// The ends of [-limit, limit], overstepped.
Values beyond(double limit) { return {-1.001 * limit, 1.001 * limit}; }
/// Of [0, limit].
Values beyond_from_0(double limit) { return {-1e-3, 1.001 * limit}; }

/// Finds each number of a message, as a stream that the message is read from.
class Numbers {
 public:
  /// \param own  for the numbers that are no part of a place, a rotation or a vector, in the order
  /// of the message's definition \param vectors  the limit of their parts
  /// \param rotations  they are checked
  Numbers(std::vector<Values> own, double vectors, bool rotations)
      : own_(std::move(own)), vectors_(vectors), rotations_(rotations) {}

  template <typename Part>
  void next(Part& part) {
    if constexpr (std::is_same_v<Part, double>)
      found.push_back({&part, own_.at(seen_++)});
    else if constexpr (std::is_same_v<Part, geometry_msgs::Point>)
      add(part, kFarthest);
    else if constexpr (std::is_same_v<Part, geometry_msgs::Vector3>)
      add(part, vectors_);
    else if constexpr (std::is_same_v<Part, geometry_msgs::Quaternion>)
      add_rotation(part);
    else if constexpr (ros::message_traits::IsMessage<Part>::value)
      ros::serialization::Serializer<Part>::read(*this, part);
  }
  template <typename Part>
  void next(std::vector<Part>& parts) {
    for (Part& part : parts) next(part);
  }

  /// How many of these it has met.
  [[nodiscard]] std::size_t own() const { return seen_; }

  std::vector<Number> found;

 private:
  template <typename Part>
  void add(Part& part, double limit) {
    for (double* const number : {&part.x, &part.y, &part.z})
      found.push_back({number, beyond(limit)});
  }
  void add_rotation(geometry_msgs::Quaternion& q) {
    if (!rotations_) return;
    found.insert(found.end(), {{&q.x, {0.2}}, {&q.y, {0.2}}, {&q.z, {0.0}}, {&q.w, {0.0, 1.0}}});
  }

  std::vector<Values> own_;
  double vectors_;
  bool rotations_;
  std::size_t seen_ = 0;
};

/// The sound message is taken; with any one number spoilt it is dropped whole.
template <typename Msg>
void expect_each_checked(Msg msg, const std::vector<Values>& own = {}, double vectors = kFastest,
                         bool rotations = true) {
  SCOPED_TRACE(ros::message_traits::datatype<Msg>());
  ASSERT_TRUE(from_msg(msg).has_value());
  Numbers numbers(own, vectors, rotations);
  numbers.next(msg);
  EXPECT_EQ(numbers.own(), own.size());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < numbers.found.size(); ++i) {
    Values bad = numbers.found[i].beyond;
    bad.insert(bad.end(), {std::nan(""), kInfinity, -kInfinity, 1e308});
    for (const double value : bad) {
      const double sound = std::exchange(*numbers.found[i].at, value);
      EXPECT_FALSE(from_msg(msg).has_value()) << "number " << i << ", value " << value;
      *numbers.found[i].at = sound;
    }
  }
}

template <typename Msg>
void expect_same_after_round_trip(const Msg& msg) {
  const auto value = from_msg(msg);
  ASSERT_TRUE(value.has_value());
  EXPECT_EQ(to_msg(*value), msg);
}

/// A point or a vector.
template <typename Part>
void set(Part& part, double x, double y, double z = 0.0) {
  part.x = x;
  part.y = y;
  part.z = z;
}

geometry_msgs::Quaternion heading(double yaw) {
  geometry_msgs::Quaternion q;
  q.z = std::sin(0.5 * yaw);
  q.w = std::cos(0.5 * yaw);
  return q;
}

std_msgs::Header header(const char* frame) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = from_ns(kStamp);
  return header;
}

geometry_msgs::Twist twist() {
  geometry_msgs::Twist msg;
  msg.linear.x = 0.5;
  msg.angular.z = -0.25;
  return msg;
}

nav_msgs::Odometry odometry() {
  nav_msgs::Odometry msg;
  msg.header = header("odom");
  msg.child_frame_id = "base_link";
  set(msg.pose.pose.position, 3.0, -2.0, 0.1);
  msg.pose.pose.orientation = heading(0.5);
  msg.twist.twist = twist();
  msg.twist.twist.linear.y = 0.125;
  return msg;
}

navvi_msgs::Proximity proximity() {
  navvi_msgs::Proximity msg;
  msg.header = header("base_link");
  msg.detection_radius = 5.0;
  navvi_msgs::ProximityThing& thing = msg.things.emplace_back();
  thing.id = 7;
  thing.name = "robot_3";
  thing.thing_class = "pallet_robot";
  thing.moving = true;
  thing.gap = 1.25;
  set(thing.nearest, 1.0, -0.5, 0.3);
  return msg;
}

navvi_msgs::Contact contact() {
  navvi_msgs::Contact msg;
  msg.header = header("map");
  msg.seq = 4;
  msg.id = 12;
  msg.name = "rack_2";
  msg.thing_class = "shelf";
  set(msg.point, 1.65, 3.0, 0.2);
  set(msg.robot.position, 2.0, 3.0);
  msg.robot.orientation = heading(0.5);
  msg.speed = 0.7;
  for (const char* thing_class : {"shelf", "worker"}) {
    navvi_msgs::ClassCount& entry = msg.counts.emplace_back();
    entry.thing_class = thing_class;
    entry.count = 2;
  }
  return msg;
}

navvi_msgs::Obstacles obstacles() {
  navvi_msgs::Obstacles msg;
  msg.header = header("map");
  navvi_msgs::Obstacle& thing = msg.obstacles.emplace_back();
  thing.id = 9;
  thing.thing_class = "forklift";
  set(thing.pose.position, 1.0, 2.0);
  thing.pose.orientation = heading(0.5);
  set(thing.velocity, 1.5, -0.5);
  thing.radius = 1.3;
  thing.height = 2.2;
  thing.length = 2.4;
  thing.width = 1.0;
  return msg;
}

navvi_msgs::Guidance guidance() {
  navvi_msgs::Guidance msg;
  msg.header = header("map");
  msg.seq = 9;
  msg.state = navvi_msgs::Guidance::BLOCKED;
  msg.refusal = navvi_msgs::Guidance::OFF_THE_MAP;
  msg.replan_reason = navvi_msgs::Guidance::PERIOD;
  msg.plans = 5;
  msg.plan_time = 0.01;
  msg.reroutes = 2;
  msg.reroute_reason = navvi_msgs::Guidance::PATH_CARVED;
  msg.mesh_age = 0.1;
  msg.map_age = 60.0;
  msg.blocked_by = "worker";
  msg.blocked_distance = 1.5;
  msg.blocked_for = 3.0;
  msg.goal.x = 6.0;
  msg.waypoint.y = 2.0;
  msg.goal.z = msg.waypoint.z = 0.1;
  msg.ends_short = true;
  msg.waypoint_is_goal = true;
  msg.waypoint_distance = 2.0;
  msg.waypoint_angle = -1.5;
  msg.steer_angle = -1.25;
  msg.turn_angle = 1.0;
  msg.goal_distance = 8.0;
  msg.eta = 11.0;
  msg.shortest_length = 7.5;
  msg.path_offset = 0.25;
  msg.detail = "blocked";
  return msg;
}

navvi_msgs::Cue cue() {
  navvi_msgs::Cue msg;
  msg.header = header("");
  msg.id = 5;
  msg.stage = navvi_msgs::Cue::CUT;
  msg.modality = navvi_msgs::Cue::RUMBLE;
  msg.priority = navvi_msgs::Cue::MESSAGE;
  msg.kind = "rumble";
  msg.text = "stuck, shelf ahead";
  msg.left = 0.5F;
  msg.right = 1.0F;
  return msg;
}

navvi_msgs::Scenario scenario() {
  navvi_msgs::Scenario msg;
  msg.header = header("map");
  msg.world = "busy";
  msg.world_hash = "0123456789abcdef";
  msg.seed = 301;
  msg.start.position.x = -4.0;
  msg.start.orientation = heading(0.5);
  set(msg.goal, 4.0, 1.0);
  msg.parameters = "world: busy";
  msg.places.resize(1);
  msg.places[0].kind = navvi_msgs::Place::AISLE;
  msg.places[0].number = 2;
  msg.places[0].at.x = 0.5;
  set(msg.places[0].high, 1.0, 8.0);
  return msg;
}

navvi_msgs::StateHash state_hash() {
  navvi_msgs::StateHash msg;
  msg.header = header("map");
  msg.step = 100;
  msg.hash = "00f3456789abcdef";
  return msg;
}

navvi_msgs::DriveState drive_state() {
  navvi_msgs::DriveState msg;
  msg.header = header("");
  msg.state = navvi_msgs::DriveState::STOPPED;
  msg.reason = navvi_msgs::DriveState::COMMAND_INVALID;
  msg.assistance = navvi_msgs::DriveState::STEERS_LEFT;
  msg.rejected = 3;
  msg.intruder = "/teleop";
  return msg;
}

navvi_msgs::Zone zone() {
  navvi_msgs::Zone msg;
  msg.header = header("map");
  msg.kind = navvi_msgs::Zone::SLOW;
  msg.name = "lane";
  msg.forward = 0.3;
  msg.backward = 0.2;
  return msg;
}

navvi_msgs::LinkState link_state() {
  navvi_msgs::LinkState msg;
  msg.header = header("");
  msg.round_trip = 0.2;
  msg.round_trip_99 = 0.4;
  msg.jitter = 0.03;
  msg.loss = 0.01;
  msg.foresight = 0.2;
  msg.late = navvi_msgs::LinkState::SLOW;
  return msg;
}

TEST(MsgConversion, EveryMessageSurvivesTheRoundTrip) {
  expect_same_after_round_trip(twist());
  expect_same_after_round_trip(odometry());
  expect_same_after_round_trip(proximity());
  expect_same_after_round_trip(contact());
  expect_same_after_round_trip(obstacles());
  expect_same_after_round_trip(guidance());
  expect_same_after_round_trip(cue());
  expect_same_after_round_trip(scenario());
  expect_same_after_round_trip(state_hash());
  expect_same_after_round_trip(drive_state());
  expect_same_after_round_trip(link_state());
  expect_same_after_round_trip(zone());
  navvi_msgs::TrialState state;
  state.state = navvi_msgs::TrialState::READY;
  expect_same_after_round_trip(state);
  navvi_msgs::TrialRequest request;
  request.request = navvi_msgs::TrialRequest::END;
  expect_same_after_round_trip(request);
}

/// What is taken is sent on, and taken there.
template <typename Msg>
void fuzz_round_trip(const Msg& whole) {
  navvi_test::fuzz_message(whole, [](const Msg& msg) {
    const auto value = from_msg(msg);
    if (!value) return;
    const Msg again = to_msg(*value);
    const auto same = from_msg(again);
    ASSERT_TRUE(same.has_value());
    EXPECT_EQ(navvi_test::bytes_of(to_msg(*same)).size(), navvi_test::bytes_of(again).size());
  });
}

TEST(FuzzMessages, C3_are_taken_or_dropped_and_taken_again_when_they_are_sent_on) {
  fuzz_round_trip(twist());
  fuzz_round_trip(odometry());
  fuzz_round_trip(proximity());
  fuzz_round_trip(contact());
  fuzz_round_trip(obstacles());
  fuzz_round_trip(guidance());
  fuzz_round_trip(cue());
  fuzz_round_trip(scenario());
  fuzz_round_trip(state_hash());
  fuzz_round_trip(drive_state());
  fuzz_round_trip(link_state());
  fuzz_round_trip(navvi_msgs::Zone());
  fuzz_round_trip(navvi_msgs::TrialState());
  fuzz_round_trip(navvi_msgs::TrialRequest());
}

TEST(FuzzMessages, C3_of_places_are_finite_where_they_are_taken) {
  geometry_msgs::PoseStamped pose;
  pose.pose.orientation = heading(0.5);
  const auto is_finite = [](const auto& msg) {
    const auto at = from_msg(msg);
    EXPECT_TRUE(!at || at->allFinite());
  };
  navvi_test::fuzz_message(pose, is_finite);
  navvi_test::fuzz_message(geometry_msgs::PointStamped(), is_finite);
  nav_msgs::Path path;
  path.poses = {pose, pose};
  navvi_test::fuzz_message(path, [](const nav_msgs::Path& msg) {
    for (const Eigen::Vector2d& point : from_msg(msg).value_or(std::vector<Eigen::Vector2d>()))
      EXPECT_TRUE(point.allFinite());
  });
  geometry_msgs::Transform transform;
  transform.rotation = heading(0.5);
  navvi_test::fuzz_message(transform, [](const geometry_msgs::Transform& msg) {
    const auto at = from_msg(msg);
    EXPECT_TRUE(!at || std::isfinite(at->position.sum() + at->yaw));
  });
}

TEST(MsgConversion, WhatIsNotKnownSurvivesTheRoundTrip) {
  navvi_msgs::Guidance msg = guidance();
  msg.mesh_age = msg.map_age = msg.blocked_for = -1.0;
  msg.blocked_by.clear();
  expect_same_after_round_trip(msg);
  msg.blocked_for = 0.0;
  expect_same_after_round_trip(msg);
  EXPECT_EQ(to_msg(Guidance{}).blocked_for, 0.0);
  EXPECT_EQ(to_msg(Guidance{}).map_age, -1.0);
}

TEST(MsgConversion, EmptyListsSurviveTheRoundTrip) {
  navvi_msgs::Proximity near = proximity();
  near.things.clear();
  expect_same_after_round_trip(near);
  navvi_msgs::Obstacles none = obstacles();
  none.obstacles.clear();
  expect_same_after_round_trip(none);
  EXPECT_TRUE(from_msg(nav_msgs::Path())->empty());
  EXPECT_TRUE(path_msg({}, 0.0, kStamp).poses.empty());
}

TEST(MsgConversion, C3_EveryNumberOfATwistIsChecked) { expect_each_checked(twist()); }

TEST(MsgConversion, EveryNumberOfEachOtherMessageIsChecked) {
  const Values length = beyond_from_0(kLongest), duration = beyond_from_0(kLongestTime);
  const Values or_none = {-0.5, -2.0, 1.001 * kLongestTime}, angle = beyond(M_PI);
  const Values size = {-1.0, 0.0, 1.001 * kLargest}, side = {-1.0, 0.0, 3.0};
  const Values speed = beyond_from_0(kFastest);
  geometry_msgs::Transform transform;
  transform.rotation = heading(0.5);
  EXPECT_NEAR(from_msg(transform)->yaw, 0.5, 1e-12);
  expect_each_checked(transform, {}, kFarthest);
  expect_each_checked(odometry());
  expect_each_checked(proximity(), {{-1.0, 0.0, 1.001 * kLongest}, beyond(kLongest)});
  expect_each_checked(contact(), {beyond(kFastest)});
  expect_each_checked(obstacles(), {size, size, side, side});
  expect_each_checked(guidance(), {duration, or_none, or_none, length, or_none, length, angle,
                                   angle, angle, length, duration, length, length});
  expect_each_checked(scenario());
  expect_each_checked(link_state(), {duration, duration, duration, beyond_from_0(1.0), duration});
  expect_each_checked(zone(), {speed, speed});
}

TEST(MsgConversion, AMessageWithTooManyThingsOrWithoutItsNumberIsDropped) {
  EXPECT_FALSE(from_msg(geometry_msgs::Transform()).has_value()) << "no rotation";
  navvi_msgs::Proximity crowd = proximity();
  crowd.things.resize(kMostThings + 1, crowd.things[0]);
  EXPECT_FALSE(from_msg(crowd).has_value());
  navvi_msgs::Contact none = contact();
  none.seq = 0;
  EXPECT_FALSE(from_msg(none).has_value()) << "the first is 1";
  navvi_msgs::Obstacles twins = obstacles();
  twins.obstacles.push_back(twins.obstacles[0]);
  EXPECT_FALSE(from_msg(twins).has_value());
  nav_msgs::Path endless;
  endless.poses.resize(kMostPoints + 1);
  EXPECT_FALSE(from_msg(endless).has_value());
}

TEST(MsgConversion, AGoalNeedsAPlaceButNoDirection) {
  geometry_msgs::PoseStamped msg;
  EXPECT_EQ(from_msg(goal_msg({1.0, 2.0}, kStamp)), Eigen::Vector2d(1.0, 2.0));
  expect_each_checked(msg, {}, kFastest, false);
  for (double* const number : {&msg.pose.orientation.x, &msg.pose.orientation.w}) {
    const double sound = std::exchange(*number, NAN);
    EXPECT_FALSE(from_msg(msg).has_value());
    *number = sound;
  }
}

TEST(MsgConversion, AClickedPointIsAPlace) {
  geometry_msgs::PointStamped msg;
  set(msg.point, 1.0, 2.0);
  EXPECT_EQ(from_msg(msg), Eigen::Vector2d(1.0, 2.0));
  expect_each_checked(msg);
}

TEST(MsgConversion, APathLooksAlongItselfAndWithABadPointIsDropped) {
  const std::vector<Eigen::Vector2d> points = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}};
  const nav_msgs::Path path = path_msg(points, 0.1, kStamp);
  EXPECT_EQ(from_msg(path), points);
  EXPECT_EQ(path.header.frame_id, "map");
  EXPECT_EQ(path.poses[0].pose.orientation.w, 1.0);
  EXPECT_NEAR(path.poses[2].pose.orientation.z, std::sqrt(0.5), 1e-12);
  expect_each_checked(path, {}, kFastest, false);
}

TEST(MsgConversion, AMotorOfACueIsBetweenStillAndFull) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), -0.01F, 1.01F}) {
    navvi_msgs::Cue left = cue(), right = cue();
    left.left = right.right = bad;
    EXPECT_FALSE(from_msg(left).has_value()) << bad;
    EXPECT_FALSE(from_msg(right).has_value()) << bad;
  }
}

TEST(MsgConversion, APatternOrASoundThatIsNoneDropsItsMessage) {
  navvi_msgs::Cue msg = cue();
  for (const std::uint8_t modality : {navvi_msgs::Cue::RUMBLE, navvi_msgs::Cue::SOUND}) {
    msg.modality = modality;
    msg.kind = "whistle";
    EXPECT_FALSE(from_msg(msg).has_value());
  }
  msg.modality = navvi_msgs::Cue::SPEECH;
  msg.kind = "tutorial_stop";
  ASSERT_TRUE(from_msg(msg).has_value());
  EXPECT_EQ(from_msg(msg)->kind(), CueKind::lesson);
  EXPECT_EQ(from_msg(msg)->word(), "tutorial_stop") << "the key of a lesson's text";
}

TEST(MsgConversion, AConstantThatIsNoneDropsItsMessage) {
  using G = navvi_msgs::Guidance;
  using C = navvi_msgs::Cue;
  using D = navvi_msgs::DriveState;
  const auto expect_dropped = [](auto msg, auto member, auto value) {
    msg.*member = static_cast<std::uint8_t>(names(value).size() - 1);
    EXPECT_TRUE(from_msg(msg).has_value());
    ++(msg.*member);
    EXPECT_FALSE(from_msg(msg).has_value());
  };
  expect_dropped(guidance(), &G::state, Guidance::State{});
  expect_dropped(guidance(), &G::refusal, Guidance::Refusal{});
  expect_dropped(guidance(), &G::replan_reason, Guidance::Replan{});
  expect_dropped(guidance(), &G::reroute_reason, Guidance::Replan{});
  expect_dropped(cue(), &C::stage, CueStage{});
  navvi_msgs::Cue sound = cue();
  sound.kind = "turn";  // a word of the last modality
  expect_dropped(sound, &C::modality, Modality{});
  expect_dropped(cue(), &C::priority, Priority{});
  expect_dropped(drive_state(), &D::state, DriveState::State{});
  expect_dropped(drive_state(), &D::reason, DriveState::Reason{});
  expect_dropped(drive_state(), &D::assistance, DriveState::Assistance{});
  expect_dropped(link_state(), &navvi_msgs::LinkState::late, LinkState::Late{});
  expect_dropped(navvi_msgs::TrialState(), &navvi_msgs::TrialState::state, TrialState::State{});
  expect_dropped(navvi_msgs::TrialRequest(), &navvi_msgs::TrialRequest::request,
                 TrialRequest::Kind{});
}

/// The words of the constants that stand before `field` in the definition of a message.
template <typename Msg>
std::vector<std::string> constants_of(const std::string& field) {
  static const std::regex kConstant("uint8 ([A-Z_]+)=([0-9]+).*");
  std::istringstream definition(ros::message_traits::Definition<Msg>::value());
  std::vector<std::string> words;
  for (std::string line; std::getline(definition, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kConstant)) {
      EXPECT_EQ(std::stoul(match[2]), words.size()) << line;
      words.push_back(match[1]);
      for (char& letter : words.back()) letter = static_cast<char>(std::tolower(letter));
    } else if (line.rfind("uint8 ", 0) == 0) {
      if (line.substr(6, line.find(' ', 6) - 6) == field) return words;
      words.clear();
    }
  }
  ADD_FAILURE() << "there is no " << field;
  return {};
}

TEST(MsgConversion, EachEnumerationHasTheConstantsOfItsMessage) {
  const auto words = [](auto none) {
    const auto all = names(none);
    return std::vector<std::string>(all.begin(), all.end());
  };
  EXPECT_EQ(words(Guidance::State{}), constants_of<navvi_msgs::Guidance>("state"));
  EXPECT_EQ(words(Guidance::Replan{}), constants_of<navvi_msgs::Guidance>("replan_reason"));
  std::vector<std::string> refusals = constants_of<navvi_msgs::Guidance>("refusal");
  EXPECT_EQ(std::exchange(refusals.at(0), "none"), "not_refused");
  EXPECT_EQ(words(Guidance::Refusal{}), refusals);
  EXPECT_EQ(words(CueStage{}), constants_of<navvi_msgs::Cue>("stage"));
  EXPECT_EQ(words(Modality{}), constants_of<navvi_msgs::Cue>("modality"));
  EXPECT_EQ(words(Priority{}), constants_of<navvi_msgs::Cue>("priority"));
  EXPECT_EQ(words(DriveState::State{}), constants_of<navvi_msgs::DriveState>("state"));
  EXPECT_EQ(words(DriveState::Reason{}), constants_of<navvi_msgs::DriveState>("reason"));
  EXPECT_EQ(words(DriveState::Assistance{}), constants_of<navvi_msgs::DriveState>("assistance"));
  EXPECT_EQ(words(LinkState::Late{}), constants_of<navvi_msgs::LinkState>("late"));
}

TEST(MsgConversion, AnUnknownClassIsOtherAndSoIsTheFloor) {
  for (const char* word : {"dragon", "", "floor"}) {
    navvi_msgs::Proximity msg = proximity();
    msg.things[0].thing_class = word;
    EXPECT_EQ(from_msg(msg)->things[0].thing_class, ThingClass::other) << word;
  }
  navvi_msgs::Contact msg = contact();
  msg.counts[0].thing_class = "dragon";
  msg.counts[1].thing_class = "other";
  EXPECT_EQ(from_msg(msg)->counts.at(ThingClass::other), 4U);
}

TEST(MsgConversion, AHashIsSixteenHexadecimalDigits) {
  EXPECT_EQ(from_msg(state_hash())->hash, 0x00f3456789abcdefU);
  for (const char* bad : {"", "0123456789abcde", "0123456789abcdef0", "0123456789abcdeg",
                          "-123456789abcdef", "0123456789ABCDEF"}) {
    navvi_msgs::StateHash msg = state_hash();
    msg.hash = bad;
    EXPECT_FALSE(from_msg(msg).has_value()) << bad;
  }
}

}  // namespace
}  // namespace navvi_types
