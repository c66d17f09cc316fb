#pragma once

#include <string>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {

/// 64-bit FNV-1a over every name and number of `world`, as 16 hexadecimal digits. Two worlds with
/// the same hash are, for a trial, the same world.
[[nodiscard]] std::string world_hash(const WorldDescription& world);

}  // namespace navvi_sim
