#include "description/hash.hpp"
#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {
namespace {

/// Over the bytes of a world's names and numbers.
class WorldHash {
 public:
  void bytes(const void* data, std::size_t size) { state_ = mix_bytes(state_, data, size); }
  void add(std::uint64_t value) { bytes(&value, sizeof value); }
  void add(double value) {
    const double canonical = value == 0.0 ? 0.0 : value;  // -0 is 0
    bytes(&canonical, sizeof canonical);
  }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes(text.data(), text.size());
  }
  void add(const Eigen::Isometry3d& pose) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) add(pose.matrix()(row, column));
  }

  void operator()(const Box& box) {
    for (int axis = 0; axis < 3; ++axis) add(box.size[axis]);
  }
  void operator()(const Cylinder& cylinder) {
    add(cylinder.radius);
    add(cylinder.length);
  }
  void operator()(const Sphere& sphere) { add(sphere.radius); }
  void operator()(const std::shared_ptr<const Mesh>& mesh) {
    add(static_cast<std::uint64_t>(mesh->vertices.size()));
    for (const Eigen::Vector3f& vertex : mesh->vertices)
      for (int axis = 0; axis < 3; ++axis) add(static_cast<double>(vertex[axis]));
    add(static_cast<std::uint64_t>(mesh->triangles.size()));
    for (const auto& triangle : mesh->triangles)
      for (const std::uint32_t index : triangle) add(static_cast<std::uint64_t>(index));
  }

  [[nodiscard]] std::uint64_t state() const { return state_; }

 private:
  std::uint64_t state_ = kHashBasis;
};

void add(WorldHash& hash, const Route& route) {
  hash.add(static_cast<std::uint64_t>(route.waypoints.size()));
  for (const Waypoint& waypoint : route.waypoints)
    for (const double value : {waypoint.at.x(), waypoint.at.y(), waypoint.pause, waypoint.speed})
      hash.add(value);
  hash.add(route.speed);
  hash.add(static_cast<std::uint64_t>(route.loop));
  hash.add(route.delay);
  hash.add(static_cast<std::uint64_t>(route.yields));
}

}  // namespace

std::string world_hash(const WorldDescription& world) {
  WorldHash hash;
  hash.add(world.name);
  hash.add(world.floor_height);
  hash.add(static_cast<std::uint64_t>(world.things.size()));
  for (const Thing& thing : world.things) {
    hash.add(thing.name);
    hash.add(std::string(to_string(thing.thing_class)));
    hash.add(thing.pose);
    hash.add(static_cast<std::uint64_t>(thing.shapes.size()));
    for (const Shape& shape : thing.shapes) {
      hash.add(static_cast<std::uint64_t>(shape.geometry.index()));
      std::visit([&hash](const auto& geometry) { hash(geometry); }, shape.geometry);
      hash.add(shape.pose);
      hash.add(std::string(to_string(look_of(thing, shape))));
      if (shape.solid) hash.add(std::string("solid"));
    }
    hash.add(static_cast<std::uint64_t>(thing.route.has_value()));
    if (thing.route) add(hash, *thing.route);
  }
  return navvi_types::to_hex(hash.state());
}

}  // namespace navvi_sim
