#pragma once

#include <map>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/thing.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace navvi_safety {

/// Slows a command before what the robot would hit, or bends it away from that. It never turns
/// against the person's turn, and never drives faster than the person does. It is with the robot,
/// so that the delay of a connection does not matter.
class Assistance {
 public:
  using Does = navvi_types::DriveState::Assistance;

  /// \param mode  off, stop or steer
  explicit Assistance(const std::string& mode) : on_(mode != "off"), steers_(mode == "steer") {}

  /// \param nearby  in base_link \param time  s of ROS time
  void see(const std::vector<navvi_types::NearThing>& nearby, double time);

  /// At every control step. \param wanted  by the person \return what the wheels are given
  [[nodiscard]] navvi_types::Velocity assist(const navvi_types::Velocity& wanted, double time);

  [[nodiscard]] Does does() const { return does_; }

 private:
  /// A thing, and where its nearest point was of late.
  struct Seen {
    navvi_types::NearThing thing;
    Eigen::Vector2d way{0, 0};  ///< unit vector to its nearest point, in the frame of pose_
    std::vector<std::pair<double, Eigen::Vector2d>> track = {};  ///< s and m, in the frame of pose_
    [[nodiscard]] Eigen::Vector2d velocity() const;              ///< m/s, in the frame of pose_
  };
  void drive(double time);
  /// s, until a robot that drives so touches it; infinity: not within the horizon
  [[nodiscard]] double until_touched(const Seen& seen, const navvi_types::Velocity& robot,
                                     double horizon) const;
  /// m/s, forward, at which the robot, turning so, still stops before anything.
  [[nodiscard]] double allowed(const navvi_types::Velocity& wanted) const;
  [[nodiscard]] bool is_free(const navvi_types::Velocity& wanted) const;
  [[nodiscard]] std::optional<navvi_types::Velocity> way_round(
      const navvi_types::Velocity& wanted) const;
  [[nodiscard]] navvi_types::Velocity kept_off(const navvi_types::Velocity& wanted) const;
  void tell(Does does, double time);

  bool on_, steers_;
  navvi_types::Pose2 pose_;         ///< by dead reckoning, from wherever the robot stood first
  navvi_types::Velocity velocity_;  ///< as the wheels were given it last
  double time_ = 0.0;               ///< s, of pose_
  std::optional<double> seen_at_;   ///< s
  std::map<std::uint32_t, Seen> seen_;  ///< by id
  Does does_ = Does::nothing;
  double told_ = 0.0;  ///< s, when does_ was so last
};

}  // namespace navvi_safety
