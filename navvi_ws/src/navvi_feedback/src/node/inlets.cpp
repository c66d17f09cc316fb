#include "node/inlets.hpp"

#include <sensor_msgs/BatteryState.h>
#include <std_msgs/Bool.h>
#include <std_msgs/String.h>

#include <navvi_types/msg_conversion.hpp>
#include <utility>

#include "navvi_feedback/node/msg_conversion.hpp"

namespace navvi_feedback::node {

using devices::Chain;
using devices::InputSource;
using devices::Latencies;
using drive::StickAge;
using navvi_types::from_msg;
using navvi_types::to_ns;

Inlets::Inlets(ros::NodeHandle& node, const NodeConfig& config, core::Guide& guide,
               PersonDevices& devices, Beat beat)
    : node_(node),
      guide_(guide),
      devices_(devices),
      beat_(std::move(beat)),
      stale_(config.feedback->kStale),
      tf_listener_(tf_, config.odom_frame) {
  subscribe_to_hands();
  subscribe_to_robot(config);
  subscribe_to_trials();
}

void Inlets::complete(senses::Devices& devices) {
  devices.robot = robot();
  devices.asked = asked_;
  if (twin_) devices.states.emplace_back(CueKind::notice, About::two_drivers);
  if (emergency_stop_) devices.states.push_back(CueKind::emergency_stop);
  if (battery_low_) devices.states.emplace_back(CueKind::notice, About::battery_low);
  const StickAge::Late late = stick_age_.late(now());
  if (late == StickAge::Late::slow) devices.states.emplace_back(CueKind::notice, About::pad_late);
  if (late == StickAge::Late::too_late) devices.states.push_back(CueKind::pad_too_late);
}

template <typename Msg, typename Take>
void Inlets::listen(const std::string& topic, std::uint32_t queue, Take take) {
  subscribers_.push_back(navvi_types::subscribe<Msg>(node_, topic, queue, from_msg, take));
}

void Inlets::subscribe_to_hands() {
  InputSource& source = devices_.source();
  if (source.kind() == InputSource::Kind::topic)
    listen<sensor_msgs::Joy>(
        "joy", 1, [this, &source](const drive::InputState& joy) { receive(joy, source); });
  // Without a stick in it, the keys are lost. Each message counts: a short press is two.
  if (source.kind() == InputSource::Kind::keyboard)
    subscribers_.push_back(node_.subscribe<sensor_msgs::Joy>(
        "navvi/keys", 100,
        [&source](const sensor_msgs::Joy::ConstPtr& keys) {
          source.receive(from_msg(*keys).value_or(drive::InputState{}), now());
        },
        {}, ros::TransportHints().tcpNoDelay()));
  subscribers_.push_back(node_.subscribe<std_msgs::String>(
      "navvi/ask", 10, [this](const std_msgs::String::ConstPtr& msg) {
        if (const auto button = navvi_types::from_word<drive::Button>(msg->data))
          asked_.push_back(*button);
      }));
}

/// A stick whose messages come too late counts as lost: a hand may have let go since.
void Inlets::receive(drive::InputState joy, InputSource& source) {
  const double time = now();
  if (joy.stamp != 0) {
    const double age = 1e-9 * static_cast<double>(to_ns(ros::Time::now()) - joy.stamp);
    stick_age_.add(age, time);
    const StickAge::Late late = stick_age_.late(time);
    joy.live = late != StickAge::Late::too_late;
    joy.late = late == StickAge::Late::slow;
    if (late != StickAge::Late::no && late != logged_)
      ROS_WARN(
          "A message of the stick came %.2f s after its stamp, so the robot %s. A busy machine or "
          "the way delays them, or the computers' clocks differ (chrony, NTP).",
          age, joy.live ? "is slow" : "stands");
    logged_ = late;
  }
  source.receive(joy, time);
}

void Inlets::subscribe_to_robot(const NodeConfig& config) {
  constexpr float kBatteryLow = 0.15F;   // of its charge
  constexpr float kBatteryFull = 0.20F;  // from which it is not low any more
  if (!config.emergency_stop.empty())
    subscribers_.push_back(node_.subscribe<std_msgs::Bool>(
        config.emergency_stop, 10,
        [this](const std_msgs::Bool::ConstPtr& msg) { emergency_stop_ = msg->data; }));
  if (!config.battery.empty())
    subscribers_.push_back(node_.subscribe<sensor_msgs::BatteryState>(
        config.battery, 10, [this](const sensor_msgs::BatteryState::ConstPtr& msg) {
          if (!(msg->percentage >= 0.0F)) return;  // NaN: not measured
          const float share = msg->percentage > 1.0F ? msg->percentage / 100.0F : msg->percentage;
          battery_low_ = share < (battery_low_ ? kBatteryFull : kBatteryLow);
        }));
  // A thing that is felt, hit or to be obeyed does not wait for the next beat.
  listen<navvi_msgs::Proximity>("navvi/proximity", 1, [this](const auto& proximity) {
    const std::chrono::nanoseconds age(to_ns(ros::Time::now()) - proximity.stamp);
    devices_.latencies().add(Chain::sensed, Latencies::Clock::now() - age);
    guide_.take(proximity, now());
    beat_(Chain::motors);
  });
  listen<navvi_msgs::Contact>("navvi/contacts", 100, [this](const auto& contact) {
    guide_.take(contact, now());
    beat_(Chain::pattern);
  });
  listen<navvi_msgs::Guidance>("navvi/guidance", 1, [this](const auto& guidance) {
    const bool news = !guide_.guidance() || guide_.guidance()->state != guidance.state;
    guide_.take(guidance, now());
    if (news) beat_(std::nullopt);
  });
  listen<navvi_msgs::DriveState>("navvi/drive_state", 1, [this](navvi_types::DriveState state) {
    twin_ = state.intruder == ros::this_node::getName();
    if (twin_) state.intruder.clear();
    guide_.take(state, now());
  });
  const auto take = [this](const auto& value) { guide_.take(value, now()); };
  listen<navvi_msgs::LinkState>("navvi/link", 1, take);
  listen<navvi_msgs::Zone>("navvi/zone", 1, take);
  listen<nav_msgs::Odometry>("odom", 1, take);
  listen<nav_msgs::Path>("navvi/path", 1, [this](const auto& path) { path_ = path; });
  listen<nav_msgs::Path>("navvi/preview", 1, [this](const auto& path) { preview_ = path; });
}

void Inlets::subscribe_to_trials() {
  listen<navvi_msgs::TrialState>("navvi/trial_state", 1, [this](const auto& state) {
    const bool runs = state.state == navvi_types::TrialState::State::running;
    if (runs && !std::exchange(runs_, runs)) devices_.latencies().clear();
    runs_ = runs;
    guide_.take(state, now());
  });
  listen<navvi_msgs::Scenario>("navvi/scenario", 1,
                               [this](const auto& scenario) { guide_.take(scenario, now()); });
  subscribers_.push_back(navvi_types::subscribe<geometry_msgs::PoseStamped>(
      node_, "move_base_simple/goal", 10, from_msg,
      [this](const Eigen::Vector2d& goal) { guide_.take_goal(goal); }, "map"));
  subscribers_.push_back(navvi_types::subscribe<geometry_msgs::PointStamped>(
      node_, "clicked_point", 10, from_msg,
      [this](const Eigen::Vector2d& place) { guide_.take_place(place); }, "map"));
  subscribers_.push_back(node_.subscribe<navvi_msgs::TrialEvent>(
      "navvi/events", 100, [this](const navvi_msgs::TrialEvent::ConstPtr& msg) {
        if (msg->type == "TRIAL_END") guide_.end_trial(last_words(*msg));
      }));
}

std::optional<navvi_types::Pose2> Inlets::robot() {
  const ros::Time now = ros::Time::now();
  const auto found = navvi_types::newest(tf_, "map", "base_link", now);
  if (!found || (now - found->header.stamp).toSec() > stale_) return std::nullopt;
  return from_msg(found->transform);
}

}  // namespace navvi_feedback::node
