#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <navvi_config/field.hpp>
#include <navvi_types/thing.hpp>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/physics/robot.hpp"
#include "navvi_sim/traffic/movers_config.hpp"

namespace navvi_sim::live {

struct WorldConfig {
  double step = 0.01;           ///< s, fixed time step
  bool wait_for_robot = false;  ///< stand still, while the clock runs, until it is first driven
  physics::RobotConfig robot;
  traffic::MoversConfig movers;

  void describe(navvi_config::Visitor& visit);
};

/// Everything that moves, at one instant. Frame: map, but for the odometry.
struct Snapshot {
  double time = 0.0;  ///< s since the world began
  physics::RobotState robot;
  physics::RobotState odometry;                ///< base_link in odom, as its wheels count it
  std::vector<MoverState> movers;              ///< ordered by thing
  std::vector<navvi_types::Contact> contacts;  ///< begun in the last step

  /// `time` in ns
  [[nodiscard]] std::int64_t stamp() const { return std::llround(time * 1e9); }
};

/// One world that lives for one trial. The same description, config, start, seed and commands give
/// the same states, bit for bit.
class World {
 public:
  enum class Status {
    running,
    command_refused,  ///< the command was not finite: nothing happened in this step
    numeric_failure   ///< a state was not finite: the world has stopped for good
  };

  /// \param description  valid (validate.hpp); it need not outlive the constructor
  /// \param seed         of the movers' pauses and the robot's imperfections
  /// \throws WorldError naming the things, if what moves cannot be kept from what stands or from
  ///         each other (lanes.hpp)
  World(const WorldDescription& description, const WorldConfig& config, const Pose2& start,
        std::uint64_t seed);
  ~World();

  /// Advances by `config.step`.
  /// \param command  of base_link; beyond the robot's limits it is held to them
  [[nodiscard]] Status step(const navvi_types::Velocity& command,
                            physics::Braking braking = physics::Braking::normal);

  [[nodiscard]] const Snapshot& now() const { return now_; }
  [[nodiscard]] navvi_types::Odometry odometry() const;
  /// Every mover.
  [[nodiscard]] navvi_types::Obstacles obstacles() const;
  /// Each thing within `detection_radius` m of the robot's hull.
  [[nodiscard]] navvi_types::Proximity proximity(double detection_radius) const;
  /// 64 bits over every state. Equal for equal histories, on one build.
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  struct Parts;

  void place_movers(bool all);
  void step_movers();
  /// Things, in order, that press the robot so far into themselves or into others that it cannot
  /// give way.
  [[nodiscard]] std::vector<std::size_t> pressing() const;
  void drive_robot(const navvi_types::Velocity& command, physics::Braking braking);
  void take_snapshot();
  void count_contacts(double speed);
  [[nodiscard]] bool finite() const;

  WorldConfig config_;
  double floor_height_;
  std::unique_ptr<Parts> parts_;
  Snapshot now_;
  std::uint64_t steps_ = 0;
  double last_speed_ = 0.0;  ///< m/s, of the robot, one step earlier than now_
  bool driven_ = false;      ///< the robot has been told to move
  bool failed_ = false;
};

}  // namespace navvi_sim::live
