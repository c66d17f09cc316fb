// Shows, writes and lists worlds, without ROS: `./navvi world`.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <navvi_config/reader.hpp>
#include <sstream>

#include "navvi_sim/sdf_writer.hpp"
#include "navvi_sim/sim_node_config.hpp"
#include "navvi_sim/validate.hpp"
#include "navvi_sim/world_hash.hpp"
#include "navvi_sim/world_picture.hpp"
#include "xml_element.hpp"

namespace navvi_sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUsage =
    "world list                                        the worlds that have a name\n"
    "world show NAME|FILE [-o FILE.svg|FILE.png] [name:=value ...]   a picture from above\n"
    "world write NAME|FILE FILE.sdf [name:=value ...]  the world as SDF\n"
    "The names are those of sim_node's parameters, such as seed:=3, and for a layout also its "
    "own,\n"
    "such as length:=80; `./navvi parameters` tells them all.\n";

/// Sentences for who typed the command.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What may be said on the command line.
struct ToolConfig {
  SimNodeConfig session;
  std::optional<LayoutConfig> layout;

  void describe(navvi_config::Visitor& visit) {
    session.describe(visit);
    if (layout) layout->describe(visit);
  }
};

struct Request {
  ToolConfig config;
  LoadedWorld loaded;
};

/// "octomap/resolution:=0.1" is the key `resolution` in the map `octomap`.
YAML::Node read_words(const std::vector<std::string>& words) {
  YAML::Node all(YAML::NodeType::Map);
  for (const std::string& word : words) {
    const std::size_t split = word.find(":=");
    if (split == std::string::npos || split == 0)
      throw UsageError("\"" + word + "\" is no parameter; parameters look like name:=value");
    YAML::Node map = all;
    std::istringstream keys(word.substr(0, split));
    std::string key, last;
    std::getline(keys, last, '/');
    while (std::getline(keys, key, '/')) {
      if (map[last] && !map[last].IsMap())
        throw UsageError("\"" + last + "\" is given both as a value and as a group");
      map.reset(map[last]);
      last = key;
    }
    if (map[last]) throw UsageError("\"" + word.substr(0, split) + "\" is given twice");
    map[last] = word.substr(split + 2);
  }
  return all;
}

Request load(const std::string& spec, const std::vector<std::string>& words) {
  Request request;
  auto source = layout_source(spec);
  if (source) request.config.layout = source->config;
  const YAML::Node given = read_words(words);
  navvi_config::read(request.config, given, "the command line");
  request.config.session.world = spec;
  if (!source) {
    request.loaded = load_world(request.config.session);
    return request;
  }
  source->config = *request.config.layout;
  for (const auto& entry : given) source->places[entry.first.Scalar()] = "the command line";
  request.loaded.world = source->build(static_cast<std::uint64_t>(request.config.session.seed));
  validate(request.loaded.world);
  return request;
}

void write_file(const fs::path& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  file.close();
  if (!file) throw WorldError("the file '" + path.string() + "' cannot be written");
}

/// Turned into a PNG by librsvg's own tool.
void write_png(const fs::path& path, const std::string& svg) {
  std::string pattern = (fs::temp_directory_path() / "navvi_world_XXXXXX").string();
  const int descriptor = mkstemp(pattern.data());
  if (descriptor < 0) throw WorldError("no temporary file can be made for the picture");
  close(descriptor);
  write_file(pattern, svg);
  std::string program = "rsvg-convert", option = "-o", target = path.string();
  char* arguments[] = {program.data(), option.data(), target.data(), pattern.data(), nullptr};
  pid_t child = 0;
  int status = -1;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) == 0)
    waitpid(child, &status, 0);
  fs::remove(pattern);
  if (status != 0)
    throw WorldError("the picture cannot be written to '" + target +
                     "' by rsvg-convert (package librsvg2-bin); .svg needs no such tool");
}

std::string rounded(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << std::fixed << value;
  return text.str();
}

