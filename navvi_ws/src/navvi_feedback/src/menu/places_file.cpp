#include "menu/places_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <navvi_types/limits.hpp>
#include <utility>

#include "cues/phrases.hpp"
#include "navvi_config/reader.hpp"

namespace navvi_feedback::menu {
namespace {

using navvi_config::ConfigError;

constexpr std::size_t kMostPlaces = 100;  // more, one after the other, nobody listens to
constexpr double kTurn = 6.2832;          // rad

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

double read_number(const Spot& spot, const YAML::Node& node, const std::string& key, double limit,
                   const std::string& allowed) {
  double value = 0.0;
  const bool read = node.IsScalar() && YAML::convert<double>::decode(node, value);
  if (!read || !std::isfinite(value) || std::abs(value) > limit)
    spot.reject(node, "\"" + key + "\" must be a number of " + allowed);
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
  if (!item.IsMap()) spot.reject(item, "a place must be a map of name, x, y and yaw");
  std::map<std::string, YAML::Node> keys;
  for (const auto& entry : item) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (key != "name" && key != "x" && key != "y" && key != "yaw")
      spot.reject(entry.first, "\"" + key + "\" is unknown; known are name, x, y and yaw");
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
  const auto coordinate = [&](const std::string& key) {
    return read_number(spot, keys.at(key), key, navvi_types::kFarthest, "m, -100000 to 100000");
  };
  if (const auto yaw = keys.find("yaw"); yaw != keys.end())
    static_cast<void>(read_number(spot, yaw->second, "yaw", kTurn, "rad, -6.2832 to 6.2832"));
  return {read_name(spot, keys.at("name")), {coordinate("x"), coordinate("y")}};
}

/// Names that differ in capital letters alone sound the same.
std::string sound_of(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x80 ? static_cast<char>(std::tolower(byte)) : letter;
  });
  return name;
}

}  // namespace

std::vector<NamedPlace> read_places(const std::filesystem::path& path) {
  const YAML::Node root = navvi_config::load_yaml(path);
  const Spot spot(path.string());
  if (!root.IsSequence())
    spot.reject(root,
                "the file must be a list of places, such as - {name: packing table, x: 3, "
                "y: -1.5, yaw: 0}");
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

}  // namespace navvi_feedback::menu
