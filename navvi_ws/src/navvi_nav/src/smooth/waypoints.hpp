#pragma once

#include "smooth/channel.hpp"
#include "smooth/smoothing.hpp"

namespace navvi_nav::smooth {

/// The cheapest path through the channel from end to end, its corners on samples of the rungs:
/// guide_cost, as measured on the rungs, plus turn_price for each corner and up to as much again
/// for each leg shorter than short_leg. Clear by `radius`: where a leg comes too near to something
/// between the rungs, the channel is narrowed there and the choice made again, a few times. Empty
/// if that does not help.
[[nodiscard]] Path choose_waypoints(Channel channel, const map::Space& space, double radius,
                                    const SmoothingConfig& config);

/// True if every leg keeps `radius` m.
[[nodiscard]] bool clear(const Path& path, const map::Space& space, double radius);

}  // namespace navvi_nav::smooth
