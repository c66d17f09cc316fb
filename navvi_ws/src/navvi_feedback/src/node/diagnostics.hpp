#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <optional>
#include <string>

#include "devices/gamepad.hpp"
#include "devices/speaker.hpp"

namespace navvi_feedback::node {

// The health of the hardware, truthfully: a device that is absent is never OK, and "state" tells
// one that works from one that is missing and one that is off.

/// \param pad  nullopt if the stick comes from elsewhere
/// \param input  pad, keyboard or topic
/// \param live   the stick is alive
[[nodiscard]] diagnostic_msgs::DiagnosticStatus pad_status(
    const std::optional<devices::Gamepad::Status>& pad, const std::string& input, bool live);
[[nodiscard]] diagnostic_msgs::DiagnosticStatus audio_status(const devices::Mixer::Status& mixer);
[[nodiscard]] diagnostic_msgs::DiagnosticStatus speech_status(
    const devices::Speaker::Status& speaker, const std::string& voice);

}  // namespace navvi_feedback::node
