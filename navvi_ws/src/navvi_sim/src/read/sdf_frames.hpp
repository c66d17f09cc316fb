#pragma once

#include <Eigen/Geometry>

#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// The pose of `element`, a child of `scope`, in the frame of `scope`. A <pose> is relative to the
/// element around it, or to the model, link, frame or joint that its relative_to names there; a
/// joint's to its child, a <frame>'s to what it is attached to; a model's is that of its placement
/// frame, if it has one.
/// \throws WorldError for a frame that is not there or that depends on itself
[[nodiscard]] Eigen::Isometry3d pose_in(const XmlElement& scope, const XmlElement& element);

/// The pose of a shape (a <collision> or <visual>) in the frame of its link. Its relative_to names
/// a frame of the model around the link.
[[nodiscard]] Eigen::Isometry3d pose_in_link(const XmlElement& model, const XmlElement& link,
                                             const XmlElement& shape);

}  // namespace navvi_sim::read
