#include "read/model_places.hpp"

#include <algorithm>
#include <cstdlib>
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

}  // namespace

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
