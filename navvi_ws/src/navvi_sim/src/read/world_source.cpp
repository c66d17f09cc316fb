#include "navvi_sim/read/world_source.hpp"

#include <cstdlib>
#include <sstream>
#include <utility>

#include "description/sentence.hpp"
#include "description/validate.hpp"
#include "read/layout_world.hpp"
#include "read/model_places.hpp"
#include "read/sdf_world.hpp"

namespace navvi_sim::read {
namespace {

std::string allowed() {
  std::string words = "; allowed are ";
  for (const generate::Preset& known : generate::presets()) words += known.name + ", ";
  return words + "and files that end in .yaml, .yml, .sdf or .world";
}

enum class Kind { layout, sdf };

/// \throws WorldError if `spec` is no file that may hold a world
Kind kind_of(const std::string& spec) {
  const std::filesystem::path path(spec);
  // Of a file whose name is nothing but the ending, too.
  const auto last = path.has_extension() ? path.extension() : path.filename();
  const std::string ending = lower_case(last.string());
  const bool is_yaml = ending == ".yaml" || ending == ".yml";
  if (!is_yaml && ending != ".sdf" && ending != ".world")
    throw WorldError("'" + spec + "' is not a world" + allowed());
  std::error_code error;
  if (!std::filesystem::is_regular_file(spec, error))
    throw WorldError("the world file '" + spec + "' does not exist or is not a file" + allowed());
  return is_yaml ? Kind::layout : Kind::sdf;
}

/// Walking workers stand where their routes begin.
void stop_workers(WorldDescription& world) {
  for (Thing& thing : world.things)
    if (thing.thing_class == ThingClass::worker) thing.route.reset();
}

LoadedWorld build(generate::LayoutSource source, std::uint64_t seed, Workers workers) {
  if (workers == Workers::walking)
    source.config.walking_workers += std::exchange(source.config.standing_workers, 0);
  LoadedWorld loaded{source.build(seed), {}};
  if (workers == Workers::standing) stop_workers(loaded.world);
  return loaded;
}

/// \throws WorldError that begins with where the world comes from
LoadedWorld validated(LoadedWorld loaded, const std::string& where) {
  try {
    validate(loaded.world);
  } catch (const WorldError& error) {
    throw WorldError(where + ": " + error.what());
  }
  return loaded;
}

LoadedWorld load(const WorldRequest& request) {
  if (const auto source = layout_source(request.spec))
    return build(*source, request.seed, request.workers);
  return read_sdf_world(
      request.spec, model_places(request.models),
      request.classes.empty() ? ClassRules::standard() : ClassRules::read(request.classes),
      request.missing);
}

}  // namespace

std::optional<generate::LayoutSource> layout_source(const std::string& spec) {
  if (const auto config = generate::preset(spec))
    return generate::LayoutSource{spec, *config, spec, {}};
  if (kind_of(spec) != Kind::layout) return std::nullopt;
  return generate::read_layout(spec);
}

std::vector<std::filesystem::path> folders(const std::string& models) {
  std::vector<std::filesystem::path> result;
  const auto add = [&](const std::string& colon_separated, bool must_be) {
    std::istringstream stream(colon_separated);
    for (std::string item; std::getline(stream, item, ':');) {
      std::error_code error;
      if (item.empty()) continue;
      if (std::filesystem::is_directory(item, error))
        result.emplace_back(item);
      else if (must_be)
        throw WorldError("models: '" + item + "' is not a folder; allowed are folders that exist");
    }
  };
  add(models, true);
  for (const char* name :
       {"GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH"})
    if (const char* path = std::getenv(name)) add(path, false);
  return result;
}

LoadedWorld load_world(const WorldRequest& request) {
  return validated(load(request), request.spec);
}

LoadedWorld load_world(const generate::LayoutSource& source, std::uint64_t seed, Workers workers) {
  return validated(build(source, seed, workers), source.where);
}

}  // namespace navvi_sim::read
