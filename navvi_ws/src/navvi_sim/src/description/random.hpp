#pragma once

#include <navvi_types/random.hpp>

namespace navvi_sim {
using navvi_types::Random;
}  // namespace navvi_sim
