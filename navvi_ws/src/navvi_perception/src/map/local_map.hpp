#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <navvi_config/field.hpp>
#include <navvi_types/motion.hpp>
#include <string>
#include <utility>
#include <vector>

#include "navvi_perception/sight/sight.hpp"

namespace navvi_perception::map {

struct MapConfig {
  double resolution = 0.05;  ///< m, edge of a voxel
  double bound = 8.0;        ///< m, along x and y to each side of the robot; beyond it only the
                             ///< prior map is kept
  double floor = 0.0;        ///< m, z of the floor in map
  double low = 0.04;         ///< m above the floor; what ends lower is floor
  double high = navvi_types::kHeadroom;  ///< m above the floor; what begins higher does not matter
  static constexpr double kHit = 0.7;    ///< probability that what a ray meets is there
  static constexpr double kMiss = 0.4;   ///< probability that what a ray passes is there
  /// m, what is seen so near a thing of the prior map belongs to it
  static constexpr double kSlack = 0.1;
  double forget = 60.0;  ///< s, in which a sure voxel is forgotten that is not seen again

  void describe(navvi_config::Visitor& visit);
};

/// What an octomap::OcTree shows between `low` and `high`; clear is what it knows and is not
/// occupied. \param file  .bt or .ot \throws navvi_config::ConfigError with a sentence
[[nodiscard]] sight::Prior prior_of(const std::string& file, const MapConfig& config);

/// A vertical stack of voxels: x and y in voxels; (0, 0) has its lower corner at the origin of map.
using Column = std::pair<int, int>;

/// What stands: an octomap::OcTree of what was seen around the robot, over the prior map. The one
/// user of OctoMap. Frame: map.
class LocalMap {
 public:
  enum class Known { nothing, clear, standing };

  /// \param prior  as of know()
  explicit LocalMap(const MapConfig& config, const sight::Prior& prior = {});
  ~LocalMap();

  /// Replaces the prior map and keeps what was seen. \param prior  may be without cells. What it
  /// shows is kept for good, each occupied cell from the floor up to `high`
  void know(const sight::Prior& prior);
  /// Takes in what stands and what is clear; forgets what is beyond the bound or was not seen for
  /// long.
  void insert(const sight::Sight& sight);
  /// Whether something stands at the point, by a voxel or the slack, or the point is clear.
  /// \param in_plane  of the prior map, if that is flat
  [[nodiscard]] Known at(const Eigen::Vector3d& point, bool in_plane = true) const;
  /// True if a ray of `clear` passes a wall of the prior map, more than 0.5 m before its end: the
  /// map or the sensor is wrong.
  [[nodiscard]] bool contradicts(const sight::Sight& sight) const;
  /// True for what is between `low` and `high`, m above the floor.
  [[nodiscard]] bool matters(const Eigen::Vector3d& point) const {
    return point.z() > config_.floor + config_.low && point.z() < config_.floor + config_.high;
  }
  /// Columns where something stands, whose middle is within `radius` m of the place along x and y.
  [[nodiscard]] std::vector<Column> standing(const Eigen::Vector2d& place, double radius) const;
  /// m, middles of the voxels that were seen to stand.
  [[nodiscard]] std::vector<Eigen::Vector3d> seen() const;
  [[nodiscard]] double resolution() const { return config_.resolution; }  ///< m
  /// All of it as OcTree::writeBinaryData: what stands, and the floor below what is clear, which is
  /// taken to be flat.
  [[nodiscard]] std::vector<std::int8_t> bytes() const;
  /// True if bytes() may differ from what they were at the last call of this.
  [[nodiscard]] bool changed();

 private:
  struct Trees;

  void fade(const sight::Sight& sight);
  [[nodiscard]] Column column_of(const Eigen::Vector2d& place) const;
  /// What the prior map knows of a column.
  enum Prior : std::int8_t { kUnknown, kClear, kNear, kOccupied };
  [[nodiscard]] Prior prior_at(const Column& column) const;
  void widen_prior();

  MapConfig config_;
  Column low_{0, 0};  ///< of the prior's columns
  bool flat_ = true;  ///< the prior
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Prior> prior_;
  bool prior_told_ = false;  ///< by changed()
  std::unique_ptr<Trees> trees_;
  std::int64_t faded_ = 0;                            ///< ns, when fade() was last done
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  ///< m, of what is kept
};

}  // namespace navvi_perception::map
