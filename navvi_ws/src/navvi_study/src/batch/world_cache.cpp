#include "batch/world_cache.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

#include "trial/conditions.hpp"

namespace navvi_study::batch {
namespace {

namespace fs = std::filesystem;

/// The folder of a variable of the environment; empty if it is not absolute.
fs::path folder_of(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path folder = value == nullptr ? "" : value;
  return folder.is_absolute() ? folder : fs::path();
}

}  // namespace

std::optional<navvi_files::Cache> world_cache(std::uintmax_t megabytes) {
  if (megabytes == 0) return std::nullopt;
  fs::path folder = folder_of("XDG_CACHE_HOME");
  if (folder.empty() && !folder_of("HOME").empty()) folder = folder_of("HOME") / ".cache";
  const std::optional<std::string> build = trial::build_ids();
  if (folder.empty() || !build) return std::nullopt;
  return navvi_files::Cache({folder / "navvi" / "worlds", megabytes, *build + trial::processor()});
}

}  // namespace navvi_study::batch
