#include "navvi_sim/sensors/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "physics/bullet_shapes.hpp"

namespace navvi_sim::sensors {

constexpr double kDegree = navvi_types::radians(1.0);
constexpr double kUnderside = 1e-3;  // m above the floor; what ends lower is the floor itself

void LidarConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(rate, "rate", Range{0.5, 50.0}, "Hz", "scans a second");
  visit(height, "height", Range{0.02, 3.0}, "m", "above the floor");
  visit(farthest, "farthest", Range{0.5, 200.0}, "m", "greatest range");
  visit(noise, "noise", Range{0.0, 1.0}, "m", "standard deviation of a range");
}

Sensor::Sensor(const LidarConfig& config, std::uint64_t seed)
    : rate_(config.rate),
      nearest_(config.nearest),
      farthest_(config.farthest),
      noise_(config.noise),
      growth_(0.0),
      dropouts_(config.dropouts),
      mount_(Eigen::Translation3d(config.x, 0.0, config.height)),
      random_(seed) {
  // Of a full circle the last ray is not the first once more.
  const int gaps = config.field < 360.0 ? config.rays - 1 : config.rays;
  for (int i = 0; i < config.rays; ++i) {
    const double angle = (-0.5 + static_cast<double>(i) / gaps) * config.field * kDegree;
    rays_.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
}

Sensor::Sensor(const CameraConfig& config, std::uint64_t seed)
    : rate_(config.rate),
      nearest_(config.nearest),
      farthest_(config.farthest),
      noise_(0.0),
      growth_(config.noise),
      dropouts_(config.dropouts),
      mount_(Eigen::Translation3d(config.x, 0.0, config.height) *
             Eigen::Isometry3d(
                 Eigen::AngleAxisd(config.pitch * kDegree, Eigen::Vector3d::UnitY()))),
      random_(seed) {
  const double half = std::tan(0.5 * config.field * kDegree);
  const double pixel = 2.0 * half / config.columns;
  for (int row = 0; row < config.rows; ++row)
    for (int column = 0; column < config.columns; ++column)
      rays_.push_back(Eigen::Vector3d(1.0, half - pixel * (column + 0.5),
                                      pixel * (0.5 * config.rows - row - 0.5))
                          .normalized());
}

/// Nearly normal, and with any library the same: the sum of twelve uniform numbers.
double Sensor::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random_.uniform(0.0, 1.0);
  return sum;
}

/// All bodies of a world and its floor, as rays meet them, in a world of Bullet's own: what is
/// looked at moves nothing. The robot is not in it. Frame: map.
struct Sensors::Parts {
  explicit Parts(const WorldDescription& description);
  ~Parts() {
    for (int i = world.getNumCollisionObjects() - 1; i >= 0; --i)
      world.removeCollisionObject(world.getCollisionObjectArray()[i]);
  }

  /// Puts what moves where it is now.
  void place(const std::vector<MoverState>& movers);
  /// Where a ray ends.
  struct End {
    double range;         ///< m, along the ray; infinity if it met nothing
    std::uint32_t mover;  ///< as Reading::movers
  };
  /// \param from    m \param way  a unit vector \param length  m, of the ray
  [[nodiscard]] End cast(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                         double length) const;

  double floor;  ///< m
  physics::Bodies bodies;
  physics::MeshShapes meshes;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btCollisionObject>> objects;
  std::map<std::size_t, btCollisionObject*> moving;  ///< by thing
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

Sensors::Parts::Parts(const WorldDescription& description)
    : floor(description.floor_height),
      bodies(description, description.floor_height + kUnderside),
      meshes(physics::meshes_of(bodies)) {
  for (const physics::Body& body : bodies.all()) {
    auto object = std::make_unique<btCollisionObject>();
    shapes.push_back(physics::compound_of(body, meshes, shapes));
    object->setCollisionShape(shapes.back().get());
    object->setUserIndex(static_cast<int>(body.moves ? body.thing : Reading::kNoMover));
    world.addCollisionObject(object.get());
    if (body.moves) moving[body.thing] = object.get();
    objects.push_back(std::move(object));
  }
}

void Sensors::Parts::place(const std::vector<MoverState>& movers) {
  for (const MoverState& mover : movers) {
    const auto found = moving.find(mover.thing.id);
    if (found == moving.end()) continue;
    found->second->setWorldTransform(physics::to_bt(mover.pose));
    world.updateSingleAabb(found->second);
  }
}

Sensors::Parts::End Sensors::Parts::cast(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                         double length) const {
  const double down = way.z() < 0.0 ? (floor - from.z()) / way.z() : length;
  const double reach = std::min(down, length);
  const btVector3 begin = physics::to_bt(from);
  const btVector3 end = physics::to_bt(Eigen::Vector3d(from + reach * way));
  btCollisionWorld::ClosestRayResultCallback result(begin, end);
  world.rayTest(begin, end, result);
  if (result.hasHit())
    return {reach * static_cast<double>(result.m_closestHitFraction),
            static_cast<std::uint32_t>(result.m_collisionObject->getUserIndex())};
  return {down < length ? down : std::numeric_limits<double>::infinity(), Reading::kNoMover};
}

Sensors::Sensors(const WorldDescription& description)
    : parts_(std::make_unique<Parts>(description)) {}
Sensors::~Sensors() = default;

Reading Sensors::look(Sensor& sensor, const live::Snapshot& now) const {
  const Eigen::Isometry3d eye =
      Eigen::Translation3d(now.robot.position.x(), now.robot.position.y(), parts_->floor) *
      Eigen::Isometry3d(Eigen::AngleAxisd(now.robot.yaw, Eigen::Vector3d::UnitZ())) *
      sensor.mount_;
  parts_->place(now.movers);
  Reading out{now.stamp(), {}, {}};
  for (const Eigen::Vector3d& ray : sensor.rays_) {
    const auto [met, mover] =
        parts_->cast(eye.translation(), eye.linear() * ray, sensor.farthest_);
    const double noise = sensor.normal();
    const double range = met + (sensor.noise_ + sensor.growth_ * met * met) * noise;
    const bool dropped = sensor.random_.chance(sensor.dropouts_);
    const bool nothing = std::isinf(met) || range > sensor.farthest_;
    out.ranges.push_back(dropped || (!nothing && range < sensor.nearest_)
                             ? std::numeric_limits<float>::quiet_NaN()
                         : nothing ? std::numeric_limits<float>::infinity()
                                   : static_cast<float>(range));
    out.movers.push_back(mover);
  }
  return out;
}

}  // namespace navvi_sim::sensors
