#pragma once

#include <cstdint>
#include <map>
#include <navvi_people/people/listener.hpp>
#include <navvi_types/cue_event.hpp>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/link_state.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/scenario.hpp>
#include <navvi_types/trial.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "record/row.hpp"
#include "trial/trial_flow.hpp"

namespace navvi_study {
using namespace navvi_types;
}  // namespace navvi_study

namespace navvi_study::trial {

// Time stamps are ns of ROS time, as in the header of the message.

/// `off`: it is there or not, but nothing is to be heard or felt of it.
enum class DeviceState : std::uint8_t { missing, works, off };

struct DeviceReport {
  std::int64_t stamp = 0;
  std::string device;  ///< pad, audio, speech; latency tells what the person waited for
  DeviceState state = DeviceState::missing;
  std::map<std::string, std::string> traits = {};  ///< such as name, firmware, voice, losses
};

/// How far another clock, such as that of a lab's recorder, is ahead of this computer's monotonic
/// one.
struct ClockOffset {
  std::string source;  ///< its name, such as lsl
  std::int64_t offset_ns = 0;
};

/// Something that happened in a trial; the journal makes a row of it.
struct Event {
  std::string type;
  record::Fields fields;
  std::int64_t sim_ns = 0;
  bool essential = true;
};

struct TrialMonitorConfig {
  double obstacle_range = 5.0;  ///< m, an obstacle this near is a proximity event
  double shelf_range = 1.0;     ///< m, a shelf this near is a proximity event
  double leave_margin = 0.1;    ///< m, a near thing has left beyond its range plus this
  double leave_time = 0.5;      ///< s, and has been there this long
  double center_range = 1.0;    ///< m, up to this far aside, a thing is in the centre
  static constexpr double kProgressPeriod = 1.0;  ///< s, between rows that only say how far one got
  /// m, an arrival farther from the goal by odometry is not recorded as reached: goal_reached of
  /// nav_node and 1 m
  double arrival_range = 1.0 + navvi_types::kArrivalMargin;
};

/// Contacts so far, up to the last one.
struct Hits {
  std::uint32_t contact_seq = 0;
  std::uint64_t shelf_count = 0;
  std::uint64_t obstacle_count = 0;
};

/// What a trial's first row says, so that the same messages give the same events again.
struct TrialStart {
  std::int64_t stamp = 0;  ///< messages stamped later than this belong to the trial
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();
  Hits hits = {};  ///< before the trial
  /// These are the world's, also as 0; else a first contact may follow others' in it.
  bool hits_known = false;
  double round_trip = 0.0;  ///< s, of the connection
  /// Kinds of cues that say that the robot is stuck; records of 0.1.0 count the first alone.
  std::vector<CueKind> stuck = {CueKind::stuck, CueKind::stuck_unknown, CueKind::back_away};
};

/// Running figures of a trial.
struct Tally {
  double path_length = 0.0;  ///< m, driven
  double turned = 0.0;       ///< rad, >= 0: farthest from how the robot stood first
  std::uint64_t shelf_collisions = 0;
  std::uint64_t obstacle_collisions = 0;
  std::uint64_t replans = 0;
  std::uint64_t reroutes = 0;
  std::uint64_t cues_spoken = 0;
  std::uint64_t sounds_played = 0;
  std::uint64_t patterns_felt = 0;
  std::uint64_t missed_messages = 0;
};

/// Turns what the other nodes report into the events of a trial (R-TRL-1). The order in which
/// different kinds of report come does not matter to what is counted, only the order within a kind:
/// so a bag gives the same figures as the live session.
class TrialMonitor {
 public:
  explicit TrialMonitor(const TrialMonitorConfig& config) : config_(config) {}

  /// From now on rows of sentences hold what these ask for. \param listener  lasts as long
  void understand(const navvi_people::people::Listener& listener) { listener_ = &listener; }

  /// Begins a trial. What was observed before is only what things are compared with.
  void start(const TrialStart& start);
  /// From now on another goal counts. \param stamp  when it was set
  [[nodiscard]] Event change_goal(const Eigen::Vector2d& goal, std::int64_t stamp);
  /// Reports stamped later than `stamp` no longer belong to the trial. Of two ends the earlier
  /// counts. To get the same figures again from a bag, end at latest(), or say the end before it
  /// comes.
  void end(std::int64_t stamp);
  [[nodiscard]] std::optional<std::int64_t> ended() const { return end_; }

  [[nodiscard]] std::vector<Event> observe(const Odometry& odometry);
  [[nodiscard]] std::vector<Event> observe(const Contact& contact);
  [[nodiscard]] std::vector<Event> observe(const Proximity& proximity);
  [[nodiscard]] std::vector<Event> observe(const Guidance& guidance);
  [[nodiscard]] std::vector<Event> observe(const CueEvent& cue);
  [[nodiscard]] std::vector<Event> observe(const DriveState& drive);
  [[nodiscard]] std::vector<Event> observe(const LinkState& link);
  [[nodiscard]] std::vector<Event> observe(const DeviceReport& device);
  [[nodiscard]] std::vector<Event> observe(const StateHash& state);

