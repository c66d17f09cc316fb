#pragma once

#include <sstream>
#include <string>

namespace navvi_sim {

/// A number as sentences say it, with up to six digits.
[[nodiscard]] inline std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

}  // namespace navvi_sim
