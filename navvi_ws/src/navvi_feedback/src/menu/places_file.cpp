#include "navvi_feedback/menu/places_file.hpp"

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <map>
#include <navvi_files/files.hpp>
#include <navvi_types/limits.hpp>
#include <sstream>
#include <stdexcept>

#include "cues/phrases.hpp"
#include "navvi_config/reader.hpp"

namespace navvi_feedback::menu {
namespace {

using navvi_config::ConfigError;

[[noreturn]] void reject(const std::string& file, const YAML::Node& at, const std::string& what) {
  throw ConfigError(file + ", line " + std::to_string(at.Mark().line + 1) + ": " + what + ".");
}

NamedPlace read_place(const std::string& file, const YAML::Node& item) {
  constexpr navvi_config::Range kWithin{-navvi_types::kFarthest, navvi_types::kFarthest};
  NamedPlace place;
  std::string task = "drive";
  const auto describe = [&](navvi_config::Visitor& visit) {
    visit(place.name, "name", navvi_config::Any{}, "", "as it is spoken");
    visit(place.at.x(), "x", kWithin, "m", "in map");
    visit(place.at.y(), "y", kWithin, "m", "in map");
    visit(task, "do", navvi_config::OneOf{{"drive", "pick", "drop", "scan"}}, "", "of a job");
  };
  navvi_config::read_fields(describe, item, file);
  place.task = navvi_types::from_word<navvi_types::TrialState::Task>(task).value();
  for (const char* key : {"name", "x", "y"})
    if (!item[key])
      reject(file, item, std::string("a place lacks \"") + key + "\"; it must have name, x and y");
  if (!cues::is_place_name(place.name))
    reject(file, item["name"],
           "\"name\" cannot be spoken; allowed are letters and digits, in words of at "
           "most 20 bytes with one blank between two, at most 40 bytes in all");
  return place;
}

std::string sound_of(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x80 ? static_cast<char>(std::tolower(byte)) : letter;
  });
  return name;
}

std::vector<NamedPlace> places_in(const YAML::Node& root, const std::string& file) {
  if (root.IsNull()) return {};
  if (!root.IsSequence())
    reject(file, root,
           "the file must be a list of places, such as - {name: packing table, x: 3, y: -1.5}");
  if (root.size() > kMostPlaces)
    reject(file, root, "there are " + std::to_string(root.size()) + " places; allowed are " +
                           std::to_string(kMostPlaces));
  std::vector<NamedPlace> places;
  std::map<std::string, int> lines;
  for (const YAML::Node& item : root) {
    places.push_back(read_place(file, item));
    const std::string& name = places.back().name;
    const auto [first, is_new] = lines.emplace(sound_of(name), item.Mark().line + 1);
    if (!is_new)
      reject(file, item["name"],
             "\"name\" is \"" + name + "\", as in line " + std::to_string(first->second) +
                 "; allowed are names that differ in more than capital letters");
  }
  return places;
}

/// The text of a file with these places.
std::string text_of(const std::vector<NamedPlace>& places) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  for (const NamedPlace& place : places)
    text << "- {name: " << place.name << ", x: " << place.at.x() << ", y: " << place.at.y()
         << (place.task == navvi_types::TrialState::Task::drive
                 ? std::string()
                 : std::string(", do: ") + navvi_types::to_string(place.task))
         << "}\n";
  return text.str();
}

/// Such a text holds so many places.
bool holds(const std::string& text, std::size_t count, const std::string& file) {
  try {
    return places_in(YAML::Load(text), file).size() == count;
  } catch (const YAML::Exception&) {
    return false;
  }
}

std::string content_of(const std::filesystem::path& path) {
  std::string text = navvi_files::read_file(path).value_or("");
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text;
}

}  // namespace

std::vector<NamedPlace> read_places(const std::filesystem::path& path) {
  return places_in(navvi_config::load_yaml(path), path.string());
}

void add_places(const std::filesystem::path& path, const std::vector<NamedPlace>& places) {
  std::vector<NamedPlace> all = read_places(path);
  all.insert(all.end(), places.begin(), places.end());
  std::string text = content_of(path) + text_of(places);
  // A list in brackets, or one that is indented, cannot go on with such lines.
  if (!holds(text, all.size(), path.string())) text = text_of(all);
  if (!holds(text, all.size(), path.string()))
    throw std::runtime_error(path.string() + ": the new place makes the file unusable.");
  if (const auto problem = navvi_files::write_atomically(path, text))
    throw std::runtime_error("The place is not saved: " + *problem + ".");
}

bool sound_alike(const std::string& a, const std::string& b) { return sound_of(a) == sound_of(b); }

}  // namespace navvi_feedback::menu
