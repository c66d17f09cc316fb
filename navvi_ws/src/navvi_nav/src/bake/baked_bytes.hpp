#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bake/map_bake.hpp"

namespace navvi_nav::bake {

/// A map without one before: its floor and its tiles, but not what the next map is compared with,
/// which is then surveyed and baked as a whole.
[[nodiscard]] std::string to_bytes(const BakedMap& baked);
/// All tiles are rebuilt ones, as of a first map. \param threads  that may share the work
/// \returns nullopt if the bytes are not of to_bytes()
[[nodiscard]] std::optional<BakedMap> from_bytes(std::string_view bytes, int threads);

}  // namespace navvi_nav::bake
