#pragma once

#include <vector>

#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// The models that a <population> of the world scatters, each with its name and pose. Grids and
/// rows stand as their numbers say. What Gazebo draws anew at each start is drawn here from the
/// population's name, so that the world stays the same.
/// \throws PlaceError for a population without a model, region or known distribution, and for more
/// than 1000 models
[[nodiscard]] std::vector<XmlElement> models_of(const XmlElement& population);

}  // namespace navvi_sim::read
