#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "process/frame.hpp"

namespace navvi_feedback::process {

/// A program of a device in a process of its own: whatever ends or hangs there, stick, motors and
/// wheels go on here. It ends with this object.
class Child {
 public:
  /// Starts it, and returns at once. One that does not start is gone().
  /// \param program  a file in the folder of this process's own program
  Child(const std::string& program, std::vector<std::string> arguments);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for nothing. \return false if the process is gone, or has not read for long
  [[nodiscard]] bool send(std::int32_t value, std::string_view bytes) const;
  /// As receive() of frame.hpp.
  [[nodiscard]] std::optional<Frame> receive(Clock::time_point until) const;
  /// Whether the process has ended; what it sent before may still be received.
  [[nodiscard]] bool gone();

 private:
  int socket_ = -1;
  pid_t id_ = -1;  ///< -1: it has ended, or never began
};

}  // namespace navvi_feedback::process
