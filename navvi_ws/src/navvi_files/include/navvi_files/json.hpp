#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navvi_files {

/// What one program prints for another. Values are JSON already.
using JsonFields = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] std::string json_text(std::string_view text);
/// \param digits  after the point
/// \return null where the value is not finite
[[nodiscard]] std::string json_number(double value, int digits = 6);
[[nodiscard]] std::string json_list(const std::vector<std::string>& values);
[[nodiscard]] std::string json_object(const JsonFields& fields);

}  // namespace navvi_files
