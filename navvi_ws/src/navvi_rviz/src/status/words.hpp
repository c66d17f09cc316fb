#pragma once

#include <filesystem>
#include <map>
#include <navvi_types/cue_kind.hpp>
#include <string>

namespace navvi_rviz::status {

/// The words of the picture, as the phrase file of the session has them.
class Words {
 public:
  Words() = default;
  /// \throws navvi_config::ConfigError if it cannot be read
  /// \param units  of lengths: meters or feet
  explicit Words(const std::filesystem::path& phrases, std::string units = "meters");

  /// \param key  section and key, such as "picture/wait"; empty: the file lacks it
  [[nodiscard]] std::string of(const std::string& key) const;
  /// What is said of this kind of cue, where nothing else is put into it.
  /// \param keyboard  the hands are on the arrow keys
  [[nodiscard]] std::string said(navvi_types::CueKind kind, bool keyboard) const;

  /// What is left to the goal, rounded as the voice does.
  /// \param metres  finite, >= 0
  [[nodiscard]] std::string to_go(double metres) const;

 private:
  std::string units_;
  std::map<std::string, std::string> texts_;
};

}  // namespace navvi_rviz::status
