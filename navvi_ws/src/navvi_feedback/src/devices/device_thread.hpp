#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::devices {

/// A device that wants to be opened, read and closed in one thread, as SDL's do.
class ThreadedDevice {
 public:
  /// \throws DeviceError if it cannot be used
  virtual void open() = 0;
  /// nullopt once the device is gone for good.
  [[nodiscard]] virtual std::optional<drive::InputState> read() = 0;
  virtual void close() = 0;

 protected:
  ~ThreadedDevice() = default;
};

/// Opens a device, reads it period by period, and closes it, in a thread of its own.
class DeviceThread {
 public:
  /// Returns once the device was read for the first time.
  /// \param device  outlives this \throws DeviceError as its open() does
  DeviceThread(ThreadedDevice& device, std::chrono::milliseconds period);
  ~DeviceThread();
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  /// What was read last. Not live if that is more than 250 ms ago: a thread that hangs has frozen
  /// values, and they must not drive the robot.
  [[nodiscard]] drive::InputState input() const;

  /// Reads the device now, whatever is left of the period.
  void wake();

 private:
  void store(const drive::InputState& input);
  /// \return false at the end
  [[nodiscard]] bool rest(std::chrono::milliseconds period);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool quit_ = false;
  bool woken_ = false;
  drive::InputState input_;
  std::chrono::steady_clock::time_point read_time_{};
  std::thread thread_;
};

}  // namespace navvi_feedback::devices
