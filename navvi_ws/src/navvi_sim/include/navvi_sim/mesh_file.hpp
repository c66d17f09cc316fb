#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "navvi_sim/world_description.hpp"
#include "navvi_sim/world_error.hpp"

namespace navvi_sim {

/// Reads all triangles of a mesh file as one mesh in metres, as Gazebo takes it: z is up, Collada's
/// <unit> is applied and its <up_axis> is not (gazebo-classic #1305), so that a world stands
/// here as it stands there. Other formats (STL, OBJ) are metres already.
/// \param scale  of x, y, z, as in SDF; not 0
/// \throws WorldError if the file is missing, larger than 200 MB, unreadable, without triangles,
/// or holds a number that is not finite
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const Eigen::Vector3d& scale);

}  // namespace navvi_sim
