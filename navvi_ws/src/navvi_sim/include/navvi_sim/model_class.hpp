#pragma once

#include <string>

#include "navvi_sim/world_description.hpp"

namespace navvi_sim {

/// The class of a model that others named: the first rule whose word occurs in `model_name`,
/// whatever its case, and `other` if none does.
[[nodiscard]] ThingClass class_of_model(const std::string& model_name);

}  // namespace navvi_sim
