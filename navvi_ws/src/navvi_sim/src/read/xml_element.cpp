#include "read/xml_element.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "description/sentence.hpp"

namespace navvi_sim::read {
namespace {

std::string trimmed(const std::string& text) {
  const char* space = " \t\r\n";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string content_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw WorldError(file.string() + " does not exist or is not a file; allowed are XML files");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (size > kMaxXmlBytes)
    throw WorldError(file.string() + " is larger than 20 MB; allowed is up to 20 MB");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (error || !stream) throw WorldError(file.string() + " cannot be read");
  return text.str();
}

XmlElement copy_of(const tinyxml2::XMLElement& source,
                   const std::shared_ptr<const std::string>& file) {
  XmlElement element;
  element.name = source.Name();
  element.file = file;
  element.line = source.GetLineNum();
  for (const auto* attribute = source.FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next())
    element.attributes.emplace(attribute->Name(), printable(attribute->Value()));
  std::string text;
  for (const auto* node = source.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (const auto* child = node->ToElement()) element.children.push_back(copy_of(*child, file));
    if (const auto* words = node->ToText()) text += words->Value();
  }
  element.text = trimmed(text);
  return element;
}

/// Blanks a declaration that stands after comments: older readers of SDF take it there, too.
void blank_late_declaration(std::string& content) {
  const auto skip_space = [&](std::size_t at) {
    return std::min(content.size(), content.find_first_not_of(" \t\r\n", at));
  };
  std::size_t at = skip_space(0);
  while (content.compare(at, 4, "<!--") == 0) {
    const std::size_t end = content.find("-->", at);
    if (end == std::string::npos) return;
    at = skip_space(end + 3);
  }
  const std::size_t end = content.find("?>", at);
  if (at == 0 || content.compare(at, 5, "<?xml") != 0 || end == std::string::npos) return;
  std::replace_if(
      content.begin() + static_cast<std::ptrdiff_t>(at),
      content.begin() + static_cast<std::ptrdiff_t>(end) + 2, [](char one) { return one != '\n'; },
      ' ');
}

/// What tinyxml2 calls the fault, in words.
std::string fault(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "it is empty, or begins with a zero";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "its elements are nested too deep";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed, or closed twice";
    default:
      return "an element, attribute or text is malformed";
  }
}

}  // namespace

const XmlElement* XmlElement::child(const std::string& child_name) const {
  for (const XmlElement& one : children)
    if (one.name == child_name) return &one;
  return nullptr;
}

std::vector<const XmlElement*> XmlElement::children_named(const std::string& child_name) const {
  std::vector<const XmlElement*> result;
  for (const XmlElement& one : children)
    if (one.name == child_name) result.push_back(&one);
  return result;
}

std::string XmlElement::text_of(const std::string& child_name) const {
  const XmlElement* one = child(child_name);
  return one == nullptr ? "" : one->text;
}

std::string XmlElement::attribute(const std::string& key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

std::string XmlElement::place() const { return *file + ", line " + std::to_string(line); }

XmlElement read_xml(const std::filesystem::path& file) {
  std::string content = content_of(file);
  blank_late_declaration(content);
  tinyxml2::XMLDocument document;
  document.Parse(content.data(), content.size());
  if (document.Error() || document.RootElement() == nullptr)
    throw WorldError(file.string() +
                     (document.ErrorLineNum() > 0
                          ? ", line " + std::to_string(document.ErrorLineNum())
                          : std::string()) +
                     ": is no XML (" + fault(document) + "); allowed is one whole XML document");
  return copy_of(*document.RootElement(), std::make_shared<const std::string>(file.string()));
}

void refuse(const XmlElement& element, const std::string& what) {
  throw PlaceError(element.place(), what);
}

}  // namespace navvi_sim::read
