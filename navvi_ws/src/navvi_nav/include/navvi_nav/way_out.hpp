#pragma once

#include <optional>

#include "navvi_nav/floor.hpp"
#include "navvi_nav/mesh.hpp"

namespace navvi_nav {

/// True if a robot at `place` is nearer than `radius` to a cylinder: it stands in its hole.
[[nodiscard]] bool in_a_hole(Point place, const Space& space, double radius);

/// Where the shortest good straight way out of the holes ends in which a robot at `start` stands.
/// On the way it comes no nearer to any cylinder than it is, nor nearer than `radius` to one that
/// it is clear of, and keeps `radius` from the map, or what room it has there now. It leads on
/// before something that moves only if there is no other.
/// \param part  if given, only this part of the mesh counts \param towards  of ways out of nearly
/// equal length the one nearer to here is taken \returns nullopt if there is none of at most 4 m
[[nodiscard]] std::optional<Mesh::Place> way_out(const Mesh& mesh, const Space& space, Point start,
                                                 double radius, std::optional<int> part,
                                                 Point towards);

}  // namespace navvi_nav
