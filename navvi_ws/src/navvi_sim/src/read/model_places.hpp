#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace navvi_sim::read {

/// The folders of this machine that hold models.
struct ModelPlaces {
  std::vector<std::filesystem::path> first;  ///< given by a person or the environment
  std::vector<std::filesystem::path> last;   ///< Gazebo's own, after those beside the world
  std::vector<std::filesystem::path> fuel;   ///< caches of downloads from Fuel
};

/// The folders that exist: those given (world_source.hpp, folders()), ~/.gazebo/models,
/// /usr/share/gazebo-*/models, and Fuel's caches: GZ_FUEL_CACHE_PATH, IGN_FUEL_CACHE_PATH,
/// ~/.gz/fuel, ~/.ignition/fuel.
/// \param models  separated by colons
/// \throws WorldError if one of `models` is not a folder
[[nodiscard]] ModelPlaces model_places(const std::string& models);

/// The file or folder in a cache for HOST/[1.0/]OWNER/models/NAME[/VERSION[/files/PATH]]; without a
/// version, the newest one there. Fuel's former host means the same model.
/// \param address  of a model, without its scheme
/// \param caches   ModelPlaces::fuel
[[nodiscard]] std::optional<std::filesystem::path> find_downloaded(
    const std::string& address, const std::vector<std::filesystem::path>& caches);

/// The models of the repository, or package, around a world file: their folders' parents, by name.
/// Of a large one some are not found.
[[nodiscard]] std::map<std::string, std::filesystem::path> models_around(
    const std::filesystem::path& world_file);

/// The folders that the package.xml nearest above a world file exports to Gazebo by
/// `gazebo_model_path`.
[[nodiscard]] std::vector<std::filesystem::path> exported_folders(
    const std::filesystem::path& world_file);

}  // namespace navvi_sim::read
