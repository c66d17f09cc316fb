#include "core/feedback_config.hpp"

namespace navvi_feedback::core {

void FeedbackConfig::describe(navvi_config::Visitor& visit) {
  visit(lead, "lead", navvi_config::OneOf{{"words", "ticks", "flow", "hand"}}, "",
        "what leads along the way: words; ticks that count turns down, and words; flow, a sound "
        "that lasts, its side where to steer, its pitch how fast; hand, pulses of the motors, "
        "likewise, without any sound");
  visit.group("drive", drive);
  visit.group("buttons", buttons);
  visit.group("haptics", haptics);
  visit.group("sounds", sounds);
  visit.group("cues", cues);
}

}  // namespace navvi_feedback::core
