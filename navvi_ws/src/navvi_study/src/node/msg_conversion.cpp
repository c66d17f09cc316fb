#include "node/msg_conversion.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_study::node {

using navvi_types::from_ns;
using navvi_types::to_ns;

namespace {

/// As it says itself; of one that does not say, as its level tells.
trial::DeviceState state_of(const diagnostic_msgs::DiagnosticStatus& status) {
  for (const auto& pair : status.values)
    if (pair.key == "state")
      if (const auto state = navvi_types::from_word<trial::DeviceState>(pair.value)) return *state;
  return status.level == diagnostic_msgs::DiagnosticStatus::OK ? trial::DeviceState::works
                                                               : trial::DeviceState::missing;
}

}  // namespace

std::vector<trial::DeviceReport> from_msg(const diagnostic_msgs::DiagnosticArray& msg) {
  std::vector<trial::DeviceReport> reports;
  for (const auto& status : msg.status) {
    for (const char* device : {"pad", "audio", "speech", "latency"}) {
      const std::string name = std::string("navvi/") + device;
      const auto at = status.name.rfind(name);
      if (at == std::string::npos || at + name.size() != status.name.size()) continue;
      reports.push_back({to_ns(msg.header.stamp), device, state_of(status), {}});
      for (const auto& pair : status.values) reports.back().traits[pair.key] = pair.value;
    }
  }
  return reports;
}

std::vector<trial::Correction> from_msg(const tf2_msgs::TFMessage& msg, bool for_good,
                                        const std::string& odom_frame) {
  std::vector<trial::Correction> corrections;
  for (const auto& entry : msg.transforms) {
    if (entry.child_frame_id != odom_frame) continue;
    if (const auto odom = from_msg(entry.transform))
      corrections.push_back(
          {for_good ? trial::Correction::kForGood : to_ns(entry.header.stamp), *odom});
  }
  return corrections;
}

std::optional<trial::ClockOffset> from_msg(const sensor_msgs::TimeReference& msg) {
  const auto letter = [](char c) { return 'a' <= c && c <= 'z'; };
  if (msg.source.empty() || msg.source.size() > 16 ||
      !std::all_of(msg.source.begin(), msg.source.end(), letter))
    return std::nullopt;
  return trial::ClockOffset{msg.source, to_ns(msg.time_ref) - to_ns(msg.header.stamp)};
}

std::optional<trial::Hands> from_msg(const sensor_msgs::Joy& msg) {
  const auto inside = [](float axis) { return std::abs(axis) <= 1.0F; };
  if (msg.axes.size() < 2 || !inside(msg.axes[0]) || !inside(msg.axes[1])) return std::nullopt;
  return trial::Hands{to_ns(msg.header.stamp), static_cast<double>(msg.axes[1]),
                      static_cast<double>(msg.axes[0]),
                      !msg.buttons.empty() && msg.buttons[0] != 0};
}

navvi_msgs::TrialEvent to_msg(const record::Row& row) {
  navvi_msgs::TrialEvent msg;
  msg.header.stamp = from_ns(row.sim_ns);
  msg.trial = row.trial;
  msg.seq = row.seq;
  msg.type = row.type;
  msg.fields = row.fields.format();
  return msg;
}

std::optional<record::Row> from_msg(const navvi_msgs::TrialEvent& msg) {
  const auto fields = record::Fields::parse(msg.fields);
  if (!fields) return std::nullopt;
  return record::Row{msg.trial, msg.seq, to_ns(msg.header.stamp), 0, msg.type, *fields};
}

}  // namespace navvi_study::node
