#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "read/sdf_files.hpp"
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

/// An endless level plane.
struct SdfPlane {
  Eigen::Vector3d normal;
  Eigen::Isometry3d pose;
};

/// What one <geometry> comes to: one shape or several, or a plane, or nothing.
struct SdfGeometry {
  std::vector<Shape> shapes;
  std::vector<SdfPlane> planes;
};

/// Reads the shapes of SDF. A capsule becomes a cylinder and two spheres, an ellipsoid and a
/// polyline become meshes.
class SdfShapes {
 public:
  explicit SdfShapes(const SdfFiles& files) : files_(files) {}

  /// \param pose  of the shape, in the thing's frame
  /// \param scale  of its sizes, as Gazebo's SetScale takes it: it replaces the scale of a mesh
  /// \throws WorldError for a size that is not finite, not above 0 or too large, and for a mesh
  /// that is missing or broken, and for a shape that is not known, such as a height map
  [[nodiscard]] SdfGeometry read(const XmlElement& geometry, const Eigen::Isometry3d& pose,
                                 const Eigen::Vector3d& scale);

 private:
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(const XmlElement& mesh,
                                                 const Eigen::Vector3d& scale);

  struct Known {
    std::shared_ptr<const Mesh> mesh;
    std::string fault;  ///< where there is none
  };

  const SdfFiles& files_;
  std::map<std::string, Known> meshes_;
};

}  // namespace navvi_sim::read
