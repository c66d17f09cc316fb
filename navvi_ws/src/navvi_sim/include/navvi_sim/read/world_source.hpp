#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "navvi_sim/read/loaded_world.hpp"

namespace navvi_sim::read {

/// Which world is wanted.
struct WorldRequest {
  /// A layout by the name of a preset (layout_config.hpp), or a file by its ending: .yaml / .yml
  /// for a layout (layout_source.hpp), .sdf / .world for SDF (sdf_world.hpp). A relative path is
  /// taken from the working directory.
  std::string spec;
  /// Folders for model://, separated by colons. After these come the folders of the environment
  /// (folders()), the world's folder, the one above it and `models` in both, and Gazebo's own.
  std::string models = {};
  std::uint64_t seed = 1;                  ///< of layouts; SDF does not depend on it
  Workers workers = Workers::as_laid_out;  ///< of layouts; those of SDF do as their file says
  std::string classes = {};  ///< a file of class rules for SDF (class_rules.hpp); empty: standard
  Missing missing = Missing::refuse;  ///< of SDF
};

/// Loads and validates a world.
/// \throws WorldError naming the file or thing, what is wrong and what is allowed
[[nodiscard]] LoadedWorld load_world(const WorldRequest& request);

/// The folders of a colon separated list, and then those of GAZEBO_MODEL_PATH,
/// GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH and SDF_PATH that exist.
/// \throws WorldError if one of the list is no folder
[[nodiscard]] std::vector<std::filesystem::path> folders(const std::string& models);

}  // namespace navvi_sim::read
