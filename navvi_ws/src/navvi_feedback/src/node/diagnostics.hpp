#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <optional>
#include <string>
#include <vector>

#include "devices/gamepad.hpp"
#include "devices/latencies.hpp"
#include "devices/speaker.hpp"
#include "navvi_feedback/sounds/learnt.hpp"
#include "node/beat.hpp"
#include "types.hpp"

namespace navvi_feedback::node {

// The health of the hardware, truthfully: a device that is absent is never OK, and "state" tells
// one that works from one that is missing and one that is off.

/// \param pad  nullopt if the stick comes from elsewhere
/// \param input  pad, keyboard or topic
/// \param live   the stick is alive
/// \param felt   false: the motors stay off by intent
[[nodiscard]] diagnostic_msgs::DiagnosticStatus pad_status(
    const std::optional<devices::Gamepad::Status>& pad, const std::string& input, bool live,
    bool felt);
[[nodiscard]] diagnostic_msgs::DiagnosticStatus audio_status(const devices::Mixer::Status& mixer);
[[nodiscard]] diagnostic_msgs::DiagnosticStatus speech_status(
    const devices::Speaker::Status& speaker, const std::string& voice);
/// What a person waited for: "motors p50_ms" and so on; a chain that was never seen has no values.
/// \param learnt  of the person, if turns have a sound
[[nodiscard]] diagnostic_msgs::DiagnosticStatus latency_status(
    const devices::Latencies& latencies, const std::optional<sounds::Learnt>& learnt);

/// Whether this node is woken in time: "longest_ms" between two beats.
[[nodiscard]] diagnostic_msgs::DiagnosticStatus beat_status(const Beat& beat);

/// What the person is to be told of the pad, as kinds of cues.
[[nodiscard]] std::vector<Content> notices_of(const devices::Gamepad::Status& pad);

}  // namespace navvi_feedback::node
