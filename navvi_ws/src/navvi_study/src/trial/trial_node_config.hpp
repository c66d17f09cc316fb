#pragma once

#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "trial/trial_monitor.hpp"

namespace navvi_study::trial {

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
  bool press_to_start = false;
  bool record = true;
  double tail = 4.0;
  std::string odom_frame = "odom";
  TrialMonitorConfig monitor;

  void describe(navvi_config::Visitor& visit);
};

/// \throws std::runtime_error with a sentence for a text that must not stand in the record
void check(const TrialNodeConfig& config);

}  // namespace navvi_study::trial
