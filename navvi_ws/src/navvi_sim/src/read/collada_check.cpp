#include "read/collada_check.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "description/sentence.hpp"
#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {
namespace {

constexpr std::size_t kMostPieces = 100'000;  // assimp takes some 1.3 kB for each node
constexpr std::size_t kSearched = 1'000;      // nodes that are looked at in the time of one piece
constexpr std::size_t kDeepestNode = 200;

/// The value of an attribute, with blanks as assimp reads them; empty if there is none.
std::string value_of(const tinyxml2::XMLElement& element, const char* attribute) {
  const char* const found = element.Attribute(attribute);
  std::string value = found == nullptr ? "" : found;
  for (char& letter : value)
    if (std::strchr("\t\r\n", letter) != nullptr) letter = ' ';
  return value;
}

/// The nodes of a Collada text, and what they unfold to.
class ColladaNodes {
 public:
  /// \param bytes  of the text
  ColladaNodes(const std::filesystem::path& file, std::size_t bytes) : file_(file), bytes_(bytes) {}

  void check(const tinyxml2::XMLElement& root) {
    read(root, kNone);
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

  /// Assimp reserves as much as is named, crashes on an array without its count, and reads a word
  /// among indices again and again until no memory is left.
  void check_numbers(const tinyxml2::XMLElement& element) const {
    constexpr const char* kDigits = "0123456789";
    const std::string_view name = element.Name();
    const std::string shown = shortened(printable(element.Name()));
    const std::string count = value_of(element, "count");
    const bool whole = !count.empty() && count.find_first_not_of(kDigits) == std::string::npos;
    const std::size_t end = name.rfind("_array");
    if ((name == "accessor" || (end != std::string_view::npos && end + 6 == name.size())) && !whole)
      refuse("has a <" + shown + "> whose count is \"" + shortened(printable(count)) +
             "\"; allowed are whole numbers");
    for (const char* attribute : {"count", "stride", "offset"})
      if (std::strtod(value_of(element, attribute).c_str(), nullptr) > static_cast<double>(bytes_))
        refuse("has a <" + shown + "> with a larger " + attribute + " than the file has bytes");
    if (name != "p" && name != "v" && name != "h" && name != "vcount") return;
    // Comments and elements may part the text; the reader takes any of its parts.
    for (const auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling())
      if (child->ToText() != nullptr &&
          child->Value()[std::strspn(child->Value(), "0123456789+- \t\r\n")] != '\0')
        refuse("has a <" + shown + "> that holds more than indices; allowed are whole numbers");
  }

  /// Assimp reads beyond an array that is shorter than what its accessor names.
  void check_source(const tinyxml2::XMLElement& source) const {
    const auto* const technique = source.FirstChildElement("technique_common");
    const auto* const accessor =
        technique == nullptr ? nullptr : technique->FirstChildElement("accessor");
    const auto* const array = source.FirstChildElement("float_array");
    if (accessor == nullptr || array == nullptr) return;
    const double stride = accessor->DoubleAttribute("stride", 1.0);
    const double needed =
        accessor->DoubleAttribute("offset") + accessor->DoubleAttribute("count") * stride;
    if (needed > array->DoubleAttribute("count"))
      refuse("has a <float_array> with a smaller count than its <accessor> reads");
  }

  /// \param node  around the element; kNone outside of any
  void read(const tinyxml2::XMLElement& element, std::size_t node) {
    check_numbers(element);
    const std::string_view name = element.Name();
    if (name == "node" || name == "visual_scene") {
      count_pieces(++held_);
      const std::size_t parent = std::exchange(node, nodes_.size());
      nodes_.push_back({value_of(element, "id"), value_of(element, "name")});
      if (parent != kNone)
        nodes_[parent].children.push_back(node);
      else
        library_[nodes_[node].id] = node;
      if (name == "visual_scene") scenes_.push_back(node);
    } else if (node != kNone && name == "instance_node") {
      const std::string url = value_of(element, "url");
      count_pieces(++held_);
      if (!url.empty()) nodes_[node].instances.push_back(url.substr(1));
    } else if (node != kNone && (name == "instance_geometry" || name == "instance_controller")) {
      ++nodes_[node].pieces;
    }
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement())
      read(*child, node);
    if (name == "source") check_source(element);
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
  std::size_t bytes_;
  std::size_t held_ = 0;  ///< nodes and instances of nodes in the text
  std::vector<Node> nodes_;
  std::vector<std::size_t> scenes_;
  std::map<std::string, std::size_t> library_;  ///< nodes outside of others, by id
};

}  // namespace

void check_collada(const std::filesystem::path& file, const tinyxml2::XMLElement& root,
                   std::size_t bytes) {
  ColladaNodes(file, bytes).check(root);
}

}  // namespace navvi_sim::read
