#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <navvi_types/trial.hpp>
#include <string>
#include <vector>

namespace navvi_feedback::menu {

struct NamedPlace {
  std::string name;                              ///< as cues::is_place_name() allows
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, in map
  navvi_types::TrialState::Task task = navvi_types::TrialState::Task::drive;  ///< of a job, there
};

/// More, one after the other, nobody listens to.
constexpr std::size_t kMostPlaces = 100;

/// A YAML list of {name, x, y}; x and y in m, in map, and, of a job, what is to `do` there: pick,
/// drop or scan. An empty file has no places.
/// \return in the order of the file \throws navvi_config::ConfigError with file, line and key on an
/// unknown, missing or repeated key, a name that cannot be spoken or comes twice, a number that is
/// not finite or out of range, or more than kMostPlaces places
[[nodiscard]] std::vector<NamedPlace> read_places(const std::filesystem::path& path);

/// Puts places at the end of such a file, and leaves what is in it as it is. Whatever happens, the
/// file holds the old places or the new ones, too, as a whole. \throws std::runtime_error with a
/// sentence if it cannot be read or written, or would not be allowed with them
void add_places(const std::filesystem::path& path, const std::vector<NamedPlace>& places);

/// Names that differ in capital letters alone sound the same.
[[nodiscard]] bool sound_alike(const std::string& a, const std::string& b);

}  // namespace navvi_feedback::menu
