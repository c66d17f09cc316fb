#pragma once

#include <cstddef>

namespace navvi_nav {

/// How often this program asked for memory so far; operator new is replaced to count.
[[nodiscard]] std::size_t allocations();

}  // namespace navvi_nav
