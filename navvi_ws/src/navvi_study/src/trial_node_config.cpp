#include "navvi_study/trial_node_config.hpp"

namespace navvi_study {

void TrialNodeConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Any;
  using navvi_config::OneOf;
  using navvi_config::Range;
  visit({"out", Any{}, "", "folder that gets a folder for each trial"}, out);
  visit({"limit", Range{0.0, 86400.0}, "s", "a trial ends after this much ROS time; 0 for never"},
        limit);
  visit({"operator", Any{}, "", "what drives, as it stands in the summary: pad, simulated, ..."},
        operator_kind);
  visit({"participant", Any{}, "", "a pseudonym for the record, such as sub-01"}, participant);
  visit({"profile", Any{}, "", "of the session, as it stands in the summary"}, profile);
  visit({"require", OneOf{{"speech", "rumble"}}, "", "no trial without these modalities"}, require);
  visit({"once", Any{}, "", "end after one trial"}, once);
  visit({"record", Any{}, "", "keep a bag of each trial"}, record);
  visit({"tail", Range{0.0, 60.0}, "s", "the bag goes on after the end, for the last words"}, tail);
  visit.group("monitor", monitor);
}

}  // namespace navvi_study
