#pragma once

#include <cstdint>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/zone.hpp>
#include <optional>
#include <string>

#include "navvi_config/field.hpp"
#include "navvi_safety/assistance.hpp"
#include "navvi_safety/link_meter.hpp"

namespace navvi_safety {

/// One instant on both clocks, so that neither a stopped simulation nor a changed wall clock can
/// keep wheels turning.
struct Instant {
  double wall = 0.0;  ///< s, monotonic
  double sim = 0.0;   ///< s, ROS time
};

struct CommandGateConfig {
  double timeout = 0.25;
  /// s, how long the command must be neutral before the wheels move again
  static constexpr double kNeutralHold = 0.30;
  static constexpr double kNeutralLinear = 0.02;   ///< m/s, a slower command counts as neutral
  static constexpr double kNeutralAngular = 0.02;  ///< rad/s, a slower command counts as neutral
  static constexpr double kAhead = 0.3;      ///< s, a stamp farther ahead is rejected
  static constexpr double kLateShare = 0.4;  ///< of a command that comes late
  static constexpr double kZoneStale = 0.5;  ///< s
  static constexpr double kZoneLost = 0.2;   ///< m/s, where what zones allow is not known any more
  bool foresight = true;
  std::string assistance = "off";  ///< off, stop or steer
  double max_linear = 1.5;
  double max_angular = 2.5;
  /// commands beyond this many times a limit are rejected
  static constexpr double kAbsurdFactor = 10.0;
  std::string driver;  ///< the node that may drive; empty: any, one at a time

  void describe(navvi_config::Visitor& visit);
};

/// A command as it came.
struct Command {
  std::optional<navvi_types::Velocity> velocity;  ///< nullopt: malformed
  double age = 0.0;       ///< s, from its stamp to its arrival, by the robot's clock
  std::uint32_t seq = 0;  ///< higher for a later one
};

/// Stops the wheels when no valid command came for `timeout`, when commands come by another link
/// than before, and when it is asked to; releases them only after the command was neutral for
/// kNeutralHold. It begins stopped, so motion always starts from a neutral stick.
class CommandGate {
 public:
  using State = navvi_types::DriveState::State;
  using Reason = navvi_types::DriveState::Reason;

  explicit CommandGate(const CommandGateConfig& config)
      : config_(config), assistance_(config.assistance) {}

  /// True if the node may drive: its commands may be received. One that may not is named by
  /// drive_state() from then on. \param link  number of the connection that its command came by,
  /// higher for a later one. Another link than that of the command before stops the wheels; while
  /// two links of one name send commands they stand still, and the name is an intruder's, too.
  [[nodiscard]] bool admit(const std::string& node, unsigned link);

  /// Takes a command as received. One that is malformed, not finite, kAbsurdFactor beyond the
  /// limits or stamped kAhead is rejected whole and extends nothing, as does one that comes too
  /// late; one that comes late is slowed, one beyond the limits is clamped. A command later than
  /// `timeout` finds the wheels stopped.
  void receive(const Command& command, const Instant& now);

  /// Stops the wheels, for a reason beside the commands. They stand for as long as this is called
  /// before each update, and until the command was neutral after that. A gate that waits is stopped
  /// by an emergency stop alone.
  void stop(Reason reason);

  /// What is near the robot. \param nearby  in base_link
  void see(const std::vector<navvi_types::NearThing>& nearby, const Instant& now) {
    assistance_.see(nearby, now.sim);
  }

  /// What zones allow. Where no newer one comes for kZoneStale, kZoneLost at most from then on;
  /// after half a turn, what was allowed ahead is allowed behind.
  void limit(const navvi_types::ZoneState& zone, const Instant& now) {
    zone_ = zone;
    zone_at_ = now;
    turned_ = 0.0;
  }

  /// The velocity for the wheels at `now`. Call it at every control step.
  [[nodiscard]] navvi_types::Velocity update(const Instant& now);

  /// As of the last call. \param stamp  ns, of the value
  [[nodiscard]] navvi_types::DriveState drive_state(std::int64_t stamp) const {
    return {state_, reason_, rejected_, stamp, intruder_, assistance_.does()};
  }
  /// As of the last command. \param stamp  ns, of the value
  [[nodiscard]] navvi_types::LinkState link_state(std::int64_t stamp) const;
  [[nodiscard]] LinkMeter::Late late() const { return link_meter_.late(); }
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] Reason reason() const { return reason_; }
  [[nodiscard]] unsigned rejected() const { return rejected_; }
  /// True where a robot that is driven gets its commands by the wall clock, and `timeout` is
  /// nearly over by the clock of a simulation: one faster than real time must wait for the next.
  [[nodiscard]] bool outrun(const Instant& now) const;

 private:
  /// The person's, or nothing while the wheels are held.
  [[nodiscard]] navvi_types::Velocity held_or_driven(const Instant& now);
  /// Stops wheels, and forgets a neutral stick, where no valid command is young enough.
  void expire(const Instant& now);

  CommandGateConfig config_;
  LinkMeter link_meter_;
  Assistance assistance_;
  navvi_types::ZoneState zone_;
  std::optional<Instant> zone_at_;
  navvi_types::Velocity wheels_;  ///< as of the last update
  double updated_ = 0.0;          ///< s of ROS time, when it was
  double turned_ = 0.0;           ///< rad, since zone_at_, as the wheels were told
  navvi_types::Velocity command_;
  std::optional<Instant> last_valid_;
  std::optional<Instant> neutral_since_;
  std::optional<unsigned> link_;  ///< of the last command
  unsigned latest_link_ = 0;
  bool bad_since_valid_ = false;
  State state_ = State::waiting;
  Reason reason_ = Reason::none;
  unsigned rejected_ = 0;
  std::string intruder_;
};

}  // namespace navvi_safety
