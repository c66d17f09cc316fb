// The program behind `./navvi world`, without ROS. It prints JSON:
// world_tool list: the worlds that have a name.
// world_tool check WORLD [name:=value ...]: the content of a world, its start and goal. The names
// are sim_node's parameters, for a layout also its own, and those of ToolConfig.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <navvi_config/reader.hpp>
#include <navvi_files/json.hpp>
#include <navvi_types/motion.hpp>
#include <sstream>

#include "description/floor_height.hpp"
#include "description/footprint.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"
#include "occupancy/octree.hpp"
#include "read/layout_world.hpp"

namespace navvi_sim::tool {
namespace {

namespace fs = std::filesystem;

using namespace navvi_files;

/// The parameters that the command line may set.
struct ToolConfig {
  setup::SimNodeConfig session;
  std::optional<generate::LayoutConfig> layout;
  std::string config, octomap;
  bool drawing = false;

  void describe(navvi_config::Visitor& visit) {
    using navvi_config::Any;
    session.describe(visit);
    if (layout) layout->describe(visit);
    visit(config, "config", Any{}, "", "a YAML file of parameters, like those of sim_node");
    visit(octomap, "save", Any{}, "", "the file of its OctoMap, .bt or .ot");
    visit(drawing, "drawing", Any{}, "", "whether to print the shapes of all things as well");
  }
};

struct Request {
  ToolConfig config;
  read::LoadedWorld loaded;
};

Request load(const std::string& spec, const std::vector<std::string>& words) {
  Request request;
  setup::SimNodeConfig& session = request.config.session;
  const YAML::Node given = navvi_config::read_words(words);
  if (given["config"]) {
    const auto file = given["config"].as<std::string>();
    navvi_config::read(session, navvi_config::load_yaml(file), file,
                       navvi_config::Removed::ignored);
  }
  auto source = read::layout_source(spec);
  if (source) request.config.layout = source->config;
  navvi_config::read(request.config, given, "the command line");
  session.world = spec;
  if (!source) {
    request.loaded = setup::load_world(session);
    return request;
  }
  source->config = *request.config.layout;
  for (const auto& entry : given) source->places[entry.first.Scalar()] = "the command line";
  request.loaded =
      read::load_world(*source, static_cast<std::uint64_t>(session.seed), session.worker_choice());
  return request;
}

/// \param digits  after the point
template <typename Vector>
std::string json_of(const Vector& values, int digits = 3) {
  std::vector<std::string> numbers;
  for (const double value : values) numbers.push_back(json_number(value, digits));
  return json_list(numbers);
}

/// The corners of each shape in map, m, and of a mesh the triangles between them.
std::string drawing_of(const Thing& thing) {
  std::vector<std::string> shapes, stops;
  for (const Shape& shape : thing.shapes) {
    Eigen::Isometry3d pose = thing.pose * shape.pose;
    if (std::holds_alternative<Sphere>(shape.geometry)) pose.linear().setIdentity();
    std::vector<std::string> points, triangles;
    for (const Eigen::Vector3d& point : hull_points(shape.geometry))
      points.push_back(json_of(Eigen::Vector3d(pose * point), 4));
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry))
      for (const auto& triangle : (*mesh)->triangles) triangles.push_back(json_of(triangle, 0));
    shapes.push_back(json_object({{"class", json_text(to_string(look_of(thing, shape)))},
                                  {"points", json_list(points)},
                                  {"triangles", json_list(triangles)}}));
  }
  if (thing.route)
    for (const Waypoint& stop : thing.route->waypoints)
      stops.push_back(json_of(Eigen::Vector3d(stop.at.x(), stop.at.y(), stop.pause)));
  return json_object({{"class", json_text(to_string(thing.thing_class))},
                      {"at", json_of(Eigen::Vector2d(thing.pose.translation().head<2>()))},
                      {"yaw", json_number(yaw_of(thing.pose))},
                      {"shapes", json_list(shapes)},
                      {"route", json_list(stops)},
                      {"loop", thing.route && thing.route->loop ? "true" : "false"}});
}

