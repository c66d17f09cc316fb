#include "status/words.hpp"

#include <navvi_config/reader.hpp>
#include <navvi_types/spoken_length.hpp>
#include <utility>

namespace navvi_rviz::status {

Words::Words(const std::filesystem::path& phrases, std::string units) : units_(std::move(units)) {
  const YAML::Node root = navvi_config::load_yaml(phrases);
  for (const char* section : {"phrases", "words", "picture", "lessons"})
    if (const YAML::Node texts = root[section]; texts && texts.IsMap())
      for (const auto& text : texts)
        if (text.second.IsScalar())
          texts_[std::string(section) + "/" + text.first.Scalar()] = text.second.Scalar();
}

std::string Words::of(const std::string& key) const {
  const auto found = texts_.find(key);
  return found == texts_.end() ? "" : found->second;
}

std::string Words::said(navvi_types::CueKind kind, bool keyboard) const {
  const std::string place = "{stick}";
  std::string text = of(std::string("phrases/") + to_string(kind));
  if (const std::size_t at = text.find(place); at != std::string::npos)
    text.replace(at, place.size(), of(keyboard ? "words/key_stick" : "words/pad_stick"));
  return text;
}

std::string Words::to_go(double metres) const {
  const auto length = navvi_types::spoken_length(metres, units_);
  return length.number + " " + of(std::string("words/") + length.unit) + " " + of("picture/to_go");
}

}  // namespace navvi_rviz::status
