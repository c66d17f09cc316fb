#pragma once

#include <string>

namespace navvi_config {

/// So much of a value or key as tells which one is meant: an error cites no file.
[[nodiscard]] std::string cited(const std::string& text);

}  // namespace navvi_config
