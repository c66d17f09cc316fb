#pragma once

#include <map>
#include <string>
#include <vector>

#include "xml_element.hpp"

namespace navvi_sim {

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

  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  std::vector<std::string> sentences_;
  std::map<std::string, std::vector<std::string>> harmless_;  ///< names and lines by kind
};

}  // namespace navvi_sim
