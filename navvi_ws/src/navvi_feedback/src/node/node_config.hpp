#pragma once

#include <filesystem>
#include <string>

#include "devices/mixer.hpp"
#include "devices/speaker.hpp"
#include "core/guide_config.hpp"

namespace navvi_feedback::node {

/// What suits one person and not another, and can be kept in their PersonFile.
struct PersonConfig {
  std::string language = "en";
  std::string phrases;  ///< path; empty for that of the language
  core::GuideConfig feedback;
  devices::SpeakerConfig speaker;
  devices::MixerConfig mixer;

  void describe(navvi_config::Visitor& visit);
};

struct NodeConfig : PersonConfig {
  std::string input = "auto";
  bool speech = true;
  std::string listener = "device";
  std::string motors = "joy_node";
  std::string odom_frame = "odom";
  std::string emergency_stop, battery;  ///< topics of the robot; empty: none
  std::string person;  ///< name of their PersonFile; empty for none
  std::string record;

  void describe(navvi_config::Visitor& visit);
  [[nodiscard]] std::filesystem::path phrases_file() const;
  /// The voice of the language, unless another one is wanted.
  [[nodiscard]] devices::SpeakerConfig voice() const;
};

}  // namespace navvi_feedback::node