/// Things of each class, with and without routes.
std::string counts_of(const WorldDescription& world) {
  std::map<std::string, int> counts;
  for (const Thing& thing : world.things)
    ++counts[std::string(to_string(thing.thing_class)) + (thing.route ? " on routes" : "")];
  JsonFields fields;
  for (const auto& [what, number] : counts) fields.emplace_back(what, std::to_string(number));
  return json_object(fields);
}

JsonFields fields_of(const Request& request, const scenario::StartAndGoal& scenario) {
  const WorldDescription& world = request.loaded.world;
  std::vector<std::string> notes, things;
  for (const std::string& note : request.loaded.notes) notes.push_back(json_text(note));
  if (request.config.drawing)
    for (const Thing& thing : world.things) things.push_back(drawing_of(thing));
  const Pose2& start = scenario.start;
  return {{"counts", counts_of(world)},
          {"standing", std::to_string(standing_in(world).size())},
          {"world", json_text(world.name)},
          {"seed", std::to_string(request.config.session.seed)},
          {"world hash", json_text(world_hash(world))},
          {"floor z m", json_number(world.floor_height, 3)},
          {"start x m, y m, yaw rad",
           json_of(Eigen::Vector3d(start.position.x(), start.position.y(), start.yaw))},
          {"goal x m, y m", json_of(scenario.goal)},
          {"notes", json_list(notes)},
          {"scenario", json_text(scenario.note)},
          {"headroom m", json_number(navvi_types::kHeadroom, 3)},
          {"things", json_list(things)}};
}

/// \param path  ends in .bt, for occupied and free alone, or .ot, for probabilities
void write_octomap(const fs::path& path, const occupancy::OccupancyMap& map) {
  std::ofstream file(path, std::ios::binary);
  if (path.extension() == ".ot") {
    occupancy::octree_of(map)->write(file);
  } else {
    // As OcTree::writeBinary, without a tree in memory: 1.4 GB for a ground of 200 x 200 m.
    file << "# Octomap OcTree binary file\nid OcTree\nsize " << map.nodes() << "\nres "
         << map.resolution() << "\ndata\n";
    file.write(reinterpret_cast<const char*>(map.stream().data()),
               static_cast<std::streamsize>(map.stream().size()));
  }
  file.close();
  if (!file) throw WorldError("the file '" + path.string() + "' cannot be written");
}

JsonFields check(const std::string& world, const std::vector<std::string>& words) {
  const Request request = load(world, words);
  const setup::SimNodeConfig& session = request.config.session;
  const auto map = setup::map_of(session, request.loaded.world);
  const scenario::StartAndGoal scenario = setup::scenario_of(
      session, request.loaded.world, setup::voxels_of(session, request.loaded.world));
  if (!request.config.octomap.empty()) write_octomap(request.config.octomap, map);
  return fields_of(request, scenario);
}

JsonFields list() {
  JsonFields fields;
  for (const generate::Preset& known : generate::presets()) {
    std::ostringstream meaning;
    meaning << known.help << ", " << known.config.length << " x " << known.config.width << " m";
    fields.emplace_back(known.name, json_text(meaning.str()));
  }
  return fields;
}

JsonFields run(const std::vector<std::string>& words) {
  if (words.size() == 1 && words[0] == "list") return list();
  if (words.size() > 1 && words[0] == "check")
    return check(words[1], {words.begin() + 2, words.end()});
  throw std::runtime_error("allowed are: list, and check NAME|FILE [name:=value ...]");
}

}  // namespace
}  // namespace navvi_sim::tool

int main(int argc, char** argv) {
  if (const auto code =
          navvi_config::print_parameters<navvi_sim::generate::LayoutConfig>(argc, argv))
    return *code;
  try {
    std::cout << navvi_files::json_object(navvi_sim::tool::run({argv + 1, argv + argc})) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "navvi: " << error.what() << '\n';
    return 2;
  }
}
