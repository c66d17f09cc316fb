#pragma once

#include <iosfwd>
#include <navvi_people/loop/closed_loop.hpp>
#include <string>

namespace navvi_study::batch {

using navvi_people::loop::ClosedLoop;

/// Writes down what happens in a closed loop, for whoever looks for a cause: a line a second with
/// the robot, the guidance, the hand and what is near, and a line for each thing said or hit and
/// for each change of state or path. Angles are degrees clockwise from the robot's nose; the
/// robot's heading is degrees counter-clockwise from x, in map. Times are s since the world began.
class LoopTrace {
 public:
  /// \param from, to  s; what happens outside of it is left out
  LoopTrace(std::ostream& out, double from, double to) : out_(out), from_(from), to_(to) {}

  /// Call it after every step.
  void watch(const ClosedLoop& loop);

 private:
  void tell_events(const ClosedLoop& loop);
  void tell_guidance(double time, const navvi_msgs::Guidance& guidance);
  void tell_state(const ClosedLoop& loop);
  void line(double time, const std::string& text);

  std::ostream& out_;
  double from_;
  double to_;
  navvi_msgs::Guidance guidance_;    ///< the latest
  navvi_msgs::Proximity proximity_;  ///< likewise
  navvi_msgs::Obstacles obstacles_;  ///< likewise
  bool hand_repeat_ = false;
};

}  // namespace navvi_study::batch
