#include "navvi_floor/octomap_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

namespace navvi_floor {
namespace {

/// A node still to be read.
struct Node {
  std::uint16_t x, y, z;  // voxels, lower corner
  std::uint8_t depth;
};

constexpr Node kRoot{0, 0, 0, 0};
constexpr int kBlockDepth = kMapDepth - kBlockLevel;
constexpr const char* kColoured = "ColorOcTree";

Node child_of(const Node& node, int child) {
  const int side = 1 << (kMapDepth - 1 - node.depth);
  const auto at = [side](std::uint16_t low, int bit) {
    return static_cast<std::uint16_t>(low + (bit != 0 ? side : 0));
  };
  return {at(node.x, child & 1), at(node.y, child & 2), at(node.z, child & 4),
          static_cast<std::uint8_t>(node.depth + 1)};
}

void add_leaf(Voxels& voxels, int x, int y, int z, int level) {
  const int away = ~((2 << level) - 1);
  const int bit = ((x >> level) & 1) | ((y >> level) & 1) << 1 | ((z >> level) & 1) << 2;
  const Octet octet{static_cast<std::uint16_t>(x & away), static_cast<std::uint16_t>(y & away),
                    static_cast<std::uint16_t>(z & away), static_cast<std::uint8_t>(level),
                    static_cast<std::uint8_t>(1 << bit)};
  if (!voxels.octets.empty()) {
    Octet& last = voxels.octets.back();
    if (last.x == octet.x && last.y == octet.y && last.z == octet.z && last.level == octet.level) {
      last.mask = static_cast<std::uint8_t>(last.mask | octet.mask);
      return;
    }
  }
  voxels.octets.push_back(octet);
}

/// The stream of one map, and how reading it may end.
class Stream {
 public:
  explicit Stream(const MapBytes& bytes) : bytes_(bytes) {}

  [[nodiscard]] bool has(std::size_t count) const { return bytes_.size - at_ >= count; }
  [[nodiscard]] std::size_t at() const { return at_; }
  void skip(std::size_t count) { at_ += count; }
  [[nodiscard]] std::uint8_t byte() { return static_cast<std::uint8_t>(bytes_.data[at_++]); }
  [[nodiscard]] float value() {
    float out = 0.0F;
    std::memcpy(&out, bytes_.data + at_, sizeof out);
    at_ += sizeof out;
    return out;
  }
  [[nodiscard]] std::string too_short() const {
    return "the map ends in the middle of a node after " + std::to_string(bytes_.size) + " bytes";
  }
  [[nodiscard]] std::string rest() const {
    if (at_ == bytes_.size) return {};
    return "the map has " + std::to_string(bytes_.size - at_) + " bytes after its last node";
  }

 private:
  const MapBytes& bytes_;
  std::size_t at_ = 0;
};

/// Notes where the blocks of a stream lie, and skips those that are not wanted.
class BlockNotes {
 public:
  BlockNotes(const SkipBlock& skip, std::vector<Block>& blocks) : skip_(skip), blocks_(blocks) {}

  /// A node begins, or the stream ends: no block that is open goes on.
  void end(const Node& node, const Stream& stream) {
    if (!open_ || node.depth > kBlockDepth) return;
    blocks_.back().size = static_cast<std::uint32_t>(stream.at()) - blocks_.back().begin;
    open_ = false;
  }
  /// The bytes of a node with children, from `begin` on, were read. \returns whether all within it
  /// was skipped
  bool skips(const Node& node, std::size_t begin, Stream& stream) {
    if (node.depth != kBlockDepth) return false;
    blocks_.push_back({{node.x, node.y, node.z}, static_cast<std::uint32_t>(begin), 0});
    open_ = true;
    const std::size_t size = skip_ ? skip_(blocks_.back()) : 0, read = stream.at() - begin;
    if (size <= read || !stream.has(size - read)) return false;
    stream.skip(size - read);
    return true;
  }

