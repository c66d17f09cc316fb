#pragma once

#include "geometry.hpp"

namespace navvi_nav::guide {

/// m of the first 20 m of `old` from which `fresh` is more than half a metre away: the part of the
/// route that a person has to unlearn.
[[nodiscard]] double moved_length(const Path& old, const Path& fresh);

}  // namespace navvi_nav::guide
