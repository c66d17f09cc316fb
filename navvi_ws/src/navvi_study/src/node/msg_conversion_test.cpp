#include "node/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fuzz_message.hpp"

namespace navvi_study::node {
namespace {

diagnostic_msgs::DiagnosticStatus device(const std::string& name, std::int8_t level,
                                         const std::string& state) {
  diagnostic_msgs::DiagnosticStatus status;
  status.name = name;
  status.level = level;
  if (!state.empty()) {
    status.values.emplace_back();
    status.values.back().key = "state";
    status.values.back().value = state;
  }
  return status;
}

TEST(DeviceReports, tell_off_from_missing_and_works) {
  using diagnostic_msgs::DiagnosticStatus;
  using trial::DeviceState;
  diagnostic_msgs::DiagnosticArray msg;
  msg.status = {device("navvi/pad", DiagnosticStatus::OK, "off"),
                device("feedback_node: navvi/audio", DiagnosticStatus::WARN, "works"),
                device("navvi/speech", DiagnosticStatus::OK, ""),
                device("navvi/pad", DiagnosticStatus::ERROR, "no such word"),
                device("motors", DiagnosticStatus::OK, "works")};
  const auto reports = from_msg(msg);
  ASSERT_EQ(reports.size(), 4U);
  EXPECT_EQ(reports[0].state, DeviceState::off);
  EXPECT_EQ(reports[1].state, DeviceState::works);
  EXPECT_EQ(reports[2].state, DeviceState::works) << "by its level";
  EXPECT_EQ(reports[3].state, DeviceState::missing) << "by its level";
}

TEST(Corrections, are_of_the_robots_own_odometry_alone) {
  tf2_msgs::TFMessage msg;
  for (const char* child : {"odom", "other/odom", "tb3/odom"}) {
    msg.transforms.emplace_back();
    msg.transforms.back().header.frame_id = "tb3/map";
    msg.transforms.back().child_frame_id = child;
    msg.transforms.back().transform.rotation.w = 1.0;
    msg.transforms.back().transform.translation.x = static_cast<double>(msg.transforms.size());
  }
  const auto corrections = from_msg(msg, true, "tb3/odom");
  ASSERT_EQ(corrections.size(), 1U);
  EXPECT_EQ(corrections[0].odom.position.x(), 3.0);
  EXPECT_EQ(corrections[0].stamp, trial::Correction::kForGood);
}

TEST(FuzzMessages, C3_of_the_record_are_taken_or_left_out) {
  diagnostic_msgs::DiagnosticArray devices;
  devices.status = {device("navvi/pad", diagnostic_msgs::DiagnosticStatus::OK, "off")};
  navvi_test::fuzz_message(devices, [](const auto& msg) { static_cast<void>(from_msg(msg)); });
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(1);
  transforms.transforms[0].header.frame_id = "map";
  transforms.transforms[0].child_frame_id = "odom";
  transforms.transforms[0].transform.rotation.w = 1.0;
  navvi_test::fuzz_message(transforms, [](const tf2_msgs::TFMessage& msg) {
    for (const trial::Correction& one : from_msg(msg, false, "odom"))
      EXPECT_TRUE(std::isfinite(one.odom.position.sum() + one.odom.yaw));
  });
  sensor_msgs::TimeReference clock;
  clock.source = "lsl";
  navvi_test::fuzz_message(clock, [](const auto& msg) { static_cast<void>(from_msg(msg)); });
  sensor_msgs::Joy joy;
  joy.axes = {0.5F, -1.0F};
  joy.buttons = {0, 1};
  navvi_test::fuzz_message(joy, [](const auto& msg) { static_cast<void>(from_msg(msg)); });
  record::Row row{"trial-1", 4, 5, 0, "CUE", {}};
  row.fields.set("text", "go on");
  navvi_test::fuzz_message(to_msg(row), [](const navvi_msgs::TrialEvent& msg) {
    const auto taken = from_msg(msg);
    EXPECT_TRUE(!taken || record::Fields::parse(taken->fields.format()) == taken->fields);
  });
}

}  // namespace
}  // namespace navvi_study::node
