#pragma once

#include <cstdint>
#include <string>

#include "generate/layout_config.hpp"
#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::generate {

/// A warehouse built from `config` (R-SIM-1 to R-SIM-3): its middle is the origin, its floor z = 0,
/// its docks in the south. The same config and seed give the same world, number by number.
///
/// Every place that one can drive to is connected to every other. Everything that moves has a
/// stretch of its route to itself, in which it stands at time zero and can wait for others that
/// cross the rest. \throws LayoutError if the config contradicts itself or asks for more than there
/// is room for
[[nodiscard]] WorldDescription layout(const std::string& name, const LayoutConfig& config,
                                      std::uint64_t seed);

}  // namespace navvi_sim::generate
