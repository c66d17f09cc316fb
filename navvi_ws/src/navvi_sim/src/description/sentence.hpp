#pragma once

#include <algorithm>
#include <cctype>
#include <navvi_files/printable.hpp>
#include <navvi_types/thing.hpp>
#include <sstream>
#include <string>

namespace navvi_sim {

/// A number as sentences say it, with up to six digits.
[[nodiscard]] inline std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

[[nodiscard]] inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

using navvi_files::printable;

/// What others wrote may be long: a sentence shows its beginning.
[[nodiscard]] inline std::string shortened(const std::string& text, std::size_t most = 120) {
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

/// The classes of things, with commas between.
[[nodiscard]] inline std::string thing_class_words() {
  std::string words;
  for (const char* word : navvi_types::names(navvi_types::ThingClass{}))
    words += (words.empty() ? "" : ", ") + std::string(word);
  return words;
}

}  // namespace navvi_sim
