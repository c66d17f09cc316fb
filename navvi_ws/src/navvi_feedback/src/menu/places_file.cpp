#include "menu/places_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iomanip>
#include <map>
#include <navvi_files/files.hpp>
#include <navvi_types/limits.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cues/phrases.hpp"
#include "navvi_config/reader.hpp"

namespace navvi_feedback::menu {
namespace {

using navvi_config::ConfigError;

/// Where a sentence finds fault: file, line, and a key or nothing.
class Spot {
 public:
  explicit Spot(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void reject(const YAML::Node& at, const std::string& what) const {
    throw ConfigError(file_ + ", line " + std::to_string(at.Mark().line + 1) + ": " + what + ".");
  }

 private:
  std::string file_;
};

/// m
double read_coordinate(const Spot& spot, const YAML::Node& node, const std::string& key) {
  double value = 0.0;
  const bool read = node.IsScalar() && YAML::convert<double>::decode(node, value);
  if (!read || !std::isfinite(value) || std::abs(value) > navvi_types::kFarthest)
    spot.reject(node, "\"" + key + "\" must be a number of m, -100000 to 100000");
  return value;
}

std::string read_name(const Spot& spot, const YAML::Node& node) {
  if (!node.IsScalar() || !cues::is_place_name(node.Scalar()))
    spot.reject(node,
                "\"name\" cannot be spoken; allowed are letters and digits, in words of at "
                "most 20 bytes with one blank between two, at most 40 bytes in all");
  return node.Scalar();
}

/// The values of one place by key.
std::map<std::string, YAML::Node> keys_of(const Spot& spot, const YAML::Node& item) {
  if (!item.IsMap()) spot.reject(item, "a place must be a map of name, x and y");
  std::map<std::string, YAML::Node> keys;
  for (const auto& entry : item) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (key != "name" && key != "x" && key != "y")
      spot.reject(entry.first, "\"" + key + "\" is unknown; known are name, x and y");
    if (!keys.emplace(key, entry.second).second)
      spot.reject(entry.first, "\"" + key + "\" is given twice in a place; once is allowed");
  }
  for (const char* key : {"name", "x", "y"})
    if (keys.count(key) == 0)
      spot.reject(item, std::string("a place lacks \"") + key + "\"; it must have name, x and y");
  return keys;
}

NamedPlace read_place(const Spot& spot, const YAML::Node& item) {
  const std::map<std::string, YAML::Node> keys = keys_of(spot, item);
  return {read_name(spot, keys.at("name")),
          {read_coordinate(spot, keys.at("x"), "x"), read_coordinate(spot, keys.at("y"), "y")}};
}

/// Names that differ in capital letters alone sound the same.
std::string sound_of(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x80 ? static_cast<char>(std::tolower(byte)) : letter;
  });
  return name;
}

std::vector<NamedPlace> places_in(const YAML::Node& root, const Spot& spot) {
  if (root.IsNull()) return {};
  if (!root.IsSequence())
    spot.reject(root,
                "the file must be a list of places, such as - {name: packing table, x: 3, "
                "y: -1.5}");
  if (root.size() > kMostPlaces)
    spot.reject(root, "there are " + std::to_string(root.size()) + " places; allowed are " +
                          std::to_string(kMostPlaces));
  std::vector<NamedPlace> places;
  std::map<std::string, int> lines;
  for (const YAML::Node& item : root) {
    places.push_back(read_place(spot, item));
    const std::string& name = places.back().name;
    const auto [first, is_new] = lines.emplace(sound_of(name), item.Mark().line + 1);
    if (!is_new)
      spot.reject(item["name"], "\"name\" is \"" + name + "\", as in line " +
                                    std::to_string(first->second) +
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
         << "}\n";
  return text.str();
}

/// Such a text holds so many places.
bool holds(const std::string& text, std::size_t count, const Spot& spot) {
  try {
    return places_in(YAML::Load(text), spot).size() == count;
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
  return places_in(navvi_config::load_yaml(path), Spot(path.string()));
}

void add_places(const std::filesystem::path& path, const std::vector<NamedPlace>& places) {
  std::vector<NamedPlace> all = read_places(path);
  all.insert(all.end(), places.begin(), places.end());
  const Spot spot(path.string());
  std::string text = content_of(path) + text_of(places);
  // A list in brackets, or one that is indented, cannot go on with such lines.
  if (!holds(text, all.size(), spot)) text = text_of(all);
  if (!holds(text, all.size(), spot))
    throw std::runtime_error(path.string() + ": the new place makes the file unusable.");
  if (const auto problem = navvi_files::write_atomically(path, text))
    throw std::runtime_error("The place is not saved: " + *problem + ".");
}

bool sound_alike(const std::string& a, const std::string& b) { return sound_of(a) == sound_of(b); }

}  // namespace navvi_feedback::menu
