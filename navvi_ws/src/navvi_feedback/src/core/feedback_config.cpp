#include "core/feedback_config.hpp"

namespace navvi_feedback::core {

void FeedbackConfig::describe(navvi_config::Visitor& visit) {
  visit(stale, "stale", navvi_config::Range{0.2, 10.0}, "s",
        "guidance, proximity, odometry (wall clock) or the robot's pose (ROS time) older than this "
        "is lost");
  visit.group("drive", drive);
  visit.group("buttons", buttons);
  visit.group("haptics", haptics);
  visit.group("sounds", sounds);
  visit.group("cues", cues);
}

}  // namespace navvi_feedback::core
