#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// The numbers of an element's text.
/// \throws WorldError if they are not `count` finite numbers
[[nodiscard]] std::vector<double> numbers(const XmlElement& element, std::size_t count);

[[nodiscard]] double number(const XmlElement& element);
[[nodiscard]] Eigen::Vector3d vector3(const XmlElement& element);

/// A child that must be there.
/// \throws WorldError if it is not
[[nodiscard]] const XmlElement& required(const XmlElement& element, const std::string& child);

/// The number in a child that must be there, > 0 and up to 1000 m.
[[nodiscard]] double length(const XmlElement& element, const std::string& child);
/// Each as above.
[[nodiscard]] Eigen::Vector3d lengths(const XmlElement& element, const std::string& child);

/// The truth of a child's text, "true" or "1"; `otherwise` if there is no child.
/// \throws WorldError if it is something else than true, false, 1 and 0
[[nodiscard]] bool flag(const XmlElement& element, const std::string& child, bool otherwise);

/// What a <pose> says: x y z and roll pitch yaw, or what its rotation_format and degrees say; an
/// empty one is the identity.
[[nodiscard]] Eigen::Isometry3d pose_value(const XmlElement& pose);

}  // namespace navvi_sim::read
