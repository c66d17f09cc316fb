#pragma once

#include <map>
#include <string>
#include <vector>

#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// What an SDF world holds that is not taken over as it is.
class SdfNotes {
 public:
  /// Something that a person may miss: one sentence of its own, with the place.
  void add(const XmlElement& at, const std::string& sentence) { add(at.place(), sentence); }
  void add(const std::string& place, const std::string& sentence) {
    sentences_.push_back(place + ": " + sentence);
  }
  /// Something that changes nothing here, such as a light: named in one sentence for all.
  void add_harmless(const XmlElement& element);

  /// What a <world>, <model> or <link> holds beside what is read of it: harmless or not. Plugins of
  /// a model are left to read_plugins.
  void add_leftovers(const XmlElement& element);
  /// A plugin that is not run.
  /// \param whose  "of 'NAME' ", or empty for the world's
  void add_plugin(const XmlElement& plugin, const std::string& whose);

  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  std::vector<std::string> sentences_;
  std::map<std::string, std::vector<std::string>> harmless_;  ///< names and lines by kind
};

}  // namespace navvi_sim::read
