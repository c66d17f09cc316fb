#include "navvi_files/json.hpp"

#include <cmath>

#include "navvi_files/printable.hpp"

namespace navvi_files {
namespace {

std::string between(char open, const std::vector<std::string>& values, char close) {
  std::string text(1, open);
  for (const std::string& value : values) text += (text.size() > 1 ? ", " : "") + value;
  return text + close;
}

}  // namespace

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(c));
      out += code.data();
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string json_number(double value, int digits) {
  return std::isfinite(value) ? fixed(value, digits) : "null";
}

std::string json_list(const std::vector<std::string>& values) { return between('[', values, ']'); }

std::string json_object(const JsonFields& fields) {
  std::vector<std::string> pairs;
  for (const auto& [name, value] : fields) pairs.push_back(json_text(name) + ": " + value);
  return between('{', pairs, '}');
}

}  // namespace navvi_files
