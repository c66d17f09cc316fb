#include "trial/trial_node_config.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace navvi_study::trial {
namespace {

void refuse_control_characters(const char* name, const std::string& text) {
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }))
    throw std::runtime_error(std::string(name) + " may hold no control characters");
}

/// Letters, digits, - and _, such as sub-01, so that names do not slip into the record.
void refuse_all_but_pseudonyms(const std::string& name, const std::string& text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_';
  });
  if (text == "n/a" || (plain && !text.empty() && text.size() <= 32)) return;
  throw std::runtime_error(name + " is \"" + text +
                           "\"; allowed are up to 32 letters, digits, - and _, such as sub-01");
}

}  // namespace

void StudyConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Any;
  const navvi_config::Range count{0, 10000};
  visit(name, "name", Any{}, "", "of the study");
  visit(plan, "plan", Any{}, "", "hash of the plan");
  visit(group, "group", Any{}, "", "of the participant");
  visit(condition, "condition", Any{}, "", "of the trial");
  visit(phase, "phase", Any{}, "", "practice or trial");
  visit(replaces, "replaces", Any{}, "", "the trial that does not count, in whose place it stands");
  visit(session, "session", count, "", "from 1; 0 outside of a study, as the next three");
  visit(order, "order", count, "", "place of the condition, from 1");
  visit(repeat, "repeat", count, "", "of the trial in its condition, from 1");
  visit(attempt, "attempt", count, "", "from 1");
}

void TrialNodeConfig::describe(navvi_config::Visitor& visit) {
  using namespace navvi_config;
  visit(out, "out", Any{}, "", "folder that gets a folder for each trial");
  visit(limit, "limit", Range{0.0, 86400.0}, "s",
        "a trial ends after this much ROS time; 0 for never");
  visit(patience, "patience", Range{0.0, 86400.0}, "s",
        "give up where a single trial cannot begin, or no robot is there, for this long; 0: wait "
        "for ever");
  visit(operator_kind, "operator", Any{}, "",
        "what drives, as it stands in the summary: pad, simulated, ...");
  visit(participant, "participant", Any{}, "", "a pseudonym for the record, such as sub-01");
  visit(profile, "profile", Any{}, "", "of the session, as it stands in the summary");
  visit(parameters, "parameters", Any{}, "",
        "those of nodes that were set besides the profile's, as they stand in the summary");
  visit(version, "version", Any{}, "", "of NavVI, as it stands in the summary");
  visit(contacts, "contacts", OneOf{{"counted", "unknown"}}, "",
        "unknown where nothing tells of contacts: the summary then says so, and not 0");
  visit(require, "require", OneOf{{"speech", "rumble"}}, "", "no trial without these modalities");
  visit(job, "job", Any{}, "",
        "path of a file of places (doc/robot.md) that are driven to one after the other, a trial "
        "each; empty: none");
  visit(once, "once", Any{}, "", "end after one trial");
  visit(press_to_start, "press_to_start", Any{}, "",
        "a trial begins when the person presses the button for it, and the stick drives from then");
  visit(record, "record", OneOf{{"here", "robot", "none"}}, "",
        "where a bag of each trial is recorded; robot: on the robot's machine, and fetched after "
        "the trial");
  visit(tail, "tail", Range{0.0, 60.0}, "s", "the bag goes on after the end, for the last words");
  visit(odom_frame, "odom_frame", Any{}, "", "frame of the odometry; its parent is the map's");
  visit(locked, "locked", Any{}, "",
        "true: a goal that anybody else sets ends the trial as aborted");
  visit.group("study", study);
}

void check(const TrialNodeConfig& config) {
  refuse_control_characters("operator", config.operator_kind);
  refuse_control_characters("profile", config.profile);
  refuse_control_characters("parameters", config.parameters);
  refuse_control_characters("version", config.version);
  const StudyConfig& study = config.study;
  for (const std::string* text :
       {&study.name, &study.plan, &study.group, &study.condition, &study.phase, &study.replaces})
    refuse_all_but_pseudonyms("study", *text);
  refuse_all_but_pseudonyms("participant", config.participant);
  if (config.out.empty()) throw std::runtime_error("out names no folder");
}

}  // namespace navvi_study::trial
