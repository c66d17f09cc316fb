#pragma once

#include <navvi_files/cache.hpp>
#include <optional>

#include "plan/nav_mesh.hpp"

namespace navvi_nav::plan {

/// NavMesh::bake of a first map, or what it once was of the same map with the same config.
[[nodiscard]] bake::BakedMap kept_bake(const NavMesh& mesh, const map::Voxels& map,
                                       std::optional<double> stands_at,
                                       const navvi_files::Cache& cache);

}  // namespace navvi_nav::plan
