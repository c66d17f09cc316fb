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

/// Makes XML of what TinyXML takes for it.
class Repair {
 public:
  explicit Repair(const std::string& content) : content_(content) {
    fixed_.reserve(content.size());
  }

  void run() {
    while (at_ < content_.size() && !ended_) {
      const std::size_t begin = std::min(content_.size(), content_.find('<', at_));
      copy_to(begin);
      if (begin == content_.size()) return;
      count();
      if (begins("<!--"))
        copy_past("-->");
      else if (begins("<![CDATA["))
        copy_past("]]>");
      else if (begins("<?"))
        copy_past("?>");
      else if (begins("<!"))
        copy_past(">");
      else
        copy_tag();
    }
    note_rest();
  }
  [[nodiscard]] const std::string& fixed() const { return fixed_; }
  [[nodiscard]] std::vector<std::string> repairs() const { return repairs_; }
  /// A sentence if the file asks for more than a world needs; else empty.
  [[nodiscard]] const std::string& excess() const { return excess_; }

 private:
  static constexpr std::size_t kMostAttributes = 1'000;  // tinyxml2 looks through all for each
  static constexpr std::size_t kMostTags = 2'000'000;    // and takes some 100 bytes for each

  [[nodiscard]] bool begins(const char* word) const {
    return content_.compare(at_, std::char_traits<char>::length(word), word) == 0;
  }
  void copy_to(std::size_t end) {
    fixed_.append(content_, at_, end - at_);
    at_ = end;
  }
  void copy_past(const char* end) {
    const std::size_t found = content_.find(end, at_);
    copy_to(found == std::string::npos ? content_.size()
                                       : found + std::char_traits<char>::length(end));
  }
  [[nodiscard]] std::string line() {
    for (; counted_ < at_; ++counted_) line_ += content_[counted_] == '\n' ? 1U : 0U;
    return "line " + std::to_string(line_);
  }

  /// A tag, a comment or an attribute.
  void count() {
    if (++tags_ == kMostTags)
      excess_ = line() + ": there are " + std::to_string(kMostTags) +
                " tags, comments and attributes or more; allowed are fewer";
  }
  /// From '<' to '>'.
  void copy_tag() {
    const bool closes = begins("</");
    std::size_t attributes = 0;
    while (at_ < content_.size() && content_[at_] != '>') {
      const std::size_t next = content_.find_first_of("=>", at_);
      copy_to(next == std::string::npos ? content_.size() : next);
      if (at_ == content_.size() || content_[at_] == '>') break;
      copy_to(std::min(content_.size(), content_.find_first_not_of(" \t\r\n", at_ + 1)));
      count();
      if (++attributes == kMostAttributes)
        excess_ = line() + ": an element has " + std::to_string(kMostAttributes) +
                  " attributes or more; allowed are fewer";
      if (at_ < content_.size()) copy_value();
    }
    const bool empty = at_ > 0 && at_ < content_.size() && content_[at_ - 1] == '/';
    copy_to(std::min(content_.size(), at_ + 1));
    depth_ += closes ? -1 : empty ? 0 : 1;
    ended_ = depth_ <= 0;
  }
  void copy_value() {
    if (content_[at_] == '"' || content_[at_] == '\'') {
      const std::size_t end = content_.find(content_[at_], at_ + 1);
      copy_to(end == std::string::npos ? content_.size() : end + 1);
      return;
    }
    const std::size_t end = std::min(content_.size(), content_.find_first_of(" \t\r\n/>\"'<", at_));
    if (end == at_) return;
    repairs_.push_back(line() + ": an attribute has no quotes around " +
                       shortened(printable(content_.substr(at_, end - at_))));
    fixed_ += '"';
    copy_to(end);
    fixed_ += '"';
  }
  /// Comments may follow the root.
  void note_rest() {
    while (true) {
      at_ = std::min(content_.size(), content_.find_first_not_of(" \t\r\n", at_));
      if (!begins("<!--")) break;
      const std::size_t end = content_.find("-->", at_);
      at_ = end == std::string::npos ? content_.size() : end + 3;
    }
    if (at_ < content_.size())
      repairs_.push_back(line() + ": what follows the root element is left out");
  }

  const std::string& content_;
  std::size_t at_ = 0;
  std::string fixed_;
  std::vector<std::string> repairs_;
  std::string excess_;
  std::size_t tags_ = 0;
  std::size_t counted_ = 0, line_ = 1;  ///< up to where, and the line there
  int depth_ = 0;
  bool ended_ = false;  ///< the root is closed
};

/// What tinyxml2 calls the fault, in words.
std::string fault(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "it is empty, or begins with a zero";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "its elements are nested too deep";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed, or closed twice";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute has no value, is not closed, or is given twice in its element";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "a text does not end: no element follows it";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment is not closed";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "a CDATA section is not closed";
    default:
      return "an element's tag is malformed";
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

void XmlElement::replace(XmlElement by) {
  children.erase(std::remove_if(children.begin(), children.end(),
                                [&](const XmlElement& one) { return one.name == by.name; }),
                 children.end());
  children.push_back(std::move(by));
}

std::string XmlElement::place() const { return *file + ", line " + std::to_string(line); }

std::vector<std::string> parse_xml(const std::filesystem::path& file, std::string content,
                                   tinyxml2::XMLDocument& document) {
  blank_late_declaration(content);
  Repair repair(content);
  repair.run();
  if (!repair.excess().empty()) throw WorldError(file.string() + ", " + repair.excess());
  document.Parse(repair.fixed().data(), repair.fixed().size());
  if (document.Error() || document.RootElement() == nullptr)
    throw WorldError(
        file.string() +
        (document.ErrorLineNum() > 0 ? ", line " + std::to_string(document.ErrorLineNum())
                                     : std::string()) +
        ": this is not XML: " + fault(document) +
        (content.find("<%") != std::string::npos ? "; it looks like a template of ERB: "
                                                   "run erb first"
                                                 : "; allowed is one whole document"));
  return repair.repairs();
}

XmlElement read_xml(const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  std::vector<std::string> repairs = parse_xml(file, content_of(file), document);
  XmlElement root =
      copy_of(*document.RootElement(), std::make_shared<const std::string>(file.string()));
  root.repairs = std::move(repairs);
  return root;
}

void refuse(const XmlElement& element, const std::string& what) {
  throw PlaceError(element.place(), what);
}

}  // namespace navvi_sim::read
