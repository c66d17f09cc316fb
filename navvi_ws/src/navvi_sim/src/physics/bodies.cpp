#include "physics/bodies.hpp"

#include <algorithm>

#include "description/floor_height.hpp"

namespace navvi_sim::physics {
namespace {

std::unique_ptr<AabbTree> tree_of(const Mesh& mesh) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t index : triangle) box.extend(mesh.vertices[index].cast<double>());
    boxes.push_back(box);
  }
  return std::make_unique<AabbTree>(boxes);
}

}  // namespace

Bodies::Bodies(const WorldDescription& description, double underside) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t id = 0; id < description.things.size(); ++id) {
    const Thing& thing = description.things[id];
    Body body{id, thing.route.has_value(), {}, {}};
    for (const Shape& shape : thing.shapes) {
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry);
      if (mesh && (!*mesh || (*mesh)->triangles.empty())) continue;
      Part part{shape.geometry, body.moves ? shape.pose : pose, bounds_of(shape.geometry, pose)};
      if (part.bounds.max().z() < underside) continue;
      if (mesh) {
        auto& tree = triangles_[mesh->get()];
        if (!tree) tree = tree_of(**mesh);
        part.triangles = tree.get();
      }
      body.bounds.extend(part.bounds);
      body.parts.push_back(std::move(part));
    }
    if (body.parts.empty()) continue;
    if (!body.moves) {
      standing_.push_back(bodies_.size());
      boxes.push_back(body.bounds);
    }
    bodies_.push_back(std::move(body));
  }
  tree_ = AabbTree(boxes);
}

const Body* Bodies::of(std::size_t thing) const {
  const auto found =
      std::lower_bound(bodies_.begin(), bodies_.end(), thing,
                       [](const Body& body, std::size_t id) { return body.thing < id; });
  return found != bodies_.end() && found->thing == thing ? &*found : nullptr;
}

}  // namespace navvi_sim::physics
