#include "navvi_types/scenario.hpp"

#include <cinttypes>
#include <cstdio>

namespace navvi_types {

std::string to_hex(std::uint64_t number) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016" PRIx64, number);
  return text.data();
}

}  // namespace navvi_types
