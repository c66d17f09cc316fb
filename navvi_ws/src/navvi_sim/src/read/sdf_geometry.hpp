#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "read/sdf_files.hpp"
#include "read/sdf_notes.hpp"
#include "read/xml_element.hpp"

namespace navvi_sim::read {

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
  SdfShapes(const SdfFiles& files, SdfNotes& notes) : files_(files), notes_(notes) {}

  /// \param pose  of the shape, in the thing's frame
  /// \throws WorldError for a size that is not finite, not above 0 or too large, and for a mesh
  /// that is missing or broken
  [[nodiscard]] SdfGeometry read(const XmlElement& geometry, const Eigen::Isometry3d& pose);

 private:
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(const XmlElement& mesh);

  const SdfFiles& files_;
  SdfNotes& notes_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace navvi_sim::read
