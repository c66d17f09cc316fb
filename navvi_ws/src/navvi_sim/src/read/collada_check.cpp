#include "read/collada_check.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "description/sentence.hpp"
#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {
namespace {

constexpr std::size_t kMostPieces = 100'000;  // assimp takes some 1.3 kB for each node
constexpr std::size_t kSearched = 1'000;      // nodes that are looked at in the time of one piece
constexpr std::size_t kDeepestNode = 200;
constexpr std::size_t kDeepestElement = 1000;
constexpr const char* kBlanks = " \t\r\n";

/// A start tag or an end tag.
struct Tag {
  std::string_view name;
  std::string_view attributes;
  bool opens = false;
  bool closes = false;
};

/// The value of an attribute; empty if there is none.
std::string value_of(std::string_view attributes, std::string_view name) {
  for (std::size_t at = 0; at < attributes.size();) {
    const std::size_t begin = attributes.find_first_not_of(kBlanks, at);
    const std::size_t equals = attributes.find('=', begin);
    const std::size_t quote = attributes.find_first_of("'\"", equals);
    if (quote == std::string_view::npos) return {};
    const std::size_t end = attributes.find(attributes[quote], quote + 1);
    if (end == std::string_view::npos) return {};
    std::string_view found = attributes.substr(begin, equals - begin);
    found = found.substr(0, found.find_first_of(kBlanks));
    if (found == name) return std::string(attributes.substr(quote + 1, end - quote - 1));
    at = end + 1;
  }
  return {};
}

/// The nodes of a Collada text, and what they unfold to.
class ColladaNodes {
 public:
  ColladaNodes(const std::filesystem::path& file, const std::string& text)
      : file_(file), text_(text) {}

  void check() {
    while (const std::optional<Tag> tag = next()) {
      if (tag->opens) open(*tag);
      if (tag->closes) close();
    }
    for (const std::size_t scene : scenes_) static_cast<void>(unfold(scene, 0));
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// A node, or a scene.
  struct Node {
    std::string id;
    std::string name;
    std::vector<std::size_t> children = {};
    std::vector<std::string> instances = {};  ///< ids of nodes
    std::size_t pieces = 1;                   ///< itself and its geometries; with all once unfolded
    std::size_t height = 0;                   ///< of the tree below, once unfolded
    enum class Unfolded { no, now, yes } unfolded = Unfolded::no;
  };

  [[noreturn]] void refuse(const std::string& what) const {
    throw WorldError("the mesh '" + file_.string() + "' " + what);
  }

  /// Passes over comments, instructions and plain characters.
  std::optional<Tag> next() {
    while ((at_ = text_.find('<', at_)) != std::string::npos) {
      const auto begins = [&](const char* word) {
        return text_.compare(at_, std::strlen(word), word) == 0;
      };
      const auto pass = [&](const char* end) {
        const std::size_t found = text_.find(end, at_);
        at_ = found == std::string::npos ? text_.size() : found + std::strlen(end);
      };
      if (begins("<!--"))
        pass("-->");
      else if (begins("<![CDATA["))
        pass("]]>");
      else if (begins("<?"))
        pass("?>");
      else if (begins("<!"))
        refuse("has a document type; allowed is Collada without one");
      else
        return tag();
    }
    return std::nullopt;
  }

  Tag tag() {
    const std::size_t begin = at_ + 1;
    char quote = 0;
    for (at_ = begin; at_ < text_.size() && (quote != 0 || text_[at_] != '>'); ++at_) {
      const char c = text_[at_];
      if (quote != 0 ? c == quote : c == '"' || c == '\'') quote = quote != 0 ? '\0' : c;
    }
    std::string_view inside = std::string_view(text_).substr(begin, at_ - begin);
    Tag tag;
    tag.closes = !inside.empty() && (inside.front() == '/' || inside.back() == '/');
    tag.opens = inside.empty() || inside.front() != '/';
    if (tag.opens && tag.closes) inside.remove_suffix(1);
    tag.name = inside.substr(0, inside.find_first_of(kBlanks));
    tag.attributes = inside.substr(tag.name.size());
    return tag;
  }

  /// What identifies a node; nobody needs an entity there but to hide one.
  std::string word_of(const Tag& tag, std::string_view attribute) const {
    const std::string word = value_of(tag.attributes, attribute);
    if (word.find('&') != std::string::npos)
      refuse("has a node with an entity in its '" + std::string(attribute) +
             "'; allowed are plain characters");
    return word;
  }

  /// Assimp reserves as much as is named, crashes on an array without its count, and reads a word
  /// among indices again and again until no memory is left.
  void check_numbers(const Tag& tag) const {
    constexpr const char* kDigits = "0123456789";
    const std::string name = shortened(printable(std::string(tag.name)));
    const std::string count = value_of(tag.attributes, "count");
    const bool whole = !count.empty() && count.find_first_not_of(kDigits) == std::string::npos;
    const std::size_t end = tag.name.rfind("_array");
    if ((tag.name == "accessor" || (end != std::string_view::npos && end + 6 == tag.name.size())) &&
        !whole)
      refuse("has a <" + name + "> whose count is \"" + shortened(printable(count)) +
             "\"; allowed are whole numbers");
    for (const char* attribute : {"count", "stride", "offset"})
      if (std::strtod(value_of(tag.attributes, attribute).c_str(), nullptr) >
          static_cast<double>(text_.size()))
        refuse("has a <" + name + "> with a larger " + attribute + " than the file has bytes");
    if (tag.name != "p" && tag.name != "v" && tag.name != "h" && tag.name != "vcount") return;
    const std::size_t odd = text_.find_first_not_of("0123456789+- \t\r\n", at_ + 1);
    if (!tag.closes && odd < text_.find('<', at_))
      refuse("has a <" + name + "> that holds more than indices; allowed are whole numbers");
  }

  void open(const Tag& tag) {
    if (elements_.size() == kDeepestElement)
      refuse("has elements nested more than " + std::to_string(kDeepestElement) + " deep");
    check_numbers(tag);
    elements_.push_back(innermost());
    const std::size_t parent = innermost();
    if (tag.name == "node" || tag.name == "visual_scene") {
      count_pieces(++held_);
      elements_.back() = nodes_.size();
      if (parent != kNone)
        nodes_[parent].children.push_back(nodes_.size());
      else
        library_[word_of(tag, "id")] = nodes_.size();
      if (tag.name == "visual_scene") scenes_.push_back(nodes_.size());
      nodes_.push_back({word_of(tag, "id"), word_of(tag, "name")});
    } else if (parent == kNone) {
      return;
    } else if (tag.name == "instance_node") {
      const std::string url = word_of(tag, "url");
      count_pieces(++held_);
      if (!url.empty()) nodes_[parent].instances.push_back(url.substr(1));
    } else if (tag.name == "instance_geometry" || tag.name == "instance_controller") {
      ++nodes_[parent].pieces;
    }
  }
  void close() {
    if (!elements_.empty()) elements_.pop_back();
  }
  /// The node in which the reader is; kNone outside of any.
  [[nodiscard]] std::size_t innermost() const {
    return elements_.empty() ? kNone : elements_.back();
  }

  void count_pieces(std::size_t pieces) const {
    if (pieces > kMostPieces)
      refuse("unfolds to more than " + std::to_string(kMostPieces) +
             " nodes and geometries; allowed is up to that");
  }

  /// As assimp looks for it: in the library, or else in the scene by name or id.
  [[nodiscard]] std::vector<std::size_t> named(const std::string& id) const {
    if (const auto found = library_.find(id); found != library_.end()) return {found->second};
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].id == id || nodes_[i].name == id) all.push_back(i);
    return all;
  }

