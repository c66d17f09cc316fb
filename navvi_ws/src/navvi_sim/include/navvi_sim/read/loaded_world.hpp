#pragma once

#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {

/// A world, and what its source holds that could not be taken over (one sentence each).
struct LoadedWorld {
  WorldDescription world;
  std::vector<std::string> notes;
};

/// What the workers of a layout do (R-SIM-2).
enum class Workers {
  as_laid_out,  ///< as many walk and stand as the layout says
  standing,     ///< all stand; walking ones where their routes begin
  walking,      ///< all walk
};

/// What becomes of a piece of an SDF world, such as a model or a shape, that is missing or wrong.
enum class Missing {
  refuse,     ///< the world is refused, with all that is wrong
  leave_out,  ///< the world is read without it, and the notes say so
};

}  // namespace navvi_sim::read
