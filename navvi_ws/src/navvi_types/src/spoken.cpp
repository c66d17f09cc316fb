#include "navvi_types/spoken.hpp"

#include <cctype>

namespace navvi_types {
namespace {

constexpr std::size_t kMaxBytes = 80;

/// The bytes of the letter or digit at `at`; 0 if there is none, or no UTF-8.
std::size_t character(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return std::isalnum(static_cast<int>(first)) != 0 ? 1 : 0;
  const unsigned second = byte(at + 1);
  if (first < 0xC3 || first > 0xD3 || (second & 0xC0U) != 0x80) return 0;  // two bytes, U+00C0 on
  const unsigned code = (first & 0x1FU) << 6U | (second & 0x3FU);
  const bool latin = code <= 0x24F && code != 0xD7 && code != 0xF7;  // without the signs of sums
  const bool greek = code >= 0x386 && code <= 0x3FF && code != 0x387;
  const bool cyrillic = code >= 0x400 && code <= 0x4FF && (code < 0x482 || code > 0x489);
  return latin || greek || cyrillic ? 2 : 0;
}

}  // namespace

bool speakable(const std::string& text) {
  if (text.empty() || text.size() > kMaxBytes) return false;
  std::size_t word = 0;
  bool letters = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = character(text, at);
    const bool mark = std::string(" ,.'-").find(text[at]) != std::string::npos && text[at] != '\0';
    if (bytes == 0 && !mark) return false;
    word = text[at] == ' ' ? 0 : word + std::max<std::size_t>(bytes, 1);
    if (word > kMaxWord) return false;
    letters = letters || bytes > 0;
    at += std::max<std::size_t>(bytes, 1);
  }
  return letters;
}

bool is_place_name(const std::string& text) {
  if (!speakable(text) || text.size() > kMaxName) return false;
  if (text.find_first_of(",.'-") != std::string::npos) return false;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (end == begin || end - begin > kMaxNameWord) return false;
    begin = end + 1;
  }
  return true;
}

}  // namespace navvi_types
