#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "generate/layout_source.hpp"
#include "navvi_sim/read/loaded_world.hpp"

namespace navvi_sim::read {

/// As load_world of world_source.hpp, of a layout that was read, and perhaps changed, before.
[[nodiscard]] LoadedWorld load_world(const generate::LayoutSource& source, std::uint64_t seed,
                                     Workers workers);

/// The layout that `spec` names, not built yet; nullopt if it names another kind of world.
/// \throws WorldError as load_world does
[[nodiscard]] std::optional<generate::LayoutSource> layout_source(const std::string& spec);

}  // namespace navvi_sim::read
