#include "read/yaml_world.hpp"

#include <cmath>
#include <initializer_list>
#include <navvi_config/reader.hpp>
#include <set>
#include <sstream>

#include "description/sentence.hpp"
#include "description/validate.hpp"

namespace navvi_sim::read {
namespace {

constexpr std::size_t kMostItems = 50'000;
constexpr double kCoordinateLimit = 1e6;  // m or rad; worlds are held to less when validated

class Reader {
 public:
  explicit Reader(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] WorldDescription world(const YAML::Node& node) {
    check_kind(node);
    check_keys(node, {"name", "floor_height", "things"}, "the world");
    WorldDescription world;
    world.name = text(required(node, "name"), "the name of the world");
    if (const YAML::Node height = node["floor_height"])
      world.floor_height = number(height, "floor_height");
    const YAML::Node things = required(node, "things");
    if (!things.IsSequence() || things.size() == 0)
      refuse(things, "things must be a list of one or more");
    count(things, WorldLimits::things, "things");
    for (const YAML::Node& item : things) world.things.push_back(thing(item));
    return world;
  }

 private:
  [[noreturn]] void refuse(const YAML::Node& node, const std::string& what) const {
    const YAML::Mark mark = node.Mark();
    throw WorldError(file_.string() +
                     (mark.is_null() ? "" : ", line " + std::to_string(mark.line + 1)) + ": " +
                     what);
  }

  /// Refuses a file that is neither a layout nor a world.
  void check_kind(const YAML::Node& node) const {
    if (node.IsMap() && (node["things"] || node["floor_height"])) return;
    refuse(node,
           "this is neither a layout nor a world; allowed are the keys name, preset and layout for "
           "a layout, or name, floor_height and things for a world");
  }

  void check_keys(const YAML::Node& node, std::initializer_list<const char*> allowed,
                  const std::string& what) const {
    std::string words;
    for (const char* key : allowed) words += (words.empty() ? "" : ", ") + std::string(key);
    if (!node.IsMap()) refuse(node, what + " must be a map with keys out of: " + words);
    std::set<std::string> seen;
    for (const auto& entry : node) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
      bool known = false;
      for (const char* word : allowed) known = known || key == word;
      if (!known) refuse(entry.first, what + " has the key '" + key + "'; allowed are: " + words);
      if (!seen.insert(key).second) refuse(entry.first, what + " has the key '" + key + "' twice");
    }
  }

  /// An alias costs a file few bytes and the world all that it stands for: too many items are
  /// refused before they are read.
  void count(const YAML::Node& list, std::size_t most, const std::string& what) {
    if (list.size() > most)
      refuse(list, "there are " + std::to_string(list.size()) + " " + what +
                       " in a list; allowed are " + std::to_string(most));
    items_ += list.size();
    if (items_ > kMostItems)
      refuse(list,
             "the lists of things, shapes and way-points, with what aliases repeat, come to "
             "more than " +
                 std::to_string(kMostItems) + " items, the most allowed");
  }

  [[nodiscard]] YAML::Node required(const YAML::Node& node, const std::string& key) const {
    const YAML::Node value = node[key];
    if (!value) refuse(node, "'" + key + "' is missing");
    return value;
  }

  [[nodiscard]] std::string text(const YAML::Node& node, const std::string& what) const {
    if (!node.IsScalar() || node.Scalar().empty()) refuse(node, what + " must be a word");
    return printable(node.Scalar());
  }

  [[nodiscard]] double number(const YAML::Node& node, const std::string& what) const {
    double value = 0.0;
    try {
      if (node.IsScalar()) value = node.as<double>();
    } catch (const YAML::Exception&) {
      value = std::nan("");
    }
    if (!node.IsScalar() || !(std::abs(value) <= kCoordinateLimit))
      refuse(node, what + " must be a finite number");
    return value;
  }

  [[nodiscard]] bool truth(const YAML::Node& node, const std::string& what) const {
    if (!node.IsScalar() || (node.Scalar() != "true" && node.Scalar() != "false"))
      refuse(node, what + " must be true or false");
    return node.Scalar() == "true";
  }

  [[nodiscard]] std::vector<double> numbers(const YAML::Node& node,
                                            std::initializer_list<std::size_t> counts,
                                            const std::string& what) const {
    bool right = node.IsSequence();
    std::string allowed;
    bool any = false;
    for (const std::size_t count : counts) {
      any = any || (right && node.size() == count);
      allowed += (allowed.empty() ? "" : " or ") + std::to_string(count);
    }
    if (!right || !any) refuse(node, what + " must be a list of " + allowed + " numbers");
    std::vector<double> values;
    for (const YAML::Node& item : node) values.push_back(number(item, "each number of " + what));
    return values;
  }

