#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace tinyxml2 {
class XMLDocument;
}

namespace navvi_sim::read {

constexpr std::uintmax_t kMaxXmlBytes = 20'000'000;  ///< of a file that is read

/// An element of an XML file, with all that is in it.
struct XmlElement {
  std::string name;
  std::string text;  ///< without the space around it
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;
  std::shared_ptr<const std::string> file;  ///< that it stands in
  int line = 0;                             ///< in that file, from 1
  std::vector<std::string> repairs = {};    ///< of a root: what was read though it is no XML

  /// The first child of that name; null if there is none.
  [[nodiscard]] const XmlElement* child(const std::string& child_name) const;
  [[nodiscard]] std::vector<const XmlElement*> children_named(const std::string& child_name) const;
  /// The text of a child; empty if there is none.
  [[nodiscard]] std::string text_of(const std::string& child_name) const;
  /// Empty if there is none.
  [[nodiscard]] std::string attribute(const std::string& key) const;
  /// Takes the children of that name away, and puts this one in their place.
  void replace(XmlElement by);
  /// "a.world, line 12", for sentences.
  [[nodiscard]] std::string place() const;
};

/// As TinyXML, Gazebo 11's parser: attributes without quotes, and whatever follows the root.
/// \throws WorldError for a file that is missing, larger than 20 MB, or no XML, with the fault and
/// its line
[[nodiscard]] XmlElement read_xml(const std::filesystem::path& file);

/// The same of the content of a file. \return what was read though it is no XML
std::vector<std::string> parse_xml(const std::filesystem::path& file, std::string content,
                                   tinyxml2::XMLDocument& document);

/// Wrong is one place of a file, and what may be left out for it is what stands there.
class PlaceError : public WorldError {
 public:
  PlaceError(std::string at, std::string sentence)
      : WorldError(at + ": " + sentence),
        place(std::move(at)),
        what_is_wrong(std::move(sentence)) {}

  std::string place;  ///< as XmlElement::place() says it
  std::string what_is_wrong;
};

/// \throws PlaceError
[[noreturn]] void refuse(const XmlElement& element, const std::string& what);

}  // namespace navvi_sim::read
