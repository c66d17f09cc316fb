#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_study/row.hpp"

namespace navvi_study {

/// m, in map
struct Point2 {
  double x = 0.0;
  double y = 0.0;
};

/// Time stamps are ns of ROS time, as in the header of the message.
struct OdometryReport {
  std::int64_t stamp = 0;
  Point2 position;  ///< of base_link
};

struct ContactReport {
  std::int64_t stamp = 0;
  std::uint32_t seq = 0;  ///< 1 for the first contact of the world
  std::string thing_class;
  std::string thing;  ///< its name in the world
  Point2 robot;
  double speed = 0.0;                ///< m/s, just before
  std::uint64_t shelf_count = 0;     ///< contacts with shelves so far, this one included
  std::uint64_t obstacle_count = 0;  ///< contacts with everything else so far, likewise
};

struct NearThing {
  std::uint32_t id = 0;
  std::string thing;
  std::string thing_class;
  double gap = 0.0;      ///< m, hull to surface
  double lateral = 0.0;  ///< m, y of its nearest point in base_link: left is positive
};

struct ProximityReport {
  std::int64_t stamp = 0;
  std::vector<NearThing> things;
};

struct GuidanceReport {
  /// Values as in navvi_msgs/Guidance.
  enum class State {
    no_goal,
    following,
    arrived,
    refused,
    no_route,
    off_mesh,
    no_map,
    pose_stale,
    map_stale,
    blocked,
    make_room,
  };
  std::int64_t stamp = 0;
  std::uint32_t seq = 0;
  State state = State::no_goal;
  std::string refusal;        ///< in words with underscores
  std::string replan_reason;  ///< likewise
  std::uint32_t plans = 0;    ///< so far
  double plan_time = 0.0;     ///< s
  Point2 goal;
  double goal_distance = 0.0;  ///< m, along the path; valid when there is one

  /// There is a path to the goal.
  [[nodiscard]] bool leads() const { return state == State::following || state == State::blocked; }
};

/// As in navvi_msgs/Guidance, in lower case.
[[nodiscard]] const char* to_string(GuidanceReport::State state);

struct CueReport {
  enum class Stage { queued, started, ended, cut, dropped };
  std::int64_t stamp = 0;
  std::uint32_t id = 0;
  Stage stage = Stage::queued;
  bool speech = true;
  std::string kind;
};

struct DriveReport {
  std::int64_t stamp = 0;
  bool stopped = false;
  std::string reason;  ///< none, command_lost, command_invalid
};

struct DeviceReport {
  std::int64_t stamp = 0;
  std::string device;  ///< pad, audio, speech
  bool usable = false;
};

/// What the world was like after so many steps: the proof that a repetition is the same.
struct StateReport {
  std::int64_t stamp = 0;
  std::uint64_t step = 0;
  std::string hash;  ///< 16 hexadecimal digits
};

/// The world of a simulator, and the goal that it has drawn.
struct ScenarioReport {
  std::string world, world_hash;
  std::uint64_t seed = 0;
  Point2 goal;
};

/// Something that happened in a trial; the journal makes a row of it.
struct Event {
  std::string type;
  Fields fields;
  std::int64_t sim_ns = 0;
  bool essential = true;
};

struct TrialMonitorConfig {
  double obstacle_range = 5.0;
  double shelf_range = 1.0;
  double leave_margin = 0.1;
  double leave_time = 0.5;
  double center_range = 1.0;
  double progress_period = 1.0;

  void describe(navvi_config::Visitor& visit);
};

/// What a trial's first row says, so that the same messages give the same events again.
struct TrialStart {
  std::int64_t stamp = 0;  ///< messages stamped later than this belong to the trial
  Point2 goal;
  std::uint32_t contact_seq = 0;  ///< of the last contact before the trial
  std::uint64_t shelf_count = 0;  ///< contacts before the trial
  std::uint64_t obstacle_count = 0;
};

/// Running figures of a trial.
struct Tally {
  double path_length = 0.0;                 ///< m, driven
  std::optional<double> first_path_length;  ///< m, of the first path
  std::uint64_t shelf_collisions = 0;
  std::uint64_t obstacle_collisions = 0;
  std::uint64_t replans = 0;
  std::uint64_t cues_spoken = 0;
  std::uint64_t missed_messages = 0;
};

/// Turns what the other nodes report into the events of a trial (R-TRL-1). The order in which
/// different kinds of report come does not matter to what is counted, only the order within a kind:
/// so a bag gives the same figures as the live session.
class TrialMonitor {
 public:
  explicit TrialMonitor(const TrialMonitorConfig& config) : config_(config) {}

