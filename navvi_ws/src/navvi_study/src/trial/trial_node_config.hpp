#pragma once

#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "trial/trial_monitor.hpp"

namespace navvi_study::trial {

/// What the nodes of this session call their topics and frames; for sentences.
struct SourceNames {
  std::string odometry = "/odom";
  std::string guidance = "/navvi/guidance";
  std::string octomap = "/octomap_binary";
  std::string grid = "/map";
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  std::string link;  ///< empty: person and robot are not on two machines
};

/// Where a trial stands in a study's plan, as its summary has it.
struct StudyConfig {
  std::string name = "n/a";
  std::string plan = "n/a";
  std::string group = "n/a";
  std::string condition = "n/a";
  std::string phase = "n/a";
  std::string replaces = "n/a";
  int session = 0;
  int order = 0;
  int repeat = 0;
  int attempt = 0;

  void describe(navvi_config::Visitor& visit);
};

struct TrialNodeConfig {
  std::string out = "trials";
  double limit = 0.0;
  double patience = 60.0;
  std::string operator_kind = "unknown";
  std::string participant = "n/a";
  std::string profile = "default";
  std::string parameters;
  std::string version = "n/a";
  std::string contacts = "counted";
  std::vector<std::string> require;
  bool once = true;
  std::string job;
  bool press_to_start = false;
  std::string record = "here";
  double tail = 4.0;
  std::string odom_frame = "odom";
  bool locked = false;
  SourceNames sources;
  StudyConfig study;
  TrialMonitorConfig monitor;

  void describe(navvi_config::Visitor& visit);
};

/// \throws std::runtime_error with a sentence for a text that must not stand in the record
void check(const TrialNodeConfig& config);

}  // namespace navvi_study::trial
