#pragma once

#include "navvi_nav/smoothing.hpp"

namespace navvi_nav {

/// Moves each corner outwards, to the far side of its turn, by up to room.preferred, as far as the
/// legs stay clear. A path that hugs corners is hard to follow by ear.
[[nodiscard]] Path push_corners(const Path& path, const Space& space, const Room& room);

/// Points at most `spacing` m apart, the corners of `path` among them.
[[nodiscard]] Path dense(const Path& path, double spacing);

/// The cheapest path through some of `candidates`, in order, ends included: guide_cost plus
/// turn_price for each corner. Legs that are not clear are not used; where two neighbours are not
/// joined by a clear leg the result is empty.
[[nodiscard]] Path choose_waypoints(const Path& candidates, const Space& space, const Room& room,
                                    const SmoothingConfig& config);

/// True if every leg keeps `radius` m.
[[nodiscard]] bool clear(const Path& path, const Space& space, double radius);

}  // namespace navvi_nav
