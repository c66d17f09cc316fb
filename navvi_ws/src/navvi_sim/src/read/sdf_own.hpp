#pragma once

#include <optional>

#include "navvi_sim/description/world_description.hpp"
#include "read/xml_element.hpp"

namespace navvi_sim::read {

// What SDF has no word for stands in elements of our own, which Gazebo passes over, such as
//
//     <navvi:class>pallet_robot</navvi:class>             in a model
//     <navvi:route speed="0.7" loop="true" delay="0" yields="true">
//       <navvi:waypoint pause="4" speed="0">1 2</navvi:waypoint>   m in map, s, m/s
//     </navvi:route>
//     <navvi:look>box</navvi:look>                        in a collision

/// Whether it is one of these.
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
