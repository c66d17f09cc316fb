#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "generate/layout_config.hpp"
#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::generate {

/// A layout that is not built yet, with where each field was set, for sentences.
struct LayoutSource {
  std::string name;
  LayoutConfig config;
  std::string where;                          ///< a preset's name or a file
  std::map<std::string, std::string> places;  ///< "hall.yaml, line 7" by field

  /// \throws WorldError that begins with where the field stands that has to change
  [[nodiscard]] WorldDescription build(std::uint64_t seed) const;
};

/// Reads a layout from our own YAML:
///
///     name: my hall           # optional
///     preset: busy            # what it starts from; optional, easy if absent
///     layout:                 # what is different; the fields are LayoutConfig's
///       length: 80
///       forklifts: 8
///
/// \throws WorldError with file, line and what is allowed
[[nodiscard]] LayoutSource read_layout(const std::filesystem::path& file);

}  // namespace navvi_sim::generate
