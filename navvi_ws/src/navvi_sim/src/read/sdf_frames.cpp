#include "read/sdf_frames.hpp"

#include <array>

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

}  // namespace navvi_sim::read