  /// Fills in the pieces and the height of a node. \param depth  of nodes above it
  const Node& unfold(std::size_t index, std::size_t depth) {
    Node& node = nodes_[index];
    if (node.unfolded == Node::Unfolded::now)
      refuse("has a node '" + shortened(printable(node.id.empty() ? node.name : node.id)) +
             "' that instances itself; allowed are nodes in a tree");
    if (depth + node.height > kDeepestNode)
      refuse("has nodes nested more than " + std::to_string(kDeepestNode) + " deep");
    if (node.unfolded == Node::Unfolded::yes) return node;
    node.unfolded = Node::Unfolded::now;
    std::vector<std::size_t> parts = node.children;
    for (const std::string& id : node.instances) {
      if (library_.count(id) == 0) node.pieces += 1 + nodes_.size() / kSearched;
      count_pieces(node.pieces);
      for (const std::size_t part : named(id)) parts.push_back(part);
    }
    for (const std::size_t part : parts) {
      const Node& unfolded = unfold(part, depth + 1);
      node.pieces += unfolded.pieces;
      node.height = std::max(node.height, unfolded.height + 1);
      count_pieces(node.pieces);
    }
    node.unfolded = Node::Unfolded::yes;
    return node;
  }

  const std::filesystem::path& file_;
  const std::string& text_;
  std::size_t at_ = 0;
  std::size_t held_ = 0;  ///< nodes and instances of nodes in the text
  std::vector<Node> nodes_;
  std::vector<std::size_t> elements_;  ///< from the outside in: the node that each is in, or is
  std::vector<std::size_t> scenes_;
  std::map<std::string, std::size_t> library_;  ///< nodes outside of others, by id
};

}  // namespace

void check_collada(const std::filesystem::path& file, const std::string& text) {
  ColladaNodes(file, text).check();
}

}  // namespace navvi_sim::read
