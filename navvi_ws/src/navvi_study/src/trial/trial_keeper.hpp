#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <navvi_feedback/menu/places_file.hpp>
#include <navvi_types/stall_guard.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "record/figures.hpp"
#include "record/journal.hpp"
#include "trial/bag_watch.hpp"
#include "trial/conditions.hpp"
#include "trial/odometry_in_map.hpp"
#include "trial/readiness.hpp"
#include "trial/tracker.hpp"
#include "trial/trial_flow.hpp"
#include "trial/trial_monitor.hpp"
#include "trial/trial_node_config.hpp"

namespace navvi_study::trial {

/// A moment on every clock that a trial knows.
struct Moment {
  std::int64_t mono_ns = 0;  ///< of the machine; never goes back
  std::int64_t ros_ns = 0;   ///< ROS time; 0 while its clock has not begun
  std::int64_t utc_ns = 0;   ///< by the calendar, for the record

  [[nodiscard]] double wall() const { return 1e-9 * static_cast<double>(mono_ns); }  ///< s
};

/// A goal, sent as often as it takes with one stamp: a newer one would tell the guide that a person
/// asks for it a second time.
struct ChosenGoal {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m, in map
  std::int64_t stamp = 0;  ///< ns, of the message with which it came; 0: the world's own goal
};

/// Runs trials one after the other: waits until every part is there, records, sets the goal, keeps
/// the journal, ends, and writes the results.
class TrialKeeper {
 public:
  enum class Tone { info, warning, error, fatal };

  /// Actions of a keeper on the world outside.
  struct Outlets {
    std::function<void(const record::Row&)> publish;  ///< is on the disk already
    std::function<void(const ChosenGoal&)> set_goal;
    std::function<void(Tone, const std::string&)> tell;                      ///< for the screen
    std::function<void(const TrialState&)> show = [](const TrialState&) {};  ///< on each change
    std::function<Settings()> settings = [] { return Settings(); };
    std::function<bool()> hears_contacts = [] { return true; };  ///< something tells of them
    /// File of what is spoken; empty where it is not known.
    std::function<std::filesystem::path()> phrases = [] { return std::filesystem::path(); };
    /// Begins a bag at that path; nullptr where none is wanted.
    std::function<std::unique_ptr<BagRecorder>(const std::filesystem::path&)> start_recorder;
  };

  /// Puts earlier trials in order. \throws std::runtime_error if `out` cannot be used
  /// \param calls  of the journals
  TrialKeeper(const TrialNodeConfig& config, Outlets outlets, const Moment& now,
              navvi_files::SystemCalls calls = navvi_files::SystemCalls::real());

  /// What the other nodes report; for odometry, in odom.
  template <typename Report>
  void take(const Report& report, const Moment& now) {
    now_ = now;
    observe(report);
  }
  void take(const Odometry& odometry, const Moment& now);
  void take(const Correction& correction, const Moment& now);
  void take(const Guidance& guidance, const Moment& now);
  void take(const Scenario& scenario, const Moment& now);
  /// Recorded while a trial runs, so that its rows can be found on the other clock.
  void take(const ClockOffset& clock, const Moment& now);
  /// A request that does not fit the state of the trial has no effect.
  void take(const TrialRequest& request, const Moment& now);
  /// Another node has set a goal. \param stamp  ns, of its message
  void take_goal(const Eigen::Vector2d& goal, const Moment& now, std::int64_t stamp = 0);
  /// For the track; a simulated operator that moves them is alive.
  void take(const Hands& hands, const Moment& now) {
    now_ = now;
    if (drops(hands.stamp)) return;
    operator_seen_ = now.wall();
    tracker_.observe(hands);
  }
  /// The bag's recorder listens.
  void recorder_listens(const Moment& now) { kept_.bag.hears(now.wall()); }

  /// Goes on; to be called every 50 ms or so.
  void step(const Moment& now);
  /// Ends a running trial as aborted and closes everything: done() two seconds later at the most,
  /// if step() is still called.
  /// \param crashed  why, where a crash has ended the session, such as simulator_lost
  void stop(const Moment& now, const std::string& crashed = {});
  /// There will be no other trial.
  [[nodiscard]] bool done() const { return phase_ == Phase::done; }
  /// What the process is to return once all is done.
  [[nodiscard]] int exit_code() const { return exit_.code; }

 private:
  enum class Phase { waiting, armed, running, draining, closing, done };

