#pragma once

#include <string>

#include "navvi_sim/read/loaded_world.hpp"

namespace navvi_sim::read {

/// What stands and moves in a world, one line a thing: name, class, the rule that gave the class,
/// shapes, position (m, in map), and its route if it has one.
/// \param most  lines; of more things the rest is counted in a last line
[[nodiscard]] std::string thing_table(const LoadedWorld& loaded, std::size_t most);

}  // namespace navvi_sim::read
