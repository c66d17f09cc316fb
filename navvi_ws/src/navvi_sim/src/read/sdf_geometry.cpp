#include "read/sdf_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "description/solid_mesh.hpp"
#include "description/validate.hpp"
#include "read/mesh_file.hpp"
#include "read/sdf_value.hpp"

namespace navvi_sim::read {
namespace {

Eigen::Isometry3d lifted(const Eigen::Isometry3d& pose, double height) {
  return pose * Eigen::Translation3d(0.0, 0.0, height);
}

std::vector<Shape> capsule(const XmlElement& capsule, const Eigen::Isometry3d& pose) {
  const double radius = length(capsule, "radius");
  const double straight = length(capsule, "length");
  return {{Cylinder{radius, straight}, pose},
          {Sphere{radius}, lifted(pose, straight / 2.0)},
          {Sphere{radius}, lifted(pose, -straight / 2.0)}};
}

Geometry ellipsoid(const XmlElement& ellipsoid) {
  const Eigen::Vector3d radii = lengths(ellipsoid, "radii");
  if (radii.maxCoeff() - radii.minCoeff() < 1e-9) return Sphere{radii.x()};
  return std::make_shared<const Mesh>(ellipsoid_mesh(radii));
}

std::vector<Eigen::Vector2d> outline(const XmlElement& polyline) {
  std::vector<Eigen::Vector2d> points;
  for (const XmlElement* point : polyline.children_named("point")) {
    const std::vector<double> xy = numbers(*point, 2);
    if (std::max(std::abs(xy[0]), std::abs(xy[1])) > WorldLimits::extent)
      refuse(*point, "<point> is " + point->text + "; allowed are up to 1000 m");
    points.emplace_back(xy[0], xy[1]);
  }
  return points;
}

}  // namespace

SdfGeometry SdfShapes::read(const XmlElement& geometry, const Eigen::Isometry3d& pose) {
  SdfGeometry result;
  for (const XmlElement& kind : geometry.children) {
    if (kind.name == "box") {
      result.shapes.push_back({Box{lengths(kind, "size")}, pose});
    } else if (kind.name == "cylinder") {
      result.shapes.push_back({Cylinder{length(kind, "radius"), length(kind, "length")}, pose});
    } else if (kind.name == "sphere") {
      result.shapes.push_back({Sphere{length(kind, "radius")}, pose});
    } else if (kind.name == "capsule") {
      for (Shape& part : capsule(kind, pose)) result.shapes.push_back(std::move(part));
    } else if (kind.name == "ellipsoid") {
      result.shapes.push_back({ellipsoid(kind), pose});
    } else if (kind.name == "polyline") {
      const auto prism = prism_mesh(outline(kind), length(kind, "height"));
      if (!prism)
        refuse(kind,
               "<polyline> is no outline with an inside; allowed are 3 to 300 points, not "
               "all on one line, whose sides do not cross");
      result.shapes.push_back({std::make_shared<const Mesh>(*prism), pose});
    } else if (kind.name == "mesh") {
      result.shapes.push_back({mesh(kind), pose});
    } else if (kind.name == "plane") {
      const XmlElement* normal = kind.child("normal");
      result.planes.push_back({normal ? vector3(*normal) : Eigen::Vector3d::UnitZ(), pose});
    } else if (kind.name != "empty") {
      notes_.add(kind, "the shape <" + kind.name +
                           "> is not taken over; known are box, cylinder, sphere, capsule, "
                           "ellipsoid, polyline, mesh and plane");
    }
  }
  return result;
}

std::shared_ptr<const Mesh> SdfShapes::mesh(const XmlElement& mesh) {
  const XmlElement& uri = required(mesh, "uri");
  const auto found = files_.find(uri.text, *mesh.file);
  if (!found)
    refuse(uri, "the mesh " + uri.text + " is not there; looked in " + files_.looked_in() +
                    " (give its folder as models)");
  MeshPart part;
  if (const XmlElement* scale = mesh.child("scale")) part.scale = vector3(*scale);
  if (const XmlElement* submesh = mesh.child("submesh")) {
    part.name = required(*submesh, "name").text;
    part.centred = flag(*submesh, "center", false);
  }
  std::ostringstream key;
  key << found->string() << '|' << part.name << '|' << part.centred << '|'
      << part.scale.transpose();
  auto& shared = meshes_[key.str()];
  try {
    if (!shared) shared = std::make_shared<const Mesh>(read_mesh(*found, part));
  } catch (const WorldError& error) {
    refuse(mesh, error.what());
  }
  return shared;
}

}  // namespace navvi_sim::read
