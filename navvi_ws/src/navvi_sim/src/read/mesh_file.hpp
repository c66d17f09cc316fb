#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {

/// What is taken of a mesh file, as SDF's <mesh> says it.
struct MeshPart {
  std::string name;      ///< of the node or geometry; empty: all of the file
  bool centred = false;  ///< moved so that the middle of its bounds is the origin
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of x, y, z; finite and not 0
};

/// Reads the triangles of a mesh file as one mesh in metres, as Gazebo takes it: z is up, Collada's
/// <unit> is applied and its <up_axis> is not (gazebo-classic #1305), so that a world stands
/// here as it stands there. Other formats (STL, OBJ) are metres already.
/// No other file is opened, also not those that this one names. A process of its own reads it, with
/// at most 2 GB and 20 s of the processor.
/// \throws WorldError if the file is missing, no .dae, .stl or .obj, larger than 200 MB, unreadable,
/// without triangles or without a part of that name, has more than a million of them, or holds a
/// number that is out of WorldLimits or an index out of range
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const MeshPart& part);

}  // namespace navvi_sim::read
