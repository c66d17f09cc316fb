#pragma once

#include <future>
#include <navvi_types/cue_kind.hpp>
#include <optional>
#include <string>
#include <vector>

#include "person/person_file.hpp"

namespace navvi_feedback::person {

using navvi_types::CueKind;

/// Saves what a person changes while driving, in a thread of its own: a disk may take seconds.
class SettingsSaver {
 public:
  struct Failure {
    CueKind cue;         ///< that says so
    std::string detail;  ///< a sentence for the log, or empty
  };

  /// \param file  without one, settings hold for the session alone, which is a failure once
  explicit SettingsSaver(std::optional<PersonFile> file);

  /// \param word  such as "speaker/rate:=300"; saved from the next update() on
  void save(const std::string& word) { unsaved_.push_back(word); }

  /// To be called often; does not wait.
  /// \return what has failed since the last call
  [[nodiscard]] std::vector<Failure> update();

  /// Waits until all is saved.
  [[nodiscard]] std::vector<Failure> finish();

 private:
  void collect(std::vector<Failure>& failures);

  std::optional<PersonFile> file_;
  std::vector<std::string> unsaved_;
  std::future<void> saving_;
  bool told_ = false;  ///< that nothing is kept
};

}  // namespace navvi_feedback::person
