#include "person/person_file.hpp"

#include <cstdlib>
#include <navvi_files/files.hpp>
#include <regex>
#include <sstream>

namespace navvi_feedback::person {
namespace {

namespace fs = std::filesystem;
using navvi_config::ConfigError;

fs::path folder() {
  const auto value = [](const char* name) {
    const char* text = std::getenv(name);
    return std::string(text ? text : "");
  };
  if (const std::string people = value("NAVVI_PEOPLE"); !people.empty()) return people;
  if (const std::string home = value("HOME"); !home.empty())
    return fs::path(home) / ".navvi/people";
  throw ConfigError(
      "A person's settings have no place: neither NAVVI_PEOPLE nor HOME names a folder.");
}

}  // namespace

PersonFile::PersonFile(const std::string& name, navvi_config::Describe describe)
    : name_(name), describe_(std::move(describe)) {
  if (!std::regex_match(name, std::regex("[A-Za-z0-9][A-Za-z0-9_-]{0,23}")))
    throw ConfigError("\"" + name +
                      "\" is not a name for a person's settings; allowed are up to 24 letters, "
                      "digits, - and _, a letter or digit first.");
  path_ = folder() / (name + ".yaml");
}

YAML::Node PersonFile::load() const {
  std::error_code error;
  if (!fs::exists(path_, error) && !error) return YAML::Node(YAML::NodeType::Map);
  const YAML::Node values = navvi_config::load_yaml(path_);
  navvi_config::read_fields(describe_, values, path_.string(), navvi_config::Removed::ignored);
  return values.IsMap() ? values : YAML::Node(YAML::NodeType::Map);
}

void PersonFile::save(const std::vector<std::string>& words) const {
  const YAML::Node changes = navvi_config::read_words(words);
  navvi_config::read_fields(describe_, changes, "the settings of " + name_);
  YAML::Node values = load();
  navvi_config::overlay(values, changes);
  std::error_code failed;
  fs::create_directories(path_.parent_path(), failed);
  const std::string lost = "The settings of " + name_ + " are not kept: ";
  if (failed)
    throw std::runtime_error(lost + "cannot create " + path_.parent_path().string() + ": " +
                             failed.message() + ".");
  if (const auto problem = navvi_files::write_atomically(path_, text(values)))
    throw std::runtime_error(lost + *problem + ".");
}

std::string PersonFile::text(const YAML::Node& values) const {
  std::ostringstream out;
  out << "# Settings of " << name_
      << " in NavVI, instead of the profile's. What else can stand here: ./navvi parameters "
         "feedback\n";
  std::vector<std::string> groups;
  for (const navvi_config::Row& row : navvi_config::table_of(describe_)) {
    std::vector<std::string> keys;
    std::istringstream all(row.key);
    for (std::string key; std::getline(all, key, '/');) keys.push_back(key);
    YAML::Node value = values;
    for (const std::string& key : keys)
      value.reset(value.IsMap() ? value[key] : YAML::Node(YAML::NodeType::Undefined));
    if (!value.IsDefined()) continue;
    const auto indent = [](std::size_t depth) { return std::string(2 * depth, ' '); };
    bool same = true;
    for (std::size_t depth = 0; depth + 1 < keys.size(); ++depth) {
      same = same && depth < groups.size() && groups[depth] == keys[depth];
      if (!same) out << indent(depth) << keys[depth] << ":\n";
    }
    groups.assign(keys.begin(), keys.end() - 1);
    const std::string margin = indent(groups.size());
    out << margin << "# " << row.help;
    if (!row.allowed.empty()) out << "; " << row.allowed;
    out << "\n" << margin << keys.back() << ": " << navvi_config::one_line(value) << "\n";
  }
  return out.str();
}

}  // namespace navvi_feedback::person
