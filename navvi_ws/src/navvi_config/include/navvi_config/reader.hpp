#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <navvi_files/printable.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"

namespace navvi_config {

/// A sentence that names the source, the key and what is allowed.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& sentence)
      : std::runtime_error(navvi_files::printable(sentence, true)) {}
};

using Describe = std::function<void(Visitor&)>;

/// Reads `path` as one YAML document of at most 1 MiB. An empty file is an empty map.
/// \throws ConfigError if it is missing, too large, or not YAML (with the line).
[[nodiscard]] YAML::Node load_yaml(const std::filesystem::path& path);

/// Words of a command line such as "octomap/resolution:=0.1", which is the key `resolution` in the
/// map `octomap`.
/// \throws ConfigError if a word has no name, or a name is given twice or as value and as map
[[nodiscard]] YAML::Node read_words(const std::vector<std::string>& words);

/// Puts `values` into the map `base`: maps are joined, anything else is replaced.
void overlay(YAML::Node base, const YAML::Node& values);

/// What becomes of parameters of earlier versions: files and records of before are read without
/// them, and a line on stderr names each.
enum class Removed { refused, ignored };

void read_fields(const Describe& describe, const YAML::Node& node, const std::string& source,
                 Removed removed = Removed::refused);

/// Overlays `config` with the keys of `node`; keys that are absent keep their value.
/// \param source  name of the node in error sentences, such as a file's path
/// \throws ConfigError on an unknown or repeated key, a wrong type, or a value out of range;
/// `config` is then unchanged.
template <typename Config>
void read(Config& config, const YAML::Node& node, const std::string& source,
          Removed removed = Removed::refused) {
  Config candidate = config;
  read_fields([&](Visitor& visit) { candidate.describe(visit); }, node, source, removed);
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

/// The rows as a list of objects with parameter, default, allowed and meaning.
[[nodiscard]] std::string json(const std::vector<Row>& rows);

/// The fields of `Config` with their defaults, in order of description.
template <typename Config>
[[nodiscard]] std::vector<Row> table() {
  Config config;
  return table_of([&](Visitor& visit) { config.describe(visit); });
}

/// The node on one line, as YAML.
[[nodiscard]] std::string one_line(const YAML::Node& node);

/// Answers a program that was called with --parameters: prints the table of `Config` as JSON, or,
/// of words that follow, such as haptics/range:=2, checks that `Config` takes them and prints them
/// as YAML. \param below  what the words are laid over, by the Config that they make \return its
/// exit code; nullopt if it was called otherwise
template <typename Config>
[[nodiscard]] std::optional<int> print_parameters(
    int argc, char** argv, const std::function<YAML::Node(const Config&)>& below = {}) {
  if (argc < 2 || std::string(argv[1]) != "--parameters") return std::nullopt;
  if (argc == 2) {
    std::cout << json(table<Config>()) << "\n";
    return 0;
  }
  try {
    Config config;
    const YAML::Node words = read_words({argv + 2, argv + argc});
    read(config, words, "the arguments");
    const YAML::Node all = below ? below(config) : YAML::Node(YAML::NodeType::Map);
    overlay(all, words);
    std::cout << one_line(all) << "\n";
    return 0;
  } catch (const ConfigError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}

}  // namespace navvi_config
