#include "navvi_sim/sensors/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "description/random.hpp"
#include "physics/ray_caster.hpp"

namespace navvi_sim::sensors {
namespace {

constexpr double kDegree = navvi_types::radians(1.0);

}  // namespace

void LidarConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(rate, "rate", Range{0.5, 50.0}, "Hz", "scans a second");
  visit(height, "height", Range{0.02, 3.0}, "m", "above the floor");
  visit(farthest, "farthest", Range{0.5, 200.0}, "m", "greatest range");
  visit(noise, "noise", Range{0.0, 1.0}, "m", "standard deviation of a range");
}

struct Sensor::Parts {
  double rate, nearest, farthest;
  double noise, growth;  ///< m, and m for each m of range squared
  double dropouts;
  Eigen::Isometry3d mount;
  Random random;
  std::vector<Eigen::Vector3d> rays = {};

  /// Nearly normal, and with any library the same: the sum of twelve uniform numbers.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += random.uniform(0.0, 1.0);
    return sum;
  }
};

Sensor::Sensor(const LidarConfig& config, std::uint64_t seed)
    : parts_(std::make_unique<Parts>(Parts{
          config.rate, config.nearest, config.farthest, config.noise, 0.0, config.dropouts,
          Eigen::Isometry3d(Eigen::Translation3d(config.x, 0.0, config.height)), Random(seed)})) {
  // Of a full circle the last ray is not the first once more.
  const int gaps = config.field < 360.0 ? config.rays - 1 : config.rays;
  for (int i = 0; i < config.rays; ++i) {
    const double angle = (-0.5 + static_cast<double>(i) / gaps) * config.field * kDegree;
    parts_->rays.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
}

Sensor::Sensor(const CameraConfig& config, std::uint64_t seed)
    : parts_(std::make_unique<Parts>(
          Parts{config.rate, config.nearest, config.farthest, 0.0, config.noise, config.dropouts,
                Eigen::Translation3d(config.x, 0.0, config.height) *
                    Eigen::Isometry3d(
                        Eigen::AngleAxisd(config.pitch * kDegree, Eigen::Vector3d::UnitY())),
                Random(seed)})) {
  const double half = std::tan(0.5 * config.field * kDegree);
  const double pixel = 2.0 * half / config.columns;
  for (int row = 0; row < config.rows; ++row)
    for (int column = 0; column < config.columns; ++column)
      parts_->rays.push_back(Eigen::Vector3d(1.0, half - pixel * (column + 0.5),
                                             pixel * (0.5 * config.rows - row - 0.5))
                                 .normalized());
}

Sensor::~Sensor() = default;
Sensor::Sensor(Sensor&& other) noexcept = default;
double Sensor::rate() const { return parts_->rate; }
double Sensor::nearest() const { return parts_->nearest; }
double Sensor::farthest() const { return parts_->farthest; }
const Eigen::Isometry3d& Sensor::mount() const { return parts_->mount; }
const std::vector<Eigen::Vector3d>& Sensor::rays() const { return parts_->rays; }

struct Sensors::Parts {
  explicit Parts(const WorldDescription& description)
      : caster(description), floor(description.floor_height) {
    for (const Thing& thing : description.things) moves.push_back(thing.route.has_value());
  }
  physics::RayCaster caster;
  double floor;             ///< m
  std::vector<bool> moves;  ///< by thing
};

Sensors::Sensors(const WorldDescription& description)
    : parts_(std::make_unique<Parts>(description)) {}
Sensors::~Sensors() = default;

Reading Sensors::look(Sensor& sensor, const live::Snapshot& now) const {
  Sensor::Parts& parts = *sensor.parts_;
  const Eigen::Isometry3d eye =
      Eigen::Translation3d(now.robot.position.x(), now.robot.position.y(), parts_->floor) *
      Eigen::Isometry3d(Eigen::AngleAxisd(now.robot.yaw, Eigen::Vector3d::UnitZ())) * parts.mount;
  std::vector<Eigen::Vector3d> ways;
  ways.reserve(parts.rays.size());
  for (const Eigen::Vector3d& ray : parts.rays) ways.push_back(eye.linear() * ray);
  Reading out{now.stamp(), {}, {}};
  for (const physics::RayEnd& end :
       parts_->caster.cast(eye.translation(), ways, parts.farthest, now.movers)) {
    const double spread = parts.noise + parts.growth * end.range * end.range;
    const double range = end.range + spread * parts.normal();
    const bool dropped = parts.random.chance(parts.dropouts);
    const bool nothing = end.thing == physics::RayEnd::kNothing || range > parts.farthest;
    out.ranges.push_back(dropped || (!nothing && range < parts.nearest)
                             ? std::numeric_limits<float>::quiet_NaN()
                         : nothing ? std::numeric_limits<float>::infinity()
                                   : static_cast<float>(range));
    const bool mover = end.thing < parts_->moves.size() && parts_->moves[end.thing];
    out.movers.push_back(mover ? static_cast<std::uint32_t>(end.thing) : Reading::kNoMover);
  }
  return out;
}

}  // namespace navvi_sim::sensors
