#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace navvi_feedback::menu {

/// A place that the people on site have named.
struct NamedPlace {
  std::string name;                              ///< as cues::is_place_name() allows
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, in map
};

/// A YAML list of {name, x, y, yaw}; x and y in m, yaw in rad, in map. yaw may be left out: it is
/// checked, but the guide leads to a place whatever the heading.
/// \return in the order of the file \throws navvi_config::ConfigError with file, line and key on an
/// unknown, missing or repeated key, a name that cannot be spoken or comes twice, a number that is
/// not finite or out of range, or more than 100 places
[[nodiscard]] std::vector<NamedPlace> read_places(const std::filesystem::path& path);

}  // namespace navvi_feedback::menu
