#include "read/model_places.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "description/sentence.hpp"
#include "navvi_sim/read/world_source.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

fs::path from_environment(const char* name, const char* below = "") {
  const char* value = std::getenv(name);
  return value == nullptr || *value == '\0' ? fs::path() : fs::path(value) / below;
}

std::vector<fs::path> existing(const std::vector<fs::path>& folders) {
  std::vector<fs::path> result;
  std::error_code error;
  for (const fs::path& folder : folders)
    if (fs::is_directory(folder, error)) result.push_back(folder);
  return result;
}

/// The newest Gazebo comes first.
std::vector<fs::path> installed() {
  std::vector<fs::path> result;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/usr/share", error))
    if (entry.path().filename().string().rfind("gazebo", 0) == 0)
      result.push_back(entry.path() / "models");
  std::sort(result.rbegin(), result.rend());
  return result;
}

/// The parts of an address, with %20 as a space.
std::vector<std::string> parts_of(const std::string& address) {
  std::vector<std::string> parts;
  std::istringstream stream(address);
  for (std::string part; std::getline(stream, part, '/');) {
    for (std::size_t at = 0; (at = part.find("%20", at)) != std::string::npos;)
      part.replace(at, 3, " ");
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

/// The version asked for, or the newest one.
std::optional<fs::path> version_in(const fs::path& model, const std::string& wanted) {
  std::error_code error;
  long newest = -1;
  for (const auto& entry : fs::directory_iterator(model, error)) {
    const std::string name = entry.path().filename().string();
    if (name == wanted) return entry.path();
    if (!name.empty() && name.size() < 9 &&
        name.find_first_not_of("0123456789") == std::string::npos)
      newest = std::max(newest, std::stol(name));
  }
  const bool is_given = !wanted.empty() && wanted != "tip";
  if (is_given || newest < 0) return std::nullopt;
  return model / std::to_string(newest);
}

/// The nearest folder above a file that holds something of that name; empty if none does.
fs::path above(const fs::path& file, const char* name) {
  std::error_code error;
  for (fs::path folder = fs::absolute(file).parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    if (fs::exists(folder / name, error)) return folder;
  return {};
}

}  // namespace

std::map<std::string, fs::path> models_around(const fs::path& world_file) {
  constexpr int kMostEntries = 50'000;
  std::map<std::string, fs::path> models;
  fs::path root = above(world_file, ".git");
  if (root.empty()) root = above(world_file, "package.xml");
  std::error_code error;
  fs::recursive_directory_iterator entry(root, fs::directory_options::skip_permission_denied,
                                         error);
  for (int i = 0;
       !root.empty() && !error && entry != fs::recursive_directory_iterator() && i < kMostEntries;
       ++i, entry.increment(error)) {
    const fs::path& file = entry->path();
    if (file.filename() == ".git") entry.disable_recursion_pending();
    if (file.filename() == "model.config" || file.filename() == "model.sdf")
      models.emplace(file.parent_path().filename().string(), file.parent_path().parent_path());
  }
  return models;
}

std::vector<fs::path> exported_folders(const fs::path& world_file) {
  const fs::path package = above(world_file, "package.xml");
  if (package.empty()) return {};
  std::ostringstream text;
  text << std::ifstream(package / "package.xml").rdbuf();
  const std::string all = text.str();
  std::vector<fs::path> result;
  for (std::size_t at = 0; (at = all.find("gazebo_model_path", at)) != std::string::npos; ++at) {
    const std::size_t begin = all.find_first_of("\"'", at);
    if (begin == std::string::npos) break;
    std::istringstream stream(all.substr(begin + 1, all.find(all[begin], begin + 1) - begin - 1));
    for (std::string folder; std::getline(stream, folder, ':');) {
      const std::string prefix = "${prefix}";
      if (folder.rfind(prefix, 0) == 0) folder.replace(0, prefix.size(), package.string());
      std::error_code error;
      if (fs::is_directory(folder, error)) result.push_back(fs::path(folder).lexically_normal());
    }
  }
  return result;
}

ModelPlaces model_places(const std::string& models) {
  std::vector<fs::path> last{from_environment("HOME", ".gazebo/models")};
  for (fs::path& folder : installed()) last.push_back(std::move(folder));
  return {
      folders(models), existing(last),
      existing({from_environment("GZ_FUEL_CACHE_PATH"), from_environment("IGN_FUEL_CACHE_PATH"),
                from_environment("HOME", ".gz/fuel"), from_environment("HOME", ".ignition/fuel")})};
}

std::optional<fs::path> find_downloaded(const std::string& address,
                                        const std::vector<fs::path>& caches) {
  const std::vector<std::string> parts = parts_of(address);
  const auto kind = std::find(parts.begin(), parts.end(), "models");
  if (std::find(parts.begin(), parts.end(), "..") != parts.end() || kind - parts.begin() < 2 ||
      parts.end() - kind < 2)
    return std::nullopt;
  const std::string wanted = parts.end() - kind > 2 ? kind[2] : "";
  for (const fs::path& cache : caches)
    for (const std::string& host : {parts.front(), std::string("fuel.gazebosim.org"),
                                    std::string("fuel.ignitionrobotics.org")}) {
      const auto found = version_in(
          cache / host / lower_case(*(kind - 1)) / "models" / lower_case(kind[1]), wanted);
      if (!found) continue;
      fs::path file = *found;
      for (auto part = kind + std::min<std::ptrdiff_t>(4, parts.end() - kind); part != parts.end();
           ++part)
        file /= *part;  // what follows "files"
      std::error_code error;
      if (fs::exists(file, error)) return file;
    }
  return std::nullopt;
}

}  // namespace navvi_sim::read
