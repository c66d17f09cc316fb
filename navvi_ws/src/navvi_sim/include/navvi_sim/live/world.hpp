#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <navvi_config/field.hpp>
#include <navvi_safety/command_gate.hpp>
#include <vector>

#include "navvi_sim/description/floor_pose.hpp"
#include "navvi_sim/description/mover_state.hpp"
#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/physics/contact_counter.hpp"
#include "navvi_sim/physics/drivetrain.hpp"
#include "navvi_sim/physics/physics.hpp"
#include "navvi_sim/physics/proximity.hpp"
#include "navvi_sim/physics/robot.hpp"
#include "navvi_sim/traffic/traffic.hpp"

namespace navvi_sim::live {

struct WorldConfig {
  double step = 0.01;    ///< s
  double ceiling = 2.0;  ///< m above the floor: what begins higher is not near the robot
  physics::RobotConfig robot;
  traffic::MoversConfig movers;

  void describe(navvi_config::Visitor& visit);
};

/// Everything that moves, at one instant. Frame: map, but for the odometry.
struct Snapshot {
  double time = 0.0;  ///< s since the world began
  physics::RobotState robot;
  physics::RobotState odometry;                 ///< base_link in odom, as its wheels count it
  std::vector<MoverState> movers;               ///< ordered by thing
  std::vector<physics::ContactEvent> contacts;  ///< begun in the last step
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
  World(const WorldDescription& description, const WorldConfig& config, const FloorPose& start,
        std::uint64_t seed);

  /// Advances by `config.step`.
  /// \param command  of base_link; beyond the robot's limits it is held to them
  [[nodiscard]] Status step(const navvi_safety::Velocity& command,
                            physics::Braking braking = physics::Braking::normal);

  [[nodiscard]] const Snapshot& now() const { return now_; }
  /// Each thing but floors within `detection_radius` m of the robot's hull, nearest first, in map.
  [[nodiscard]] std::vector<physics::NearThing> proximity(double detection_radius) const;
  /// 64 bits over every state. Equal for equal histories, on one build.
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  /// What does not change of a moving thing's pose.
  struct Stance {
    Eigen::Quaterniond tilt;
    double z;  ///< m
  };

  void place_movers(bool all);
  void step_movers();
  /// Things, in order, that press the robot so far into themselves or into others that it cannot
  /// give way.
  [[nodiscard]] std::vector<std::size_t> pressing() const;
  void drive_robot(const navvi_safety::Velocity& command, physics::Braking braking);
  void take_snapshot();
  [[nodiscard]] bool finite() const;

  WorldConfig config_;
  double floor_height_;
  std::vector<ThingClass> classes_;  ///< by thing
  traffic::Traffic traffic_;
  std::vector<Stance> stances_;  ///< by index in traffic_
  physics::Bodies bodies_;
  physics::Physics physics_;
  physics::Drivetrain drivetrain_;
  physics::ContactCounter contacts_;
  Snapshot now_;
  std::uint64_t steps_ = 0;
  double last_speed_ = 0.0;  ///< m/s, of the robot, one step earlier than now_
  bool failed_ = false;
};

}  // namespace navvi_sim::live
