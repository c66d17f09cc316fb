#pragma once

#include <filesystem>
#include <vector>

#include "navvi_sim/world_source.hpp"

namespace navvi_sim {

/// Reads a world in Gazebo's SDF by its collision geometry. One thing a top-level model, standing
/// still, classed by its name (model_class.hpp). `model://` is looked for in `models`, then beside
/// the world file. `floor_height` is that of the largest level surface of the floor models.
///
/// Not taken over, and listed in the notes by name: shapes the simulator has not (capsule,
/// polyline, height map, ...), models without collision geometry, actors, lights' bodies, plugins,
/// joints' motion, and models that lie wholly under the floor.
/// \throws WorldError for a file that is missing or no SDF world, and for a model or mesh that is
/// missing, unreadable, or includes itself
[[nodiscard]] LoadedWorld read_sdf_world(const std::filesystem::path& file,
                                         const std::vector<std::filesystem::path>& models);

}  // namespace navvi_sim
