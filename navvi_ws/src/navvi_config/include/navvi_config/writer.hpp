#pragma once

#include <functional>
#include <string>

#include "navvi_config/field.hpp"

namespace navvi_config {

/// The shortest text that is read back as the same number.
[[nodiscard]] std::string exact(double number);

[[nodiscard]] std::string write_fields(const std::function<void(Visitor&)>& describe);

/// Every field of `config` as YAML that read() takes back bit for bit.
template <typename Config>
[[nodiscard]] std::string write(Config config) {
  return write_fields([&](Visitor& visit) { config.describe(visit); });
}

}  // namespace navvi_config
