#include "person/person_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <regex>
#include <sstream>
#include <string_view>

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

/// \return 0 or errno; with 0 the bytes are on the disk
int write_all(const fs::path& path, std::string_view bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return errno;
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written > 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (written == 0 || errno != EINTR)
      error = written == 0 ? EIO : errno;
  }
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

PersonFile::PersonFile(const std::string& name, navvi_config::Describe describe)
    : name_(name), describe_(std::move(describe)) {
  if (!std::regex_match(name, std::regex("[A-Za-z0-9][A-Za-z0-9_-]{0,23}")))
    throw ConfigError("\"" + name +
                      "\" is no name for a person's settings; allowed are up to 24 letters, "
                      "digits, - and _, a letter or digit first.");
  path_ = folder() / (name + ".yaml");
}

YAML::Node PersonFile::load() const {
  std::error_code error;
  if (!fs::exists(path_, error) && !error) return YAML::Node(YAML::NodeType::Map);
  const YAML::Node values = navvi_config::load_yaml(path_);
  navvi_config::read_fields(describe_, values, path_.string());
  return values.IsMap() ? values : YAML::Node(YAML::NodeType::Map);
}

void PersonFile::save(const std::vector<std::string>& words) const {
  const YAML::Node changes = navvi_config::read_words(words);
  navvi_config::read_fields(describe_, changes, "the settings of " + name_);
  YAML::Node values = load();
  navvi_config::overlay(values, changes);
  std::error_code failed;
  fs::create_directories(path_.parent_path(), failed);
  const fs::path fresh = path_.string() + "." + std::to_string(::getpid());
  int error = failed ? failed.value() : write_all(fresh, text(values));
  if (error == 0 && ::rename(fresh.c_str(), path_.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(fresh.c_str());
    throw std::runtime_error("The settings of " + name_ + " cannot be written to " +
                             path_.string() + ": " + std::strerror(error) + ".");
  }
  // That the new name lasts needs the folder on the disk, too; the old one would do no harm.
  const int parent = ::open(path_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (parent >= 0) {
    ::fsync(parent);
    ::close(parent);
  }
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
