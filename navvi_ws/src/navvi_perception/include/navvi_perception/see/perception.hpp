#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <navvi_config/field.hpp>
#include <navvi_types/thing.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_perception/sight/sight.hpp"

namespace navvi_perception::see {

/// The parameters of perception_node's core.
class PerceptionConfig {
 public:
  PerceptionConfig();

  void describe(navvi_config::Visitor& visit);
  [[nodiscard]] double resolution() const;    ///< m, of the map
  [[nodiscard]] double robot_radius() const;  ///< m; what is seen within it is the robot itself
  /// \param height  m, of the robot with its load, as navigation has it: what begins higher over
  ///                the floor does not matter
  void set_robot_height(double height);
  [[nodiscard]] double robot_height() const;  ///< m
  /// The OctoMap of a file, .bt or .ot. \throws navvi_config::ConfigError with a sentence
  [[nodiscard]] sight::Prior prior_of(const std::string& file) const;

 private:
  friend class Perception;
  std::any values_;
};

/// What a robot's own sensors tell of what stands and what moves around it. What it cannot know it
/// does not guess: whatever it sees is of class other, but for long standing things, which it calls
/// walls (a rack is one, too). Frame: map, but for proximity. No clock: the same sights give the
/// same answers.
class Perception {
 public:
  explicit Perception(const PerceptionConfig& config, const sight::Prior& prior = {});
  ~Perception();

  /// Replaces the prior map; what was seen, and its tracks, stay.
  void know(const sight::Prior& prior);
  /// False for a sight without any hit where the prior map has a wall within its range: the sensor
  /// is blind, or the robot is elsewhere.
  [[nodiscard]] bool believes(const sight::Sight& sight) const;
  /// \param sight  finite, and not older than the one before of the same sensor
  void take(const sight::Sight& sight);

  /// What the standing map does not explain, with its velocity if it moves. \param stamp  ns
  [[nodiscard]] navvi_types::Obstacles obstacles(std::int64_t stamp) const;
  /// The nearest surface of each of these and of each standing thing. \param robot  base_link
  [[nodiscard]] navvi_types::Proximity proximity(const navvi_types::Pose2& robot,
                                                 std::int64_t stamp);
  /// A bumper was touched: it tells that, not where, so the contact is at the robot's nose.
  /// \param count  of contacts, with this one
  [[nodiscard]] navvi_types::Contact bump(const navvi_types::Pose2& robot, std::uint32_t count,
                                          std::int64_t stamp) const;
  /// A binary OcTree, if it is to be told again: it has changed, and the last is `period` old.
  [[nodiscard]] std::optional<std::vector<std::int8_t>> map(std::int64_t stamp);
  /// m, middles of the voxels that were seen to stand, without the prior map.
  [[nodiscard]] std::vector<Eigen::Vector3d> standing() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace navvi_perception::see
