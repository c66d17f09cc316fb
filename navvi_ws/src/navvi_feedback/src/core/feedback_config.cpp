#include "core/feedback_config.hpp"

namespace navvi_feedback::core {

void FeedbackConfig::describe(navvi_config::Visitor& visit) {
  visit.group("drive", drive);
  visit.group("buttons", buttons);
  visit.group("haptics", haptics);
  visit.group("sounds", sounds);
  visit.group("cues", cues);
}

}  // namespace navvi_feedback::core
