#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"

namespace navvi_config {

/// A sentence that names the source, the key and what is allowed.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Describe = std::function<void(Visitor&)>;

/// Reads `path` as one YAML document of at most 1 MiB. An empty file is an empty map.
/// \throws ConfigError if it is missing, too large, or not YAML (with the line).
[[nodiscard]] YAML::Node load_yaml(const std::filesystem::path& path);

/// Words of a command line such as "octomap/resolution:=0.1", which is the key `resolution` in the
/// map `octomap`.
/// \throws ConfigError if a word has no name, or a name is given twice or as value and as map
[[nodiscard]] YAML::Node read_words(const std::vector<std::string>& words);

void read_fields(const Describe& describe, const YAML::Node& node, const std::string& source);

/// Overlays `config` with the keys of `node`; keys that are absent keep their value.
/// \param source  name of the node in error sentences, such as a file's path
/// \throws ConfigError on an unknown or repeated key, a wrong type, or a value out of range;
/// `config` is then unchanged.
template <typename Config>
void read(Config& config, const YAML::Node& node, const std::string& source) {
  Config candidate = config;
  read_fields([&](Visitor& visit) { candidate.describe(visit); }, node, source);
  config = std::move(candidate);
}

/// One line of the parameter table in the documentation.
struct Row {
  std::string key;  ///< with its groups, such as haptics/range
  std::string default_value;
  std::string allowed;  ///< with the unit
  std::string help;
};

[[nodiscard]] std::vector<Row> table_of(const Describe& describe);

/// The rows as a table in Markdown.
[[nodiscard]] std::string markdown(const std::vector<Row>& rows);

/// The fields of `Config` with their defaults, in order of description.
template <typename Config>
[[nodiscard]] std::vector<Row> table() {
  Config config;
  return table_of([&](Visitor& visit) { config.describe(visit); });
}

/// Prints the table of `Config` if --parameters is the only argument. \return true if it did, and
/// the program is to end
template <typename Config>
[[nodiscard]] bool print_parameters(int argc, char** argv) {
  if (argc != 2 || std::string(argv[1]) != "--parameters") return false;
  std::cout << markdown(table<Config>());
  return true;
}

}  // namespace navvi_config
