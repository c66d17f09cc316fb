#pragma once

#include <string>

namespace navvi_study::trial {

/// What the nodes of this session call their topics and frames; for sentences.
struct SourceNames {
  std::string odometry = "/odom";
  std::string guidance = "/navvi/guidance";
  std::string octomap = "/octomap_binary";
  std::string grid = "/map";
  std::string map_frame = "map";
  std::string base_frame = "base_link";
};

}  // namespace navvi_study::trial
