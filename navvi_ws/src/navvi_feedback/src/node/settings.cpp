#include "node/settings.hpp"

#include <ros/ros.h>

#include <navvi_files/files.hpp>

namespace navvi_feedback::node {
namespace {

using Save = person::Saver<std::string>::Save;

std::optional<person::PersonFile> file_of(const NodeConfig& config) {
  if (config.person.empty()) return std::nullopt;
  return person::PersonFile::of<PersonConfig>(config.person);
}

/// A master may be far, or gone.
void tell_master(const std::vector<std::string>& words) {
  ros::master::setRetryTimeout(ros::WallDuration(1.0));
  for (const std::string& word : words) {
    const std::size_t end = word.find(":=");
    ros::param::set("~" + word.substr(0, end), word.substr(end + 2));
  }
}

}  // namespace

Settings::Settings(NodeConfig& config)
    : config_(config),
      file_(file_of(config)),
      saver_(file_ ? Save([file = *file_](const auto& words) { file.save(words); }) : Save(),
             {CueKind::settings, file_ ? About::not_saved : About::not_kept}),
      master_(tell_master, {}),
      places_([path = config.feedback->places](
                  const std::vector<menu::NamedPlace>& places) { menu::add_places(path, places); },
              CueKind::place_not_saved) {}

std::map<std::string, std::string> Settings::values() const {
  std::map<std::string, std::string> values;
  const auto describe = [this](navvi_config::Visitor& visit) { config_.describe(visit); };
  for (const navvi_config::Row& row : navvi_config::table_of(describe)) {
    const bool in_vain = (row.key == "drive/enable" && config_.input == "keyboard") ||
                         (row.key.rfind("sounds/", 0) == 0 && !config_.feedback->sounds.enabled) ||
                         (row.key.rfind("haptics/", 0) == 0 && !config_.feedback->haptics.enabled);
    if (!in_vain) values[row.key] = row.default_value;
  }
  return values;
}

void Settings::change(const std::string& word) {
  navvi_config::read(config_, navvi_config::read_words({word}), "the menu");
  master_.save(word);
  saver_.save(word);
}

void Settings::keep(const core::Output& told) {
  if (told.place) {
    ROS_INFO("Remembered as \"%s\": %.2f, %.2f m in map, in %s.", told.place->name.c_str(),
             told.place->at.x(), told.place->at.y(), config_.feedback->places.c_str());
    places_.save(*told.place);
  }
  // The last words of a session come without a lesson, and leave its record as it is.
  if (!config_.record.empty() && !told.record.empty() && recorded_ != told.record) {
    recorded_ = told.record;
    if (const auto problem = navvi_files::write_atomically(config_.record, told.record))
      ROS_ERROR("The results of the lesson are not kept: %s.", problem->c_str());
  }
  if (found_ == told.settings) return;
  found_ = told.settings;
  for (const std::string& word : found_) {
    ROS_INFO("Found: feedback/%s", word.c_str());
    if (file_) saver_.save(word);
  }
}

std::vector<Content> Settings::cues_of(const std::vector<std::vector<person::Failure>>& all) {
  std::vector<Content> cues;
  for (const auto& failures : all)
    for (const auto& [cue, detail] : failures) {
      if (!detail.empty()) ROS_ERROR("%s", detail.c_str());
      saved_ = saved_ && (found_.empty() || cue != Content(CueKind::settings, About::not_saved));
      cues.push_back(cue);
    }
  return cues;
}

std::vector<Content> Settings::failures() {
  return cues_of({master_.update(), saver_.update(), places_.update()});
}
std::vector<Content> Settings::finish() { return cues_of({saver_.finish(), places_.finish()}); }

}  // namespace navvi_feedback::node
