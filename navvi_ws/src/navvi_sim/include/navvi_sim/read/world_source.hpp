#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {

/// A world, and what its source holds that could not be taken over (one sentence each).
struct LoadedWorld {
  WorldDescription world;
  std::vector<std::string> notes;
  std::map<std::string, std::string> rules = {};  ///< by thing: the pattern that gave its class
};

/// What the workers of a layout do (R-SIM-2).
enum class Workers {
  as_laid_out,  ///< as many walk and stand as the layout says
  standing,     ///< all stand; walking ones where their routes begin
  walking,      ///< all walk
};

/// What becomes of a piece of an SDF world, such as a model or a shape, that is missing or wrong.
enum class Missing {
  refuse,     ///< the world is refused, with all that is wrong
  leave_out,  ///< the world is read without it, and the notes say so
};

/// Loads and validates the world that `spec` names: a layout by the name of a preset
/// (layout_config.hpp), or a file by its ending, .yaml / .yml (layout_source.hpp and
/// yaml_world.hpp) or .sdf / .world (sdf_world.hpp). A relative path is taken from the working
/// directory.
/// \param models  folders for model://, separated by colons; may be empty. After these come
///                GAZEBO_MODEL_PATH, the world's folder, the one above it and `models` in both.
/// \param seed    of layouts; other files do not depend on it
/// \param workers  of layouts; those of other files do as their file says
/// \param classes  a file of class rules for the models of SDF (class_rules.hpp); empty: the
///                standard ones
/// \param missing  of SDF: what to do with pieces that are missing or wrong
/// \throws WorldError naming the file or thing, what is wrong and what is allowed
[[nodiscard]] LoadedWorld load_world(const std::string& spec, const std::string& models,
                                     std::uint64_t seed, Workers workers,
                                     const std::string& classes = "",
                                     Missing missing = Missing::refuse);

/// The folders of a colon separated list, and then those of GAZEBO_MODEL_PATH that exist.
/// \throws WorldError if one of the list is no folder
[[nodiscard]] std::vector<std::filesystem::path> folders(const std::string& models);

}  // namespace navvi_sim::read