int show(const std::string& spec, const std::optional<std::string>& out,
         const std::vector<std::string>& words) {
  const fs::path path = out.value_or(fs::path(spec).stem().string() + ".svg");
  if (path.extension() != ".svg" && path.extension() != ".png")
    throw UsageError("'" + path.string() + "' is no picture; allowed are .svg and .png");
  const Request request = load(spec, words);
  const WorldDescription& world = request.loaded.world;
  const SimNodeConfig& config = request.config.session;
  const Scenario scenario = scenario_of(config, world, occupancy_of(world, config.octomap));
  const int count = turns(scenario.route);
  const std::string caption =
      "seed " + std::to_string(config.seed) + ", world " + world_hash(world) +
      (scenario.route.empty() ? ", no way from start to goal"
                              : ", way of " + rounded(scenario.route_length, 1) + " m with " +
                                    std::to_string(count) + (count == 1 ? " turn" : " turns"));
  const std::string svg = world_picture(world, scenario, caption);
  if (path.extension() == ".png")
    write_png(path, svg);
  else
    write_file(path, svg);
  for (const std::string& note : request.loaded.notes) std::cout << note << '\n';
  std::map<std::string, int> counts;
  for (const Thing& thing : world.things)
    ++counts[std::string(to_string(thing.thing_class)) + (thing.route ? " on routes" : "")];
  for (const auto& [what, number] : counts) std::cout << number << ' ' << what << '\n';
  std::cout << world.name << ", " << caption << "\nstart " << rounded(scenario.start.x, 2) << ","
            << rounded(scenario.start.y, 2) << "," << rounded(scenario.start.yaw, 3) << " goal "
            << rounded(scenario.goal.x(), 2) << "," << rounded(scenario.goal.y(), 2) << '\n'
            << path.string() << '\n';
  return 0;
}

int write(const std::string& spec, const fs::path& path, const std::vector<std::string>& words) {
  if (path.extension() != ".sdf" && path.extension() != ".world")
    throw UsageError("'" + path.string() + "' is no SDF file; allowed are .sdf and .world");
  const Request request = load(spec, words);
  std::string text = to_sdf(request.loaded.world);
  if (text.size() > kMaxXmlBytes) {
    text = to_sdf(request.loaded.world, false);
    std::cout << "without visuals, with which the file would be too large to be read back\n";
  }
  write_file(path, text);
  for (const std::string& note : request.loaded.notes) std::cout << note << '\n';
  std::cout << request.loaded.world.things.size() << " things in " << path.string() << '\n';
  return 0;
}

int list() {
  std::cout << "warehouse   the usual one, 50 x 30 m\n";
  for (const Preset& known : presets())
    std::cout << known.name << std::string(12 - known.name.size(), ' ') << known.help << ", "
              << known.config.length << " x " << known.config.width << " m\n";
  return 0;
}

int run(std::vector<std::string> words) {
  const std::string command = words.empty() ? "" : words.front();
  std::optional<std::string> out;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] != "-o") continue;
    if (command != "show" || i + 1 == words.size())
      throw UsageError("-o belongs to world show, with a file after it");
    out = words[i + 1];
    words.erase(words.begin() + static_cast<long>(i), words.begin() + static_cast<long>(i) + 2);
  }
  const auto after = [&](std::size_t count) {
    return std::vector<std::string>(words.begin() + static_cast<long>(count), words.end());
  };
  if (command == "list" && words.size() == 1) return list();
  if (command == "show" && words.size() >= 2) return show(words[1], out, after(2));
  if (command == "write" && words.size() >= 3) return write(words[1], words[2], after(3));
  throw UsageError(std::string("allowed are:\n") + kUsage);
}

}  // namespace
}  // namespace navvi_sim

int main(int argc, char** argv) {
  if (navvi_config::tells_parameters<navvi_sim::LayoutConfig>(argc, argv)) return 0;
  try {
    return navvi_sim::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "navvi: " << error.what() << '\n';
    return 2;
  }
}
