#pragma once

#include <optional>
#include <string>

#include "devices/gamepad.hpp"

namespace navvi_feedback::node {

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
