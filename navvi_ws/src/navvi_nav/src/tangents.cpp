#include "navvi_nav/tangents.hpp"

namespace navvi_nav {

void Tangents::watch(const Mesh& mesh) {
  mesh_ = &mesh;
  if (corners_.size() < mesh.vertices.size()) corners_.resize(mesh.vertices.size());
  if (mesh.version == version_ && round_ != 0) return;
  version_ = mesh.version;
  edges_.clear();
  if (++round_ == 0) {
    std::fill(corners_.begin(), corners_.end(), Corner{});
    round_ = 1;
  }
}

void Tangents::meet(const Sight::Corner& seen) {
  Corner& corner = corners_[static_cast<std::size_t>(seen.vertex)];
  if (corner.met == round_) return;
  corner.met = round_;
  corner.polygon = seen.polygon;
}

void Tangents::look(int vertex) {
  Corner& corner = corners_[static_cast<std::size_t>(vertex)];
  const std::vector<Sight::Corner>& seen = sight_.look(*mesh_, vertex, corner.polygon);
  const auto add = [&](int turned) {
    const auto first = static_cast<std::uint32_t>(edges_.size());
    for (const Sight::Corner& each : seen) {
      if (each.turned == turned) edges_.emplace_back(each);
    }
    return first;
  };
  for (const Sight::Corner& each : seen) meet(each);
  corner.looked = round_;
  corner.left = add(1);
  corner.either = add(0);
  corner.right = add(-1);
  corner.end = static_cast<std::uint32_t>(edges_.size());
}

}  // namespace navvi_nav
