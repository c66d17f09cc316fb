#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cues/phrases.hpp"
#include "navvi_feedback/core/guide.hpp"
#include "node/node_config.hpp"
#include "picture/markers.hpp"

namespace navvi_feedback::node {

class Outlets {
 public:
  /// \param own_hands  the stick is our own device, whose state is published; another driver's joy
  /// is never answered with one of ours
  Outlets(ros::NodeHandle& node, const NodeConfig& config, bool own_hands);

  void stop_wheels() { command({}, 0.0); }
  /// All but the words.
  void send(const core::Output& told);
  void send(std::vector<CueEvent> events);
  void send(const drive::InputState& hands);
  void send(const diagnostic_msgs::DiagnosticArray& report) { diagnostics_.publish(report); }
  /// What the person is to do now, where it has changed.
  void show(const std::optional<CueEvent>& order);
  /// The path and what is written beside it, where they have changed: the turn, where it is the
  /// order that was shown last.
  /// \param path, stop  m, in map, as guide_markers() \param time  s
  void show(const std::optional<Guidance>& guidance, const std::vector<Eigen::Vector2d>& path,
            const std::optional<Eigen::Vector2d>& stop, const cues::Phrases& words, double time);

  /// RViz shows the path again, after it had ended; true once.
  [[nodiscard]] bool is_picture_back() { return std::exchange(picture_back_, false); }
  [[nodiscard]] bool are_words_read() const { return cues_.getNumSubscribers() > 0; }

 private:
  std::string motors_driver_;
  /// \param lag  s, as Output::lag
  void command(const Velocity& velocity, double lag);

  ros::Publisher commands_, joy_, motors_, goals_, requests_, cues_, orders_,
      markers_, diagnostics_;
  std::optional<double> markers_time_;  ///< s
  CueEvent order_{0, CueStage::ended};  ///< last published
  visualization_msgs::MarkerArray shown_;
  bool pictured_ = false;  ///< RViz has shown the path
  bool picture_back_ = false;
};

}  // namespace navvi_feedback::node
