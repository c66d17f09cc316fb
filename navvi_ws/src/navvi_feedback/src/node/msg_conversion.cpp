#include "navvi_feedback/node/msg_conversion.hpp"

#include <cmath>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_feedback::node {

navvi_types::Checked<drive::InputState> from_msg(const sensor_msgs::Joy& msg) {
  constexpr float kAxisSlack = 1e-3F;  // of an axis beyond [-1, 1]
  if (msg.axes.size() < 2 || msg.axes.size() > 64 || msg.buttons.size() > 256)
    return navvi_types::Refusal{
        "it has fewer than 2 or more than 64 axes, or more than 256 buttons"};
  drive::InputState input;
  input.live = true;
  input.stamp = navvi_types::to_ns(msg.header.stamp);
  for (const float axis : msg.axes) {
    if (!(std::abs(axis) <= 1.0F + kAxisSlack))
      return navvi_types::Refusal{"an axis in it is not within -1 and 1"};
    input.axes.push_back(static_cast<double>(axis));
  }
  for (const int button : msg.buttons) input.buttons.push_back(button != 0);
  return input;
}

sensor_msgs::Joy to_msg(const drive::InputState& input, const ros::Time& stamp) {
  sensor_msgs::Joy msg;
  msg.header.stamp = stamp;
  for (const double axis : input.axes) msg.axes.push_back(static_cast<float>(axis));
  for (const bool button : input.buttons) msg.buttons.push_back(button ? 1 : 0);
  return msg;
}

sensor_msgs::JoyFeedbackArray feedback_msg(const haptics::Rumble& rumble,
                                           const std::string& driver) {
  sensor_msgs::JoyFeedbackArray msg;
  msg.array.resize(2);
  for (std::uint8_t id = 0; id < 2; ++id) {
    msg.array[id].type = sensor_msgs::JoyFeedback::TYPE_RUMBLE;
    msg.array[id].id = id;
    const bool left = (id == 0) == (driver == "joy_node");
    msg.array[id].intensity = static_cast<float>(left ? rumble.left : rumble.right);
  }
  return msg;
}

std::optional<Content> last_words(const navvi_msgs::TrialEvent& msg) {
  if (msg.type != "TRIAL_END") return std::nullopt;
  const std::string fields = ";" + msg.fields + ";";
  const auto holds = [&](const char* field) { return fields.find(field) != std::string::npos; };
  // Both are told by themselves; with a goal that is refused nothing has begun for the person.
  if (holds(";result=reached;") || holds(";result=refused;")) return std::nullopt;
  const bool late = holds(";result=timeout;");
  if (!late && holds(";reason=disk_full;")) return CueKind::trial_disk_full;
  return Content{CueKind::trial_ends, late ? About::time_up : About::over};
}

}  // namespace navvi_feedback::node
