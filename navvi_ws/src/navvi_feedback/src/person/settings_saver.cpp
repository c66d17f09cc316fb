#include "person/settings_saver.hpp"

#include <utility>

namespace navvi_feedback::person {

SettingsSaver::SettingsSaver(std::optional<PersonFile> file) {
  if (file)
    saver_.emplace([file = *file](const std::vector<std::string>& words) { file.save(words); },
                   Content{CueKind::settings, About::not_saved});
}

void SettingsSaver::save(const std::string& word) {
  lost_ = !saver_;
  if (saver_) saver_->save(word);
}

std::vector<Failure> SettingsSaver::update() {
  if (saver_) return saver_->update();
  if (!lost_ || std::exchange(told_, true)) return {};
  return {{{CueKind::settings, About::not_kept}, ""}};
}

std::vector<Failure> SettingsSaver::finish() { return saver_ ? saver_->finish() : update(); }

}  // namespace navvi_feedback::person
