#pragma once

#include <navvi_config/field.hpp>
#include <optional>
#include <vector>

#include "guide/cylinders.hpp"

namespace navvi_nav::guide {

struct ObservationConfig {
  int most_cylinders = 4;
  /// s, an older pose or velocity of the robot is stale
  static constexpr double kPoseTimeout = 1.0;
  static constexpr double kObstacleTimeout = 1.0;  ///< s, older obstacles are forgotten
  static constexpr double kHeld = 20.0;  ///< s, what stood in the way before may be there so long
  static constexpr double kMostAhead = 0.3;  ///< s, of a stamp; clocks and messages differ by less

  void describe(navvi_config::Visitor& visit);
};

/// What is known of the robot and of moving things, and how fresh it is. Times are s on one clock.
class Observation {
 public:
  explicit Observation(const ObservationConfig& config) : config_(config) {}

  void set_obstacles(std::vector<MovingThing> things, double time);
  void reject_obstacles() { obstacles_rejected_ = true; }
  /// \param stamp  of the pose
  void set_pose(const Pose2& pose, double stamp);
  /// By odometry.
  void set_velocity(const navvi_types::Velocity& velocity) {
    velocity_ = velocity;
    velocity_time_.reset();
  }
  /// \param ahead  s, by which guidance is ahead of the robot
  void set_foresight(double ahead) { foresight_ = ahead; }
  /// Drops obstacles and a velocity that are too old, and measures the pace.
  void update(double time);
  void reset_times();

  /// Where the robot is; nullopt without a fresh pose.
  [[nodiscard]] std::optional<Pose2> pose(double time) const;
  [[nodiscard]] const std::optional<Pose2>& last_pose() const { return pose_; }
  /// Where the robot will be, at its present velocity, when a person's answer to what they are
  /// told now arrives; where it was last, without foresight.
  [[nodiscard]] std::optional<Pose2> foreseen() const;
  [[nodiscard]] double speed() const { return velocity_.linear; }  ///< m/s, forward
  [[nodiscard]] bool velocity_fresh(double time) const {
    return !velocity_time_ || time - *velocity_time_ <= config_.kPoseTimeout;
  }
  /// m/s, > 0: mean forward speed over the times when the robot moved.
  [[nodiscard]] double pace() const { return pace_; }
  [[nodiscard]] const std::vector<Cylinder>& obstacles() const { return obstacles_; }
  /// As it was told last.
  [[nodiscard]] std::optional<MovingThing> thing(std::optional<std::uint32_t> id) const;
  [[nodiscard]] bool obstacles_fresh() const { return obstacles_time_ && !obstacles_lost(); }
  /// True if the obstacles were dropped as too old; cleared by the next ones.
  [[nodiscard]] bool obstacles_lost() const { return age() > config_.kObstacleTimeout; }
  /// True while what was in the way when they were lost may still be there.
  [[nodiscard]] bool obstacles_held() const { return obstacles_lost() && age() <= config_.kHeld; }
  /// The latest could not be taken.
  [[nodiscard]] bool obstacles_rejected() const { return obstacles_rejected_; }

 private:
  struct Moved {
    std::uint32_t id;
    double time;  ///< s, when it was last seen to move
  };
  static bool by_id(const Moved& a, const Moved& b) { return a.id < b.id; }
  /// s, of the obstacles at the last update
  [[nodiscard]] double age() const {
    return obstacles_time_ && updated_ ? *updated_ - *obstacles_time_ : 0.0;
  }

  ObservationConfig config_;
  std::vector<MovingThing> things_;
  std::vector<Moved> moved_;              ///< that ever did, by id
  std::vector<Cylinder> obstacles_;       ///< the things, as navigation sees them
  std::optional<double> obstacles_time_;  ///< nullopt: none came yet
  bool obstacles_rejected_ = false;
  std::optional<Pose2> pose_;
  double pose_time_ = 0.0;
  navvi_types::Velocity velocity_;
  std::optional<double> velocity_time_;  ///< s, of the first update with it
  double foresight_ = 0.0;  ///< s
  double pace_ = 0.7;  ///< before the robot moved
  std::optional<double> updated_;
};

}  // namespace navvi_nav::guide
