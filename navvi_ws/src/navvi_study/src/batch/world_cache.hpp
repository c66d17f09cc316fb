#pragma once

#include <cstdint>
#include <navvi_files/cache.hpp>
#include <optional>

namespace navvi_study::batch {

/// What trials keep of their worlds for other trials of this build on this kind of processor, in
/// XDG_CACHE_HOME/navvi/worlds or ~/.cache/navvi/worlds. \param megabytes  MB, at most
/// \return nullopt where nothing can be kept: there is no room, no such folder, or no build ID
[[nodiscard]] std::optional<navvi_files::Cache> world_cache(std::uintmax_t megabytes);

}  // namespace navvi_study::batch
