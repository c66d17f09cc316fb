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

constexpr int kMaxFrames = 64;  // in a row

/// What `name` names in a scope, and the merged model it stands in, or the scope.
struct Named {
  const XmlElement* scope = nullptr;
  const XmlElement* element = nullptr;
};

Named find(const XmlElement& scope, const std::string& name) {
  for (const char* kind : {"model", "link", "frame", "joint", "actor"})
    for (const XmlElement& child : scope.children)
      if (child.name == kind && child.attribute("name") == name) return {&scope, &child};
  // What was merged into a model goes by its own name there.
  for (const XmlElement& child : scope.children)
    if (child.name == "model" && !child.attribute("merge").empty())
      if (const Named inner = find(child, name); inner.element != nullptr) return inner;
  return {};
}

/// SDF 1.6 called it `frame`.
std::string relative_to(const XmlElement& pose) {
  const std::string base = pose.attribute("relative_to");
  return base.empty() ? pose.attribute("frame") : base;
}

Eigen::Isometry3d pose_of(const XmlElement& scope, const XmlElement& element, int depth);

/// The pose of the frame `name` in the frame of `scope`; "a::b" is b in a.
Eigen::Isometry3d frame_named(const XmlElement& scope, const std::string& name,
                              const XmlElement& asking, int depth) {
  if (depth > kMaxFrames)
    refuse(asking, "the frame '" + name + "' depends on itself, or on more than " +
                       std::to_string(kMaxFrames) + " others; allowed are frames with an end");
  if (name == "world" || name == "__model__" || name == "__root__")
    return Eigen::Isometry3d::Identity();
  if (const Named named = find(scope, name); named.element != nullptr) {
    const Eigen::Isometry3d pose = pose_of(*named.scope, *named.element, depth + 1);
    return named.scope == &scope ? pose : pose_of(scope, *named.scope, depth + 1) * pose;
  }
  for (std::size_t split = name.find("::"); split != std::string::npos;
       split = name.find("::", split + 2)) {
    const Named outer = find(scope, name.substr(0, split));
    if (outer.element == nullptr) continue;
    return frame_named(scope, name.substr(0, split), asking, depth + 1) *
           frame_named(*outer.element, name.substr(split + 2), asking, depth + 1);
  }
  refuse(asking, "the frame '" + name +
                     "' is not there; allowed are the models, links, frames "
                     "and joints of '" +
                     scope.attribute("name") + "'");
}

/// What the pose of an element without relative_to is relative to; empty for the scope.
std::string own_base(const XmlElement& element) {
  if (element.name == "frame") return element.attribute("attached_to");
  if (element.name == "joint") return element.text_of("child");
  return "";
}

Eigen::Isometry3d pose_of(const XmlElement& scope, const XmlElement& element, int depth) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  std::string base;
  if (const XmlElement* value = element.child("pose")) {
    pose = pose_value(*value);
    base = relative_to(*value);
  }
  if (base.empty()) base = own_base(element);
  if (!base.empty()) pose = frame_named(scope, base, element, depth) * pose;
  const std::string placement = element.attribute("placement_frame");
  if (placement.empty()) return pose;
  return pose * frame_named(element, placement, element, depth + 1).inverse();
}

Eigen::Isometry3d lifted(const Eigen::Isometry3d& pose, double height) {
  return pose * Eigen::Translation3d(0.0, 0.0, height);
}

double round_scale(const Eigen::Vector3d& scale) { return scale.head<2>().maxCoeff(); }

Cylinder cylinder(const XmlElement& cylinder, const Eigen::Vector3d& scale) {
  return {length(cylinder, "radius") * round_scale(scale), length(cylinder, "length") * scale.z()};
}

std::vector<Shape> capsule(const XmlElement& capsule, const Eigen::Isometry3d& pose,
                           const Eigen::Vector3d& scale) {
  const auto [radius, straight] = cylinder(capsule, scale);
  return {{Cylinder{radius, straight}, pose},
          {Sphere{radius}, lifted(pose, straight / 2.0)},
          {Sphere{radius}, lifted(pose, -straight / 2.0)}};
}

Geometry ellipsoid(const XmlElement& ellipsoid, const Eigen::Vector3d& scale) {
  const Eigen::Vector3d radii = lengths(ellipsoid, "radii").cwiseProduct(scale);
  if (radii.maxCoeff() - radii.minCoeff() < 1e-9) return Sphere{radii.x()};
  return std::make_shared<const Mesh>(ellipsoid_mesh(radii));
}

