#pragma once

#include <navvi_msgs/TrialEvent.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/JoyFeedbackArray.h>

#include <navvi_types/checked.hpp>
#include <navvi_types/cue_event.hpp>
#include <optional>
#include <string>

#include "navvi_feedback/drive/input_state.hpp"
#include "navvi_feedback/haptics/rumble.hpp"

namespace navvi_feedback::node {

using navvi_types::About;
using navvi_types::Content;
using navvi_types::CueKind;

/// Axes out of [-1, 1] by more than rounding, or fewer than two, are rejected.
[[nodiscard]] navvi_types::Checked<drive::InputState> from_msg(const sensor_msgs::Joy& msg);

[[nodiscard]] sensor_msgs::Joy to_msg(const drive::InputState& input, const ros::Time& stamp);
/// For joy_node, id 0 is the strong (left) motor and id 1 the weak (right) one; for ds4_driver it
/// is the other way round. \param driver  one of these names
[[nodiscard]] sensor_msgs::JoyFeedbackArray feedback_msg(const haptics::Rumble& rumble,
                                                         const std::string& driver = "joy_node");
/// The kind of cue that tells the person of the end of a trial; nullopt if none has ended, or the
/// arrival or the refusal of the goal tells it.
[[nodiscard]] std::optional<Content> last_words(const navvi_msgs::TrialEvent& msg);

}  // namespace navvi_feedback::node