  /// The record of a trial.
  struct Kept {
    std::filesystem::path folder;
    std::unique_ptr<record::Journal> journal;
    std::unique_ptr<record::TrackFile> track;
    BagWatch bag;
    // Both are journalled.
    bool bag_lost = false;
    bool feedback_silent = false;
    Settings settings;
    double settings_read = 0.0;  ///< s
  };
  struct Goals {
    std::optional<ChosenGoal> next;  ///< of the trial that is to begin
    ChosenGoal now;
    std::optional<ChosenGoal> before;  ///< that was taken, until a later one is
    GoalTries tries;
  };
  struct Offered {
    std::optional<Scenario> scenario;
    bool played = false;
  };
  /// Places that are driven to one after the other, a trial each.
  struct Job {
    std::vector<navvi_feedback::menu::NamedPlace> places;
    std::vector<std::size_t> left;    ///< in `places`
    std::set<std::size_t> missed;     ///< to which a trial led in vain, so far
    std::optional<std::size_t> here;  ///< which was reached by the trial that has ended
    [[nodiscard]] bool done() const { return !places.empty() && left.empty(); }
    /// The place of the job to which a trial leads; nullopt: another goal, of the menu.
    [[nodiscard]] std::optional<std::size_t> at(const Eigen::Vector2d& goal) const;
  };
  struct Exit {
    std::optional<double> asked;  ///< s, when it was asked to stop
    int code = 0;
  };
  struct Shown {
    double said = 0.0;  ///< s, when a sentence was last on the screen
    std::optional<TrialState::State> state;
    bool dropped = false;  ///< a report
  };

  template <typename Report>
  void observe(const Report& report);
  /// A report that is stamped far ahead, which is told once.
  bool drops(std::int64_t stamp);
  void enter(Phase phase);
  void wait();
  void arm();
  void try_to_start();
  void show_state();
  [[nodiscard]] TrialState::State state();
  void start(const ChosenGoal& chosen);
  void change_goal(const ChosenGoal& chosen);
  [[nodiscard]] record::Fields conditions(const TrialStart& beginning);
  [[nodiscard]] Signs signs() const;
  void listen();
  void keep_track(std::int64_t until);
  [[nodiscard]] record::Trial trial() const {
    return {kept_.journal->rows(), record::read_track(kept_.folder)};
  }
  void watch();
  void watch_bag();
  void watch_feedback(double silence);
  void watch_settings();
  void ask_for_goal();
  void end(const Ending& ending);
  void write_end();
  void close();
  void finish();
  void leave(int exit_code);
  void abandon(int exit_code);

  /// Journals, then publishes. False when the journal is broken.
  bool record(const Event& event);
  void write_summary();
  [[nodiscard]] std::string missing() const;  ///< with commas between; empty: nothing
  /// True if `pause` s have passed since the last sentence on the screen; restarts the pause.
  [[nodiscard]] bool may_say(double pause);
  void tell(Tone tone, const std::string& sentence) const { outlets_.tell(tone, sentence); }
  [[nodiscard]] bool simulated() const { return config_.operator_kind == "simulated"; }
  [[nodiscard]] bool active() const {
    return phase_ == Phase::running || phase_ == Phase::draining;
  }

  TrialNodeConfig config_;
  Outlets outlets_;
  navvi_files::SystemCalls calls_;
  Moment now_;
  Moment began_;  ///< the trial

  Readiness readiness_;
  TrialMonitor monitor_;
  Tracker tracker_;
  std::optional<navvi_people::people::Listener> listener_;
  OdometryInMap places_;
  Phase phase_ = Phase::waiting;
  double phase_since_ = 0.0;  ///< s, monotonic, as are all times below
  navvi_types::StallGuard stall_{{1.0, 0.5, 3.0}};
  Shown shown_;
  Offered offered_;
  Job job_;
  std::optional<std::int64_t> pressed_;  ///< ns, ROS time, when the person began it

  Kept kept_;
  Goals goals_;
  TrialFlow flow_;
  double operator_seen_ = 0.0;  ///< when a simulated one last moved its hands
  Ending ending_;
  Exit exit_;
};

template <typename Report>
void TrialKeeper::observe(const Report& report) {
  if (drops(report.stamp)) return;
  readiness_.saw(report, now_.wall());
  tracker_.observe(report);
  for (const auto& event : monitor_.observe(report))
    if (active()) record(event);
  // At once: a report that is stamped later may be the next to come.
  if (phase_ != Phase::running) return;
  if (const auto& arrival = monitor_.arrival()) {
    end({arrival->result, arrival->reason, monitor_.latest()});
  } else if (monitor_.arrived_elsewhere()) {
    end({"invalid", "arrived_elsewhere", monitor_.latest()});
  } else if (const auto why = monitor_.refused()) {
    if (!goals_.before) return end({"refused", *why, monitor_.latest()});
    return change_goal(*std::exchange(goals_.before, std::nullopt));
  }
}

}  // namespace navvi_study::trial
