#include "trial/conditions.hpp"

#include <vector>

#include "trial/platform.hpp"

namespace navvi_study::trial {
namespace {

void set_study(record::Fields& fields, const StudyConfig& study) {
  fields.set("study", study.name).set("plan", study.plan).set("group", study.group);
  fields.set("condition", study.condition).set("phase", study.phase);
  fields.set("replaces", study.replaces);
  const auto set = [&](const char* name, int count) {
    fields.set(name, count > 0 ? std::to_string(count) : "n/a");
  };
  set("session", study.session);
  set("condition_order", study.order);
  set("repeat", study.repeat);
  set("attempt", study.attempt);
}

}  // namespace

void add_conditions(record::Fields& fields, const TrialNodeConfig& config,
                    const std::optional<Scenario>& scenario, const Settings& settings,
                    const TrialStart& start, const std::string& phrases) {
  fields.set("world", scenario ? scenario->world : "n/a");
  fields.set("world_hash", scenario ? scenario->world_hash : "n/a");
  fields.set("seed", scenario ? std::to_string(scenario->seed) : "n/a");
  fields.set("operator", config.operator_kind).set("participant", config.participant);
  fields.set("profile", config.profile).set("version", config.version);
  fields.set("parameters", config.parameters.empty() ? "none" : config.parameters);
  std::string words;
  for (const auto& [name, value] : settings)
    words += (words.empty() ? "" : " ") + name + "=" + value;
  fields.set("settings", words);
  if (!phrases.empty()) fields.set("phrases", phrases);
  fields.set("cpu", processor()).set("compiler", compiler());
  fields.set("bullet", bullet());
  set_study(fields, config.study);
  fields.set("goal_x", start.goal.x(), 6).set("goal_y", start.goal.y(), 6);
  fields.set("limit", config.limit);
  fields.set("contacts", config.contacts);
  fields.set("contact_seq", std::uint64_t{start.contact_seq});
  fields.set("shelf_contacts", start.shelf_count);
  fields.set("obstacle_contacts", start.obstacle_count);
  const TrialMonitorConfig& monitor = config.monitor;
  fields.set("obstacle_range", monitor.obstacle_range).set("shelf_range", monitor.shelf_range);
  fields.set("leave_margin", monitor.leave_margin).set("leave_time", monitor.leave_time);
  fields.set("center_range", monitor.center_range).set("arrival_range", monitor.arrival_range);
  std::string stuck;
  for (const CueKind kind : start.stuck)
    stuck += (stuck.empty() ? "" : ", ") + std::string(to_string(kind));
  fields.set("stuck_cues", stuck);
}

}  // namespace navvi_study::trial
