#pragma once

#include <memory>
#include <string>

#include "navvi_feedback/drive/input_state.hpp"
#include "navvi_feedback/haptics/haptics.hpp"

namespace navvi_feedback::devices {

/// The first game controller that is there, or comes (R-HAP-5). It keeps control until it is
/// detached; others are counted and ignored. One thread of its own opens, reads and pumps it: a
/// motor stops at its expiry only while somebody pumps.
class Gamepad {
 public:
  struct Status {
    bool connected = false;
    std::string name;   ///< as the pad tells it; empty if there is none
    int instance = -1;  ///< SDL's instance id; another pad, another id
    bool has_rumble = false;
    unsigned firmware = 0;          ///< 0 if unknown
    bool jolting_firmware = false;  ///< a DualSense whose firmware is known to start with a jolt
    unsigned others = 0;            ///< further pads that are ignored
    unsigned rumble_errors = 0;     ///< commands that the pad refused, since the start
    unsigned connections = 0;       ///< pads opened since the start
  };

  /// Returns once the pads that are there have been looked for.
  /// \throws DeviceError if SDL does not start
  Gamepad();
  /// Stops the motors.
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;

  /// axes: left stick x, y, right stick x, y (left and forward positive), left and right trigger
  /// [0, 1]. buttons: SDL's order: south, east, west, north, back, guide, start, sticks,
  /// shoulders, directions. Not live while no pad is connected.
  [[nodiscard]] drive::InputState input() const;
  [[nodiscard]] Status status() const;

  /// Turns the motors until the next call, but no longer than 300 ms. Returns at once. Values are
  /// clamped to [0, 1]; one that is not finite counts as 0.
  void rumble(const haptics::Rumble& rumble);

 private:
  class Pump;
  std::unique_ptr<Pump> pump_;
};

}  // namespace navvi_feedback::devices
