#pragma once

#include <ros/ros.h>

#include <cstddef>

#include "navvi_sim/live/session.hpp"

namespace navvi_sim::node {

/// The topics that repeat this world, and that prove that the repetition is the same.
class RepetitionRecord {
 public:
  /// \param session  outlives this
  RepetitionRecord(ros::NodeHandle& node, const live::Session& session);

  /// What is new since the last call.
  void publish();

 private:
  [[nodiscard]] ros::Time stamp() const { return ros::Time(session_.world().now().time); }

  const live::Session& session_;
  ros::Publisher applied_, hash_;
  std::size_t commands_published_ = 0;
  std::size_t hashes_published_ = 0;
};

}  // namespace navvi_sim::node
