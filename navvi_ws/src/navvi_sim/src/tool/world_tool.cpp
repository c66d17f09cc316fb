// Lists, checks and shows worlds, without ROS: `./navvi world`.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <navvi_config/reader.hpp>
#include <navvi_files/json.hpp>
#include <sstream>

#include "navvi_sim/description/world_hash.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"
#include "occupancy/octree.hpp"
#include "picture/world_picture.hpp"
#include "read/layout_world.hpp"

namespace navvi_sim::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUsage =
    "world list                                   the worlds that have a name\n"
    "world check NAME|FILE [-o FILE.bt|FILE.ot] [--config FILE.yaml] [name:=value ...]   what a "
    "session "
    "makes\n"
    "      of it; -o saves its OctoMap\n"
    "world show NAME|FILE [-o FILE.svg] [--config FILE.yaml] [name:=value ...]   a picture;\n"
    "      --path and --turns, each \"X,Y X,Y ...\", m: the guide path. ./navvi adds it, and also "
    "takes FILE.png\n"
    "The names are those of sim_node's parameters, such as seed:=3, and for a layout also its "
    "own,\n"
    "such as length:=80; `./navvi parameters` lists them all. --config takes a file like those of "
    "sim_node.\n"
    "--json FILE, of list and check: the same for a program.\n";

/// A sentence on a wrong command.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The parameters that the command line may set.
struct ToolConfig {
  setup::SimNodeConfig session;
  std::optional<generate::LayoutConfig> layout;

  void describe(navvi_config::Visitor& visit) {
    session.describe(visit);
    if (layout) layout->describe(visit);
  }
};

/// What the command line asks for.
struct Words {
  std::vector<std::string> plain;       ///< the sub-command and what it is about
  std::vector<std::string> parameters;  ///< name:=value
  std::map<std::string, std::string> options;
  [[nodiscard]] std::optional<std::string> option(const std::string& name) const {
    const auto found = options.find(name);
    return found == options.end() ? std::nullopt : std::optional(found->second);
  }
};

struct Request {
  ToolConfig config;
  read::LoadedWorld loaded;
};

Words sort_out(const std::vector<std::string>& words) {
  Words sorted;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "-o" || word == "--config" || word == "--path" || word == "--turns" ||
        word == "--json") {
      if (++i == words.size()) throw UsageError(word + " needs a value after it");
      sorted.options[word] = words[i];
    } else if (word.find(":=") != std::string::npos) {
      sorted.parameters.push_back(word);
    } else {
      sorted.plain.push_back(word);
    }
  }
  return sorted;
}