  [[nodiscard]] Eigen::Isometry3d pose(const YAML::Node& node) const {
    std::vector<double> v = numbers(node, {3, 6}, "a pose");
    v.resize(6, 0.0);
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
    result.rotate(Eigen::AngleAxisd(v[5], Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(v[4], Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(v[3], Eigen::Vector3d::UnitX()));
    return result;
  }

  [[nodiscard]] Shape shape(const YAML::Node& node) const {
    check_keys(node, {"box", "cylinder", "sphere", "pose"}, "a shape");
    const std::size_t kinds =
        (node["box"] ? 1U : 0U) + (node["cylinder"] ? 1U : 0U) + (node["sphere"] ? 1U : 0U);
    if (kinds != 1) refuse(node, "a shape must be one of box, cylinder, sphere");
    Shape result;
    if (const YAML::Node box = node["box"]) {
      const std::vector<double> size = numbers(box, {3}, "the size of a box");
      result.geometry = Box{{size[0], size[1], size[2]}};
    } else if (const YAML::Node cylinder = node["cylinder"]) {
      const std::vector<double> size = numbers(cylinder, {2}, "radius and length of a cylinder");
      result.geometry = Cylinder{size[0], size[1]};
    } else {
      result.geometry = Sphere{number(node["sphere"], "the radius of a sphere")};
    }
    if (const YAML::Node where = node["pose"]) result.pose = pose(where);
    return result;
  }

  /// [x, y], or {at: [x, y], pause: s, speed: m/s}
  [[nodiscard]] Waypoint waypoint(const YAML::Node& node, double usual_pause) const {
    const bool plain = node.IsSequence();
    if (!plain) check_keys(node, {"at", "pause", "speed"}, "a way-point");
    const std::vector<double> at =
        numbers(plain ? node : required(node, "at"), {2}, "the place of a way-point");
    Waypoint result{{at[0], at[1]}, usual_pause};
    if (plain) return result;
    if (const YAML::Node pause = node["pause"]) result.pause = number(pause, "pause");
    if (const YAML::Node speed = node["speed"]) result.speed = number(speed, "speed");
    return result;
  }

  [[nodiscard]] Route route(const YAML::Node& node) {
    check_keys(node, {"waypoints", "speed", "pause", "loop", "delay", "yields"}, "a route");
    Route result;
    if (const YAML::Node speed = node["speed"]) result.speed = number(speed, "speed");
    if (const YAML::Node loop = node["loop"]) result.loop = truth(loop, "loop");
    if (const YAML::Node delay = node["delay"]) result.delay = number(delay, "delay");
    if (const YAML::Node yields = node["yields"]) result.yields = truth(yields, "yields");
    const YAML::Node pause = node["pause"];
    const double usual_pause = pause ? number(pause, "pause") : 0.0;
    const YAML::Node waypoints = required(node, "waypoints");
    if (!waypoints.IsSequence()) refuse(waypoints, "waypoints must be a list of [x, y]");
    count(waypoints, WorldLimits::waypoints, "way-points");
    for (const YAML::Node& item : waypoints)
      result.waypoints.push_back(waypoint(item, usual_pause));
    return result;
  }

  [[nodiscard]] Thing thing(const YAML::Node& node) {
    check_keys(node, {"name", "class", "pose", "shapes", "route"}, "a thing");
    Thing result;
    result.name = text(required(node, "name"), "the name of a thing");
    const YAML::Node word = required(node, "class");
    const auto thing_class = navvi_types::from_word<ThingClass>(text(word, "a class"));
    if (!thing_class)
      refuse(word, "'" + word.Scalar() + "' is no class; allowed are " + thing_class_words());
    result.thing_class = *thing_class;
    if (const YAML::Node where = node["pose"]) result.pose = pose(where);
    const YAML::Node shapes = required(node, "shapes");
    if (!shapes.IsSequence() || shapes.size() == 0)
      refuse(shapes, "shapes must be a list of one or more");
    count(shapes, WorldLimits::shapes_per_thing, "shapes");
    for (const YAML::Node& item : shapes) result.shapes.push_back(shape(item));
    if (const YAML::Node way = node["route"]) result.route = route(way);
    return result;
  }

  std::filesystem::path file_;
  std::size_t items_ = 0;  ///< of all lists so far
};

}  // namespace

WorldDescription read_yaml_world(const std::filesystem::path& file) {
  try {
    return Reader(file).world(navvi_config::load_yaml(file));
  } catch (const navvi_config::ConfigError& error) {
    throw WorldError(error.what());
  } catch (const YAML::Exception& error) {
    throw WorldError(file.string() + ", line " + std::to_string(error.mark.line + 1) +
                     ": no YAML that a world can be read from: " + error.msg);
  }
}

}  // namespace navvi_sim::read
