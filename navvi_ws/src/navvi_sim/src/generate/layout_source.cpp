#include "generate/layout_source.hpp"

#include <navvi_config/reader.hpp>

#include "generate/layout.hpp"

namespace navvi_sim::generate {
namespace {

/// The file as a whole.
struct LayoutFile {
  std::string name;
  std::string start = "easy";
  LayoutConfig config;

  void describe(navvi_config::Visitor& visit) {
    navvi_config::OneOf words;
    for (const Preset& known : presets()) words.words.push_back(known.name);
    visit(name, "name", navvi_config::Any{}, "", "of the world; empty: the file's");
    visit(start, "preset", words, "", "what the layout starts from");
    visit.group("layout", config);
  }
};

}  // namespace

WorldDescription LayoutSource::build(std::uint64_t seed) const {
  try {
    return layout(name, config, seed);
  } catch (const LayoutError& error) {
    const auto place = places.find(error.key());
    throw WorldError((place != places.end() ? place->second : where) + ": " + error.what());
  }
}

LayoutSource read_layout(const std::filesystem::path& file) {
  try {
    const YAML::Node node = navvi_config::load_yaml(file);
    if (!node.IsMap() || !(node["layout"] || node["preset"]))
      throw WorldError(file.string() +
                       ": this is not a layout; it needs preset or layout, and may have name");
    LayoutFile content;
    navvi_config::read(content, node, file.string(), navvi_config::Removed::ignored);
    // Once more: what the file sets goes on top of the preset that it names.
    content.config = preset(content.start).value();
    navvi_config::read(content, node, file.string(), navvi_config::Removed::ignored);
    LayoutSource source{content.name.empty() ? file.stem().string() : content.name,
                        content.config,
                        file.string(),
                        {}};
    if (node["layout"] && node["layout"].IsMap())
      for (const auto& field : node["layout"])
        source.places[field.first.Scalar()] =
            file.string() + ", line " + std::to_string(field.first.Mark().line + 1);
    return source;
  } catch (const navvi_config::ConfigError& error) {
    throw WorldError(error.what());
  } catch (const YAML::Exception& error) {
    throw WorldError(file.string() + ", line " + std::to_string(error.mark.line + 1) +
                     ": cannot parse the layout as YAML: " + error.msg);
  }
}

}  // namespace navvi_sim::generate
