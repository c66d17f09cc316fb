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
  explicit Words(const std::filesystem::path& phrases);

  /// \param key  section and key, such as "picture/wait"; empty: the file lacks it
  [[nodiscard]] std::string of(const std::string& key) const;
  /// What is said of this kind of cue, where nothing else is put into it.
  /// \param keyboard  the hands are on the arrow keys
  [[nodiscard]] std::string said(navvi_types::CueKind kind, bool keyboard) const;

 private:
  std::map<std::string, std::string> texts_;
};

}  // namespace navvi_rviz::status