  /// What start() needs to know of the past.
  [[nodiscard]] TrialStart start_now(std::int64_t stamp, const Eigen::Vector2d& goal);
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// Where the robot is, as fields.
  [[nodiscard]] record::Fields place() const;
  /// The figures that no single event carries: path_length, cues_spoken, sounds_played,
  /// patterns_felt, missed_messages, and the last state of the world by step and hash (n/a where
  /// there is no simulator).
  [[nodiscard]] record::Fields tally_fields() const;
  /// These, yaw (rad), the class of the nearest thing on the `left` and `right` (within 45 degrees
  /// of that side and 3 m of the hull; or nothing), and how long the person waited for what was
  /// felt and heard, as far as it is known.
  [[nodiscard]] record::Fields end_fields() const;
  /// The guide shows a path to the goal, has arrived, or refused.
  [[nodiscard]] bool goal_taken() const { return goal_.taken; }
  /// How the trial ends, once the guide said that the goal is reached and odometry agrees: reached,
  /// or refused where the robot had neither driven nor turned, as such a trial measures nothing.
  [[nodiscard]] const std::optional<Ending>& arrival() const { return goal_.arrival; }
  /// The guide said that the goal is reached, and by the odometry the robot is elsewhere.
  [[nodiscard]] bool arrived_elsewhere() const { return goal_.arrived_elsewhere; }
  /// why the goal was refused
  [[nodiscard]] std::optional<std::string> refused() const { return goal_.refused; }
  /// The simulator began anew in mid trial.
  [[nodiscard]] bool world_restarted() const { return world_restarted_; }
  /// s, of the connection, as last told, also before a trial
  [[nodiscard]] double round_trip() const { return round_trip_; }
  /// The wheels were stopped as ROS time had jumped, if for a moment only.
  [[nodiscard]] bool clock_jumped() const { return clock_jumped_; }
  /// A stamp that no report of this time can have: it would end all that is compared with it.
  /// \param clock  ns, ROS time; 0 while its clock has not begun. What has waited may be before it.
  [[nodiscard]] bool ahead(std::int64_t stamp, std::int64_t clock) const;
  /// ns, the latest stamp that was seen at all
  [[nodiscard]] std::int64_t latest() const { return latest_; }

 private:
  struct Inside {
    std::int64_t last_inside = 0;
    NearThing thing;
  };

  struct Driven {
    std::optional<Odometry> odometry;  ///< of the trial
    double first_yaw = 0.0;            ///< rad, of its first odometry
    std::optional<Odometry> seen;      ///< the last one at all
    std::int64_t next_progress = 0;    ///< ns
    std::optional<Proximity> near;     ///< the last one of the trial
  };
  struct Guided {
    std::optional<Guidance> guidance;    ///< the last one
    std::optional<Guidance> before;      ///< the last one before the goal was set
    std::optional<std::uint32_t> plans;  ///< of the guidance, counted so far
    std::uint32_t reroutes = 0;          ///< of the guidance, likewise
    std::optional<Guidance::State> state;
  };
  struct GoalFate {
    bool taken = false;
    std::optional<Ending> arrival;
    bool arrived_elsewhere = false;
    std::optional<std::string> refused;
  };

  /// Whether a report with this stamp belongs to the trial.
  bool counts(std::int64_t stamp);
  [[nodiscard]] const char* zone(double lateral) const;
  void understand(const CueEvent& cue, record::Fields& fields) const;
  void collision(const Contact* contact, bool shelf, std::int64_t stamp,
                 std::vector<Event>& events);
  void arrive(const Guidance& guidance, std::vector<Event>& events);
  [[nodiscard]] bool moved() const;  ///< in this trial, driven or turned
  void count_plans(const Guidance& guidance, std::vector<Event>& events);
  /// The row for a cue that begins to be spoken, played or felt, or that ends.
  [[nodiscard]] std::optional<Event> row_of(const CueEvent& cue);
  [[nodiscard]] bool about_this_goal(const Guidance& guidance);

  TrialMonitorConfig config_;
  const navvi_people::people::Listener* listener_ = nullptr;
  std::optional<TrialStart> start_;
  std::optional<std::int64_t> end_;
  std::int64_t latest_ = 0;
  Tally tally_;
  Driven driven_;
  Hits hits_;
  std::map<std::uint32_t, Inside> inside_;
  std::map<std::uint32_t, std::int64_t> felt_;  ///< ns, since when near, by thing
  Guided guided_;
  std::set<std::uint32_t> stuck_cues_;
  std::map<Modality, std::string> playing_;  ///< kind of the last cue that is no speech
  std::vector<LinkState> links_;
  double round_trip_ = 0.0;  ///< s
  DriveState::Reason stopped_for_ = {};  ///< by the last stage before the wheels
  DriveState::Assistance assists_ = {};  ///< likewise
  std::string intruder_;                 ///< that stage ignores this node
  std::map<std::string, DeviceReport> devices_;
  std::vector<DeviceReport> latencies_;   ///< the last ones, as an end may be told after it
  std::optional<StateHash> world_state_;  ///< the last one, none later than the end
  GoalFate goal_;
  bool world_restarted_ = false;
  bool clock_jumped_ = false;
};

}  // namespace navvi_study::trial
