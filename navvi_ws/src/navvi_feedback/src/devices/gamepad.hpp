#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "drive/press_counter.hpp"
#include "haptics/haptics.hpp"
#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::devices {

/// The first game controller that is there, or comes (R-HAP-5). It keeps control until it is
/// detached; others are counted and ignored. A thread of its own opens, reads and updates it: SDL
/// stops a motor at its expiry only while it is updated.
/// A stick that is held still sends nothing, and a radio link may freeze long before the system
/// names the pad detached. A pad with a motion sensor is asked to stream it, as a heartbeat: once
/// the stream has begun, its end is the loss of the pad.
class Gamepad {
 public:
  struct Status {
    bool connected = false;
    std::string name;               ///< as the pad reports it; empty if there is none
    std::string guid;               ///< SDL's, of this model, in hexadecimal digits; likewise
    bool has_rumble = false;        ///< and obeyed the last command to it
    bool heartbeat = false;         ///< the stream of its motion sensor has begun
    bool silent = false;            ///< and has ceased, though the pad is attached
    unsigned firmware = 0;          ///< 0 if unknown
    bool jolting_firmware = false;  ///< a DualSense whose firmware is known to start with a jolt
    unsigned others = 0;            ///< further pads that are ignored
    unsigned rumble_errors = 0;     ///< commands that the pad refused, since the start
    unsigned connections = 0;       ///< pads opened since the start

    [[nodiscard]] bool answers() const { return connected && !silent; }
    /// Its motors can be felt.
    [[nodiscard]] bool felt() const { return answers() && has_rumble; }
  };

  /// Returns once the pads that are there have been looked for.
  /// \throws DeviceError if SDL does not start
  Gamepad();
  /// Stops the motors.
  ~Gamepad();

  /// axes: left stick x, y, right stick x, y (left and forward positive), left and right trigger
  /// [0, 1]. buttons: SDL's order: south, east, west, north, back, guide, start, sticks,
  /// shoulders, directions. Not live while no pad is connected, while it is silent, or if its
  /// thread read it more than 250 ms ago: values that a hanging thread left must not drive.
  [[nodiscard]] drive::InputState input() const;
  [[nodiscard]] Status status() const;

  /// Turns the motors until the next call, but no longer than 300 ms. Returns at once. Values are
  /// clamped to [0, 1]; one that is not finite counts as 0.
  /// \param called  in the pad's thread, once the driver was told, if that is another command
  void rumble(const haptics::Rumble& rumble, std::function<void()> called = {});

 private:
  /// The pad that is open, and the last values of its motors. Used by the thread alone.
  class Pad;

  void run(std::promise<void> started);
  /// Until the period is over or there is something to do. \return false at the end
  [[nodiscard]] bool rest();
  void read();
  void scan();
  void take_pad(int index);
  void hear_pad(std::chrono::steady_clock::time_point now);
  void forget_pad();
  void move_motors(std::chrono::steady_clock::time_point now);

  std::unique_ptr<Pad> pad_;                         ///< the thread's own
  std::chrono::steady_clock::time_point scanned_{};  ///< the thread's own
  unsigned session_ = 0;                             ///< the thread's own
  drive::PressCounter counter_;                      ///< the thread's own

  mutable std::mutex mutex_;
  Status status_;
  haptics::Rumble wish_;
  std::chrono::steady_clock::time_point wish_time_{};
  std::function<void()> called_;  ///< of the first wish that the thread has not seen
  std::condition_variable changed_;
  bool quit_ = false;
  bool woken_ = false;
  drive::InputState input_;
  std::chrono::steady_clock::time_point read_time_{};

  std::thread thread_;  ///< the last, for it uses all the others
};

}  // namespace navvi_feedback::devices
