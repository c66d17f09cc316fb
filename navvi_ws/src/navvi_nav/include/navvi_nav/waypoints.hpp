#pragma once

#include "navvi_nav/smoothing.hpp"

namespace navvi_nav {

/// Moves each corner outwards, to the far side of its turn, by up to room.preferred, as far as the
/// legs stay clear. A path that hugs corners is hard to follow by ear.
[[nodiscard]] Path push_corners(const Path& path, const Space& space, const Room& room);

/// Points at most `spacing` m apart, the corners of `path` among them.
[[nodiscard]] Path dense(const Path& path, double spacing);

/// A place where a path may turn; a path visits stations in rising order.
struct Candidate {
  Point point;
  int station = 0;
};

/// The points of `path` as stations, and beside each point but the ends further candidates across
/// the path, up to room.preferred away, as far as the straight way there is clear.
[[nodiscard]] std::vector<Candidate> candidates_along(const Path& path, const Space& space,
                                                      const Room& room);

/// The cheapest path from the first candidate to the last through some of the others: guide_cost
/// plus turn_price for each corner. Legs that are not clear are not used; empty if there is no
/// such path.
[[nodiscard]] Path choose_waypoints(const std::vector<Candidate>& candidates, const Space& space,
                                    const Room& room, const SmoothingConfig& config);

/// True if every leg keeps `radius` m.
[[nodiscard]] bool clear(const Path& path, const Space& space, double radius);

}  // namespace navvi_nav
