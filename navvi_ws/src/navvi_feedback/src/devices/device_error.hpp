#pragma once

#include <stdexcept>

namespace navvi_feedback::devices {

/// A sentence on a pad, keyboard or voice that cannot be used.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace navvi_feedback::devices
