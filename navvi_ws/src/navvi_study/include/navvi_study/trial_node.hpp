#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Cue.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Proximity.h>
#include <navvi_msgs/Scenario.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "navvi_study/bag_watch.hpp"
#include "navvi_study/journal.hpp"
#include "navvi_study/odometry_in_map.hpp"
#include "navvi_study/readiness.hpp"
#include "navvi_study/trial_flow.hpp"
#include "navvi_study/trial_monitor.hpp"
#include "navvi_study/trial_node_config.hpp"

namespace navvi_study {

/// Runs trials one after the other: waits until every part is there, records, sets the goal, keeps
/// the journal, ends, and writes the results. Everything happens in the thread that spins.
class TrialNode {
 public:
  /// Puts earlier trials in order. \throws std::runtime_error if `out` cannot be used
  explicit TrialNode(const TrialNodeConfig& config);

  /// Ends a running trial as aborted and closes everything. Takes two seconds at most.
  void shut_down();
  /// What the process is to return once ROS has been shut down.
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  enum class Phase { waiting, armed, running, draining, closing, done };

  void subscribe();
  template <typename Message>
  void listen(const std::string& topic);
  template <typename Report>
  void take(const Report& report);
  void on_odometry(const nav_msgs::Odometry::ConstPtr& msg);
  void on_transforms(const tf2_msgs::TFMessage& msg, bool for_good);
  void on_guidance(const navvi_msgs::Guidance::ConstPtr& msg);
  void on_diagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& msg);
  void on_goal(const ros::MessageEvent<geometry_msgs::PoseStamped const>& event);
  void on_scenario(const navvi_msgs::Scenario::ConstPtr& msg);

  void step();
  void wait();
  void arm();
  void try_to_start();
  void start(const Point2& goal);
  void watch();
  void ask_for_goal();
  void end(const Ending& ending);
  void write_end();
  void close();
  void finish();
  void watch_bag();
  void leave(int exit_code);

  /// Journals, then publishes. False when the journal is broken.
  bool record(const Event& event);
  void write_summary();
  [[nodiscard]] std::vector<std::string> missing() const;
  [[nodiscard]] bool active() const {
    return phase_ == Phase::running || phase_ == Phase::draining;
  }

  TrialNodeConfig config_;
  ros::NodeHandle node_;
  ros::Publisher events_;
  ros::Publisher goals_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;

  Readiness readiness_;
  TrialMonitor monitor_;
  Phase phase_ = Phase::waiting;
  double phase_since_ = 0.0;  ///< s, monotonic, as are all times below
  double said_ = 0.0;
  std::optional<navvi_msgs::Scenario> scenario_;
  bool scenario_played_ = false;

  OdometryInMap places_;
  std::filesystem::path folder_;
  std::unique_ptr<Journal> journal_;
  BagWatch bag_;
  bool bag_lost_ = false;  ///< and journalled
  std::string recorder_name_;
  Point2 goal_;
  GoalTries goal_tries_;
  TrialFlow flow_;
  double operator_seen_ = 0.0;  ///< when a simulated one last moved its hands
  std::int64_t start_stamp_ = 0;
  Ending ending_;
  bool shutting_down_ = false;
  int exit_code_ = 0;
};

}  // namespace navvi_study
