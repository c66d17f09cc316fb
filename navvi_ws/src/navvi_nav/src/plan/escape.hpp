#pragma once

#include <navvi_floor/floor.hpp>
#include <optional>

#include "mesh/mesh.hpp"

namespace navvi_nav::plan {

/// True if a robot at `place` is nearer than `radius` to a cylinder: it stands in its hole.
[[nodiscard]] bool in_a_hole(Point place, const map::Space& space, double radius);

/// The end of the shortest good straight leg out of the holes in which a robot at `start` stands.
/// The leg comes no nearer to any cylinder than `start` is, nor nearer than `radius` to one that
/// `start` is clear of, and keeps `radius` from the map, or what room there is at `start`. It leads
/// on in front of a moving cylinder only if there is no other.
/// \param part  if given, only this part of the mesh counts \param towards  of legs of nearly
/// equal length the one that ends nearer to here is taken \returns nullopt if there is none of at
/// most 4 m
[[nodiscard]] std::optional<mesh::Mesh::Place> escape(const mesh::Mesh& mesh,
                                                      const map::Space& space, Point start,
                                                      double radius, std::optional<int> part,
                                                      Point towards);

}  // namespace navvi_nav::plan