 private:
  const SkipBlock& skip_;
  std::vector<Block>& blocks_;
  bool open_ = false;
};

std::string too_deep() { return "the map nests deeper than 16 levels"; }
std::string no_nodes() { return "the map is one node that says nothing of any place"; }

/// Two bits a child: 01 free leaf (as written), 10 occupied leaf, 11 inner node, 00 unknown.
std::string walk_binary(const MapBytes& bytes, const SkipBlock& skip, Voxels& out) {
  Stream stream(bytes);
  BlockNotes blocks(skip, out.blocks);
  std::vector<Node> waiting{kRoot};
  if (!skip) out.octets.reserve(bytes.size / 2);
  while (!waiting.empty()) {
    const Node node = waiting.back();
    waiting.pop_back();
    blocks.end(node, stream);
    if (node.depth >= kMapDepth) return too_deep();
    if (!stream.has(2)) return stream.too_short();
    const std::size_t begin = stream.at();
    const unsigned low = stream.byte();
    const unsigned bits = low | static_cast<unsigned>(stream.byte()) << 8;
    if (node.depth == 0 && bits == 0) return no_nodes();
    if (blocks.skips(node, begin, stream)) continue;
    const unsigned inner = bits & (bits >> 1) & 0x5555U;
    unsigned leaves = (bits >> 1) & ~bits & 0x5555U;  // each child's answer in an even bit
    leaves = (leaves | leaves >> 1) & 0x3333U;        // ... gathered in the low eight
    leaves = (leaves | leaves >> 2) & 0x0f0fU;
    leaves = (leaves | leaves >> 4) & 0x00ffU;
    if (leaves != 0)
      out.octets.push_back({node.x, node.y, node.z,
                            static_cast<std::uint8_t>(kMapDepth - 1 - node.depth),
                            static_cast<std::uint8_t>(leaves)});
    if (inner == 0) continue;
    for (int child = 7; child >= 0; --child) {  // the first one is to be read next
      if (((inner >> (2 * child)) & 1U) != 0) waiting.push_back(child_of(node, child));
    }
  }
  blocks.end(kRoot, stream);
  return stream.rest();
}

/// A float (the log-odds), in a ColorOcTree three bytes of colour, and one bit a child.
std::string walk_full(const MapBytes& bytes, const SkipBlock& skip, Voxels& out) {
  Stream stream(bytes);
  BlockNotes blocks(skip, out.blocks);
  const std::size_t colours = bytes.id == kColoured ? 3 : 0;
  std::vector<Node> waiting{kRoot};
  while (!waiting.empty()) {
    const Node node = waiting.back();
    waiting.pop_back();
    blocks.end(node, stream);
    if (node.depth > kMapDepth) return too_deep();
    if (!stream.has(5 + colours)) return stream.too_short();
    const std::size_t begin = stream.at();
    const float value = stream.value();
    stream.skip(colours);
    const unsigned children = stream.byte();
    if (!std::isfinite(value)) return "the map has a node whose value is not finite";
    if (children == 0) {
      if (node.depth == 0) return no_nodes();
      if (value >= 0.0F) add_leaf(out, node.x, node.y, node.z, kMapDepth - node.depth);
      continue;
    }
    if (node.depth >= kMapDepth) return too_deep();
    if (blocks.skips(node, begin, stream)) continue;
    for (int child = 7; child >= 0; --child) {
      if (((children >> child) & 1U) != 0) waiting.push_back(child_of(node, child));
    }
  }
  blocks.end(kRoot, stream);
  return stream.rest();
}

std::string refusal_of(const MapBytes& bytes) {
  if (bytes.id != "OcTree" && bytes.id != kColoured)
    return "the map is of the kind \"" + printable(bytes.id) +
           "\"; OcTree and ColorOcTree are allowed";
  if (!std::isfinite(bytes.resolution) || bytes.resolution < kMinResolution ||
      bytes.resolution > kMaxResolution)
    return "the map's resolution is not within 0.01 and 1 m";
  if (bytes.size == 0 || bytes.data == nullptr) return "the map is empty";
  if (bytes.size > kMaxMapBytes) return "the map is larger than 64 MiB";
  return {};
}

}  // namespace

std::string printable(std::string text) {
  text.resize(std::min<std::size_t>(text.size(), 40));
  for (char& c : text)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return text;
}

Voxels read_voxels(const MapBytes& bytes, const SkipBlock& skip) {
  Voxels out;
  out.resolution = bytes.resolution;
  out.error = refusal_of(bytes);
  if (out.error.empty())
    out.error = bytes.binary ? walk_binary(bytes, skip, out) : walk_full(bytes, skip, out);
  if (!out.error.empty()) out.octets.clear();
  std::sort(out.blocks.begin(), out.blocks.end(),
            [](const Block& a, const Block& b) { return a.low < b.low; });
  return out;
}

const Block* find_block(const std::vector<Block>& blocks, const std::array<std::uint16_t, 3>& low) {
  const auto found =
      std::lower_bound(blocks.begin(), blocks.end(), low,
                       [](const Block& block, const auto& wanted) { return block.low < wanted; });
  return found != blocks.end() && found->low == low ? &*found : nullptr;
}

}  // namespace navvi_floor
