#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "navvi_sim/world_description.hpp"
#include "navvi_sim/world_error.hpp"

namespace navvi_sim {

/// Reads all triangles of a mesh file as one mesh in metres, z up, as Gazebo takes it: Collada's
/// unit and up_axis are applied, other formats (STL, OBJ) are metres and z up already.
/// \param scale  of x, y, z, as in SDF; not 0
/// \throws WorldError if the file is missing, larger than 200 MB, unreadable, without triangles,
/// or holds a number that is not finite
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const Eigen::Vector3d& scale);

}  // namespace navvi_sim
