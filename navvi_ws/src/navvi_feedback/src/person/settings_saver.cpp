#include "person/settings_saver.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace navvi_feedback::person {

SettingsSaver::SettingsSaver(std::optional<PersonFile> file) : file_(std::move(file)) {}

std::vector<SettingsSaver::Failure> SettingsSaver::update() {
  std::vector<Failure> failures;
  if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    collect(failures);
  if (unsaved_.empty() || saving_.valid()) return failures;
  const std::vector<std::string> words = std::exchange(unsaved_, {});
  if (file_) {
    saving_ = std::async(std::launch::async, [file = *file_, words] { file.save(words); });
  } else if (!std::exchange(told_, true)) {
    failures.push_back({CueKind::settings_not_kept, ""});
  }
  return failures;
}

std::vector<SettingsSaver::Failure> SettingsSaver::finish() {
  std::vector<Failure> failures;
  if (saving_.valid()) collect(failures);
  const std::vector<Failure> last = update();
  failures.insert(failures.end(), last.begin(), last.end());
  if (saving_.valid()) collect(failures);
  return failures;
}

void SettingsSaver::collect(std::vector<Failure>& failures) {
  try {
    saving_.get();
  } catch (const std::exception& error) {
    failures.push_back({CueKind::settings_not_saved, error.what()});
  }
}

}  // namespace navvi_feedback::person
