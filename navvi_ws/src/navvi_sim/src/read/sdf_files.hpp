#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "read/model_places.hpp"
#include "read/sdf_notes.hpp"
#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// Finds the files that an SDF world speaks of, and puts its models together.
class SdfFiles {
 public:
  SdfFiles(const std::filesystem::path& world_file, ModelPlaces places);

  /// The file or folder of `uri`: model://..., file://..., the address of what was downloaded from
  /// Fuel, or a path, absolute or relative to `from` (a file). nullopt if there is none, or if a
  /// model:// leads out of the folders.
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& uri,
                                                          const std::filesystem::path& from) const;

  /// The <world> of the world file. In place of each <include> stands what is included, a <model>,
  /// <actor> or <light>, with the name, pose, placement frame and plugins that the include gives.
  /// \throws WorldError for a file that is not an SDF world, and for a model that is missing, that
  /// includes itself, or that is nested too deep
  [[nodiscard]] XmlElement world(SdfNotes& notes);

  /// Notes what was read of all files though it is no XML.
  void note_repairs(SdfNotes& notes) const;

  /// For an error sentence: the folders that were looked in, and how `uri` is found.
  [[nodiscard]] std::string looked_for(const std::string& uri) const;

 private:
  void expand(XmlElement& element, SdfNotes& notes, std::vector<std::filesystem::path>& chain);
  [[nodiscard]] std::optional<XmlElement> included(const XmlElement& include, SdfNotes& notes,
                                                   std::vector<std::filesystem::path>& chain);
  /// The sun or the ground plane, which Gazebo ships itself, so that worlds count on them. nullopt:
  /// it means nothing here
  [[nodiscard]] std::optional<XmlElement> stand_in(const XmlElement& include,
                                                   const std::string& uri, SdfNotes& notes);
  /// The file of a model that was found. \throws WorldError at `include` if it cannot be read
  [[nodiscard]] std::filesystem::path model_file(const XmlElement& include,
                                                 const std::filesystem::path& found);
  [[nodiscard]] const XmlElement& document(const std::filesystem::path& file);

  std::filesystem::path world_file_;
  ModelPlaces places_;
  std::vector<std::filesystem::path> folders_;  ///< of models, first come first served
  std::map<std::filesystem::path, XmlElement> documents_;
  std::map<std::filesystem::path, std::filesystem::path> model_files_;  ///< by the model's folder
  std::map<std::filesystem::path, std::string> broken_;  ///< models, and what is wrong with them
  mutable std::optional<std::map<std::string, std::filesystem::path>>
      nearby_;                ///< as models_around
  std::size_t elements_ = 0;  ///< of all that was put together
};

}  // namespace navvi_sim::read