std::vector<Eigen::Vector2d> outline(const XmlElement& polyline, const Eigen::Vector3d& scale) {
  std::vector<Eigen::Vector2d> points;
  for (const XmlElement* point : polyline.children_named("point")) {
    const std::vector<double> xy = numbers(*point, 2);
    if (std::max(std::abs(xy[0]), std::abs(xy[1])) > WorldLimits::extent)
      refuse(*point, "<point> is " + point->text + "; allowed are up to 1000 m");
    points.emplace_back(xy[0] * scale.x(), xy[1] * scale.y());
  }
  return points;
}

}  // namespace

Eigen::Isometry3d pose_in(const XmlElement& scope, const XmlElement& element) {
  return pose_of(scope, element, 0);
}

Eigen::Isometry3d pose_in_link(const XmlElement& model, const XmlElement& link,
                               const XmlElement& shape) {
  const XmlElement* pose = shape.child("pose");
  if (pose == nullptr || relative_to(*pose).empty()) return pose_of(link, shape, 0);
  return pose_of(model, link, 0).inverse() * pose_of(model, shape, 0);
}

SdfGeometry SdfShapes::read(const XmlElement& geometry, const Eigen::Isometry3d& pose,
                            const Eigen::Vector3d& scale) {
  SdfGeometry result;
  for (const XmlElement& kind : geometry.children) {
    if (kind.name == "box") {
      result.shapes.push_back({Box{lengths(kind, "size").cwiseProduct(scale)}, pose});
    } else if (kind.name == "cylinder") {
      result.shapes.push_back({cylinder(kind, scale), pose});
    } else if (kind.name == "sphere") {
      result.shapes.push_back({Sphere{length(kind, "radius") * scale.maxCoeff()}, pose});
    } else if (kind.name == "capsule") {
      for (Shape& part : capsule(kind, pose, scale)) result.shapes.push_back(std::move(part));
    } else if (kind.name == "cone") {
      const auto [radius, height] = cylinder(kind, scale);
      result.shapes.push_back({std::make_shared<const Mesh>(cone_mesh(radius, height)), pose});
    } else if (kind.name == "ellipsoid") {
      result.shapes.push_back({ellipsoid(kind, scale), pose});
    } else if (kind.name == "polyline") {
      const auto prism = prism_mesh(outline(kind, scale), length(kind, "height") * scale.z());
      if (!prism)
        refuse(kind,
               "<polyline> does not enclose an area; allowed are 3 to 300 points, not "
               "all on one line, whose sides do not cross");
      result.shapes.push_back({std::make_shared<const Mesh>(*prism), pose, std::nullopt, true});
    } else if (kind.name == "mesh") {
      result.shapes.push_back({mesh(kind, scale), pose});
    } else if (kind.name == "plane") {
      const XmlElement* normal = kind.child("normal");
      result.planes.push_back({normal ? vector3(*normal) : Eigen::Vector3d::UnitZ(), pose});
    } else if (kind.name == "heightmap" || kind.name == "image") {
      refuse(kind, "<" + kind.name +
                       "> makes hills of a picture, and the robot drives on one level; allowed are "
                       "box, cylinder, sphere, capsule, cone, ellipsoid, polyline, mesh and plane");
    } else if (kind.name != "empty") {
      refuse(kind, "the shape <" + kind.name +
                       "> is not known here; allowed are box, cylinder, sphere, capsule, cone, "
                       "ellipsoid, polyline, mesh and plane");
    }
  }
  return result;
}

std::shared_ptr<const Mesh> SdfShapes::mesh(const XmlElement& mesh, const Eigen::Vector3d& scale) {
  const XmlElement& uri = required(mesh, "uri");
  const auto found = files_.find(uri.text, *mesh.file);
  if (!found) refuse(uri, "the mesh '" + uri.text + "' is " + files_.looked_for(uri.text));
  MeshPart part;
  if (const XmlElement* own = mesh.child("scale")) part.scale = vector3(*own);
  if (!scale.isOnes()) part.scale = scale;
  if (const XmlElement* submesh = mesh.child("submesh")) {
    part.name = required(*submesh, "name").text;
    part.centred = flag(*submesh, "center", false);
  }
  std::ostringstream key;
  key << found->string() << '|' << part.name << '|' << part.centred << '|'
      << part.scale.transpose();
  Known& known = meshes_[key.str()];
  try {
    if (!known.mesh && known.fault.empty())
      known.mesh = std::make_shared<const Mesh>(read_mesh(*found, part));
  } catch (const WorldError& error) {
    known.fault = error.what();
  }
  if (!known.mesh) refuse(mesh, known.fault);
  return known.mesh;
}

}  // namespace navvi_sim::read
