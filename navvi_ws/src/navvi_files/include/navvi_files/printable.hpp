#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace navvi_files {

/// \param digits  after the point
[[nodiscard]] inline std::string fixed(double value, int digits) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

/// Sentences and names reach terminals and tables, and may cite what others wrote: a control
/// character becomes a blank. \param lines  whether line ends stay
[[nodiscard]] inline std::string printable(std::string text, bool lines = false) {
  const auto is_control = [lines](unsigned char c) {
    return (c < ' ' && !(lines && c == '\n')) || c == 0x7f;
  };
  std::replace_if(text.begin(), text.end(), is_control, ' ');
  return text;
}

}  // namespace navvi_files
