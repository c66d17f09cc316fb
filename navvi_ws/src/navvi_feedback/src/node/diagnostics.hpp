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

/// Explains, once for each pad, that it has no heartbeat.
class HeartbeatNotice {
 public:
  /// \param time  s, of a clock that does not run backwards
  /// \return a sentence, when the pad's sensor has had time to begin and is silent
  [[nodiscard]] std::optional<std::string> notice(const devices::Gamepad::Status& pad,
                                                  double time) {
    if (pad.connections != connection_) {
      connection_ = pad.connections;
      since_ = time;
    }
    if (!since_ || !pad.connected || time - *since_ < kFirstBeat) return std::nullopt;
    since_.reset();
    if (pad.heartbeat) return std::nullopt;
    return pad.name +
           " streams no motion sensor. If its radio link freezes while the stick is held, the "
           "robot drives on until the system names the pad disconnected; by cable that is at once.";
  }

 private:
  static constexpr double kFirstBeat = 2.0;  ///< s

  unsigned connection_ = 0;      ///< of the pad that is known
  std::optional<double> since_;  ///< s; until it was explained
};

}  // namespace navvi_feedback::node