  /// Begins a trial. What was observed before is only what things are compared with.
  void start(const TrialStart& start);
  /// From now on another goal counts. \param stamp  when it was set
  [[nodiscard]] Event change_goal(const Point2& goal, std::int64_t stamp);
  /// Reports stamped later than `stamp` no longer belong to the trial. Of two ends the earlier
  /// counts. To get the same figures again from a bag, end at latest(), or say the end before it
  /// comes.
  void end(std::int64_t stamp);
  [[nodiscard]] std::optional<std::int64_t> ended() const { return end_; }

  [[nodiscard]] std::vector<Event> observe(const OdometryReport& odometry);
  [[nodiscard]] std::vector<Event> observe(const ContactReport& contact);
  [[nodiscard]] std::vector<Event> observe(const ProximityReport& proximity);
  [[nodiscard]] std::vector<Event> observe(const GuidanceReport& guidance);
  [[nodiscard]] std::vector<Event> observe(const CueReport& cue);
  [[nodiscard]] std::vector<Event> observe(const DriveReport& drive);
  [[nodiscard]] std::vector<Event> observe(const DeviceReport& device);
  [[nodiscard]] std::vector<Event> observe(const StateReport& state);

  /// What start() needs to know of the past.
  [[nodiscard]] TrialStart start_now(std::int64_t stamp, const Point2& goal) const;
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// The figures that no single event carries: path_length, cues_spoken, missed_messages, and the
  /// last state of the world by step and hash (n/a where there is no simulator).
  [[nodiscard]] Fields tally_fields() const;
  /// The guide shows a path to the goal, has arrived, or refused.
  [[nodiscard]] bool goal_taken() const { return goal_taken_; }
  /// ns, when the goal was reached
  [[nodiscard]] std::optional<std::int64_t> reached() const { return reached_; }
  /// why the goal was refused
  [[nodiscard]] std::optional<std::string> refused() const { return refused_; }
  /// The simulator began anew in mid trial.
  [[nodiscard]] bool world_restarted() const { return world_restarted_; }
  /// ns, the latest stamp that was seen at all
  [[nodiscard]] std::int64_t latest() const { return latest_; }

 private:
  struct Inside {
    std::int64_t last_inside = 0;
    NearThing thing;
  };

  /// Whether a report with this stamp belongs to the trial.
  bool counts(std::int64_t stamp);
  [[nodiscard]] Fields place() const;
  [[nodiscard]] const char* zone(double lateral) const;
  void collision(const ContactReport* contact, bool shelf, std::int64_t stamp,
                 std::vector<Event>& events);
  [[nodiscard]] bool about_this_goal(const GuidanceReport& guidance);

  TrialMonitorConfig config_;
  std::optional<TrialStart> start_;
  std::optional<std::int64_t> end_;
  std::int64_t latest_ = 0;
  Tally tally_;
  std::optional<OdometryReport> odometry_;
  std::int64_t next_progress_ = 0;
  std::uint32_t contact_seq_ = 0;
  std::uint64_t shelf_count_ = 0;
  std::uint64_t obstacle_count_ = 0;
  std::map<std::uint32_t, Inside> inside_;
  std::optional<GuidanceReport> guidance_;         ///< the last one
  std::optional<GuidanceReport> guidance_before_;  ///< the last one before the goal was set
  std::optional<std::uint32_t> plans_;             ///< of the guidance, counted so far
  std::set<std::uint32_t> stuck_cues_;
  std::optional<DriveReport> drive_;
  std::map<std::string, bool> devices_;
  std::optional<StateReport> world_state_;  ///< the last one, none later than the end
  bool goal_taken_ = false;
  std::optional<GuidanceReport::State> state_;
  std::optional<std::int64_t> reached_;
  std::optional<std::string> refused_;
  bool world_restarted_ = false;
};

}  // namespace navvi_study
