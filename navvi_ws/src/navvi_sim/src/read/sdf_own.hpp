#pragma once

#include <optional>

#include "navvi_sim/description/world_description.hpp"
#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// Whether Gazebo has no such element: those of sdf_writer.hpp.
[[nodiscard]] bool is_own(const XmlElement& element);

/// <navvi:NAME> in `element`, which is a model or a collision; nullopt where there is none.
/// \param name  "class" or "look"
/// \throws WorldError with file and line for a word that is no class
[[nodiscard]] std::optional<ThingClass> own_class(const XmlElement& element,
                                                  const std::string& name);

/// <navvi:route> in a model.
/// \throws WorldError with file and line for what is missing, not finite or unknown
[[nodiscard]] std::optional<Route> own_route(const XmlElement& model);

}  // namespace navvi_sim::read
