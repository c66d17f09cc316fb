#pragma once

#include <optional>
#include <string>
#include <vector>

#include "person/person_file.hpp"
#include "person/saver.hpp"

namespace navvi_feedback::person {

/// Saves what a person changes while driving.
class SettingsSaver {
 public:
  /// \param file  without one, settings hold for the session alone, which is a failure once
  explicit SettingsSaver(std::optional<PersonFile> file);

  /// \param word  such as "speaker/rate:=300"
  void save(const std::string& word);

  /// As Saver's.
  [[nodiscard]] std::vector<Failure> update();
  [[nodiscard]] std::vector<Failure> finish();

 private:
  std::optional<Saver<std::string>> saver_;
  bool lost_ = false;  ///< something is not kept
  bool told_ = false;  ///< that nothing is
};

}  // namespace navvi_feedback::person
