#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navvi_study::record {

/// A line with its end.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells);
/// The cells of one line, without its end; nullopt where quotes are not in order.
[[nodiscard]] std::optional<std::vector<std::string>> cells_of(std::string_view line);

}  // namespace navvi_study::record