Request load(const Words& words) {
  Request request;
  setup::SimNodeConfig& session = request.config.session;
  const std::string& spec = words.plain[1];
  if (const auto file = words.option("--config"))
    navvi_config::read(session, navvi_config::load_yaml(*file), *file,
                       navvi_config::Removed::ignored);
  auto source = read::layout_source(spec);
  if (source) request.config.layout = source->config;
  const YAML::Node given = navvi_config::read_words(words.parameters);
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

void write_file(const fs::path& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  file.close();
  if (!file) throw WorldError("the file '" + path.string() + "' cannot be written");
}

std::string rounded(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << std::fixed << value;
  return text.str();
}

std::string caption_of(const Request& request, const scenario::StartAndGoal& scenario) {
  return "seed " + std::to_string(request.config.session.seed) + ", world " +
         world_hash(request.loaded.world) + (scenario.note.empty() ? "" : "; ") + scenario.note;
}

/// How many things of each class there are, with and without routes.
std::map<std::string, int> counts_of(const WorldDescription& world) {
  std::map<std::string, int> counts;
  for (const Thing& thing : world.things)
    ++counts[std::string(to_string(thing.thing_class)) + (thing.route ? " on routes" : "")];
  return counts;
}

/// As print(), for a program.
navvi_files::JsonFields fields_of(const Request& request, const scenario::StartAndGoal& scenario) {
  using navvi_files::json_text;
  const WorldDescription& world = request.loaded.world;
  navvi_files::JsonFields fields;
  for (const auto& [what, number] : counts_of(world))
    fields.emplace_back(what, std::to_string(number));
  fields.emplace_back("world", json_text(world.name));
  fields.emplace_back("seed", std::to_string(request.config.session.seed));
  fields.emplace_back("world hash", json_text(world_hash(world)));
  fields.emplace_back("floor z m", rounded(world.floor_height, 3));
  fields.emplace_back("start x m, y m, yaw rad",
                      navvi_files::json_list({rounded(scenario.start.position.x(), 3),
                                              rounded(scenario.start.position.y(), 3),
                                              rounded(scenario.start.yaw, 3)}));
  fields.emplace_back("goal x m, y m", navvi_files::json_list({rounded(scenario.goal.x(), 3),
                                                               rounded(scenario.goal.y(), 3)}));
  return fields;
}

void print(const Request& request, const scenario::StartAndGoal& scenario) {
  const WorldDescription& world = request.loaded.world;
  for (const std::string& note : request.loaded.notes) std::cout << note << '\n';
  for (const auto& [what, number] : counts_of(world)) std::cout << number << ' ' << what << '\n';
  std::cout << world.name << ", " << caption_of(request, scenario)
            << "\nfloor at z = " << rounded(world.floor_height, 3) << " m\nstart "
            << rounded(scenario.start.position.x(), 3) << ","
            << rounded(scenario.start.position.y(), 3) << "," << rounded(scenario.start.yaw, 3)
            << " goal " << rounded(scenario.goal.x(), 3) << "," << rounded(scenario.goal.y(), 3)
            << '\n';
}

/// \param path  ends in .bt, for occupied and free alone, or .ot, for probabilities
void write_octomap(const fs::path& path, const occupancy::OccupancyMap& map) {
  std::ostringstream content;
  if (path.extension() == ".ot") {
    occupancy::octree_of(map)->write(content);
  } else {
    // As OcTree::writeBinary, without a tree in memory: 1.4 GB for a ground of 200 x 200 m.
    content << "# Octomap OcTree binary file\nid OcTree\nsize " << map.nodes() << "\nres "
            << map.resolution() << "\ndata\n";
    content.write(reinterpret_cast<const char*>(map.stream().data()),
                  static_cast<std::streamsize>(map.stream().size()));
  }
  write_file(path, content.str());
}

void check_octomap(const fs::path& path) {
  if (path.extension() != ".bt" && path.extension() != ".ot")
    throw UsageError("'" + path.string() + "' is no OctoMap file; allowed are .bt and .ot");
}

void check(const Words& words) {
  const auto out = words.option("-o");
  if (out) check_octomap(*out);
  const Request request = load(words);
  const setup::SimNodeConfig& session = request.config.session;
  const WorldDescription& world = request.loaded.world;
  const auto map = setup::map_of(session, world);
  const scenario::StartAndGoal scenario = setup::scenario_of(session, world, map);
  print(request, scenario);
  if (out) write_octomap(*out, map);
  if (const auto file = words.option("--json"))
    navvi_files::write_json(*file, fields_of(request, scenario));
}

/// Points in map, m. \param text  as in "1.5,2 3,-4"
std::vector<Eigen::Vector2d> points_in(const std::string& text) {
  std::vector<Eigen::Vector2d> points;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  char comma = 0;
  for (double x = 0.0, y = 0.0; stream >> x >> comma >> y && comma == ',';)
    points.emplace_back(x, y);
  if (!stream.eof())
    throw UsageError("cannot parse \"" + text + "\" as points; expected e.g. \"1.5,2 3,-4\"");
  return points;
}

void show(const Words& words) {
  const auto out = words.option("-o");
  const fs::path path = out.value_or(fs::path(words.plain[1]).stem().string() + ".svg");
  if (path.extension() != ".svg")
    throw UsageError("'" + path.string() + "' cannot be drawn; allowed is .svg");
  const Request request = load(words);
  const setup::SimNodeConfig& session = request.config.session;
  const WorldDescription& world = request.loaded.world;
  const scenario::StartAndGoal scenario =
      setup::scenario_of(session, world, setup::map_of(session, world));
  write_file(path,
             picture::world_picture(request.loaded.world, scenario, caption_of(request, scenario),
                                    {points_in(words.option("--path").value_or("")),
                                     points_in(words.option("--turns").value_or(""))}));
  print(request, scenario);
  if (!out) std::cout << path.string() << '\n';
}

void list(const Words& words) {
  navvi_files::JsonFields fields;
  for (const generate::Preset& known : generate::presets()) {
    std::ostringstream meaning;
    meaning << known.help << ", " << known.config.length << " x " << known.config.width << " m";
    std::cout << known.name << ": " << meaning.str() << '\n';
    fields.emplace_back(known.name, navvi_files::json_text(meaning.str()));
  }
  if (const auto file = words.option("--json")) navvi_files::write_json(*file, fields);
}

struct Command {
  const char* name;
  std::size_t words;  ///< with its name
  void (*run)(const Words&);
};

constexpr Command kCommands[] = {
    {"list", 1, list}, {"check", 2, check}, {"show", 2, show}};

void run(const Words& words) {
  const std::string name = words.plain.empty() ? "" : words.plain.front();
  if (words.option("-o") && name != "show" && name != "check")
    throw UsageError("-o belongs to world show and world check");
  if (words.option("--json") && name != "list" && name != "check")
    throw UsageError("--json belongs to world list and world check");
  for (const Command& command : kCommands) {
    if (name != command.name) continue;
    if (words.plain.size() > command.words)
      throw UsageError("unexpected argument \"" + words.plain[command.words] +
                       "\"; parameters look like name:=value");
    if (words.plain.size() == command.words) return command.run(words);
  }
  throw UsageError(std::string("allowed are:\n") + kUsage);
}

}  // namespace
}  // namespace navvi_sim::tool

int main(int argc, char** argv) {
  if (const auto code =
          navvi_config::print_parameters<navvi_sim::generate::LayoutConfig>(argc, argv))
    return *code;
  try {
    navvi_sim::tool::run(navvi_sim::tool::sort_out({argv + 1, argv + argc}));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "navvi: " << error.what() << '\n';
    return 2;
  }
}
