#include "navvi_sim/world_source.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "navvi_sim/sdf_world.hpp"
#include "navvi_sim/validate.hpp"
#include "navvi_sim/yaml_world.hpp"

namespace navvi_sim {
namespace {

constexpr const char* kAllowed =
    "; allowed are 'warehouse' and files that end in .yaml, .yml, .sdf or .world";

LoadedWorld load(const std::string& spec, const std::string& models, std::uint64_t seed,
                 const WarehouseConfig& config, const std::string& classes) {
  if (spec == "warehouse") return {warehouse(seed, config), {}};
  const std::filesystem::path file(spec);
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool is_yaml = ending == ".yaml" || ending == ".yml";
  const bool is_sdf = ending == ".sdf" || ending == ".world";
  if (!is_yaml && !is_sdf) throw WorldError("'" + spec + "' is no world" + kAllowed);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw WorldError("the world file '" + spec + "' does not exist or is no file" + kAllowed);
  if (is_yaml) return {read_yaml_world(file), {}};
  return read_sdf_world(file, folders(models),
                        classes.empty() ? ClassRules::standard() : ClassRules::read(classes));
}

}  // namespace

std::vector<std::filesystem::path> folders(const std::string& colon_separated) {
  std::vector<std::filesystem::path> result;
  std::istringstream stream(colon_separated);
  for (std::string item; std::getline(stream, item, ':');)
    if (!item.empty()) result.emplace_back(item);
  return result;
}

LoadedWorld load_world(const std::string& spec, const std::string& models, std::uint64_t seed,
                       const WarehouseConfig& warehouse, const std::string& classes) {
  LoadedWorld loaded = load(spec, models, seed, warehouse, classes);
  try {
    validate(loaded.world);
  } catch (const WorldError& error) {
    throw WorldError(spec + ": " + error.what());
  }
  return loaded;
}

}  // namespace navvi_sim
