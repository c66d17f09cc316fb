#include "navvi_nav/octomap_reader.hpp"

#include <cmath>
#include <cstring>
#include <istream>
#include <streambuf>
#include <vector>

namespace navvi_nav {
namespace {

constexpr int kMaxDepth = 16;

/// Reads from memory that somebody else owns.
class MemoryBuffer : public std::streambuf {
 public:
  MemoryBuffer(const std::int8_t* data, std::size_t size) {
    char* begin = reinterpret_cast<char*>(const_cast<std::int8_t*>(data));
    setg(begin, begin, begin + size);
  }
};

std::string too_short(std::size_t size) {
  return "the map ends in the middle of a node after " + std::to_string(size) + " bytes";
}

std::string too_deep() { return "the map nests deeper than 16 levels"; }

/// Two bits a child: 01 free leaf (as written), 10 occupied leaf, 11 inner node, 00 unknown.
std::string walk_binary(const MapBytes& bytes) {
  std::vector<int> waiting{0};  // depths of nodes still to read
  std::size_t at = 0;
  while (!waiting.empty()) {
    const int depth = waiting.back();
    waiting.pop_back();
    if (depth >= kMaxDepth) return too_deep();
    if (at + 2 > bytes.size) return too_short(bytes.size);
    for (std::size_t byte = 0; byte < 2; ++byte) {
      const auto bits = static_cast<std::uint8_t>(bytes.data[at + byte]);
      for (int child = 0; child < 4; ++child) {
        if (((bits >> (2 * child)) & 3) == 3) waiting.push_back(depth + 1);
      }
    }
    at += 2;
  }
  if (at != bytes.size)
    return "the map has " + std::to_string(bytes.size - at) + " bytes after its last node";
  return {};
}

/// A float and one bit a child.
std::string walk_full(const MapBytes& bytes) {
  std::vector<int> waiting{0};
  std::size_t at = 0;
  while (!waiting.empty()) {
    const int depth = waiting.back();
    waiting.pop_back();
    if (depth > kMaxDepth) return too_deep();
    if (at + 5 > bytes.size) return too_short(bytes.size);
    float value = 0.0F;
    std::memcpy(&value, bytes.data + at, sizeof(value));
    if (!std::isfinite(value)) return "the map has a node whose value is not finite";
    const auto children = static_cast<std::uint8_t>(bytes.data[at + 4]);
    for (int child = 0; child < 8; ++child) {
      if ((children >> child) & 1) waiting.push_back(depth + 1);
    }
    at += 5;
  }
  if (at != bytes.size)
    return "the map has " + std::to_string(bytes.size - at) + " bytes after its last node";
  return {};
}

}  // namespace

std::string check_map(const MapBytes& bytes) {
  if (bytes.id != "OcTree") return "the map is of another kind than OcTree";
  if (!std::isfinite(bytes.resolution) || bytes.resolution < kMinResolution ||
      bytes.resolution > kMaxResolution)
    return "the map's resolution is not within 0.01 and 1 m";
  if (bytes.size == 0 || bytes.data == nullptr) return "the map is empty";
  if (bytes.size > kMaxMapBytes) return "the map is larger than 64 MiB";
  return bytes.binary ? walk_binary(bytes) : walk_full(bytes);
}

ReadMap read_map(const MapBytes& bytes) {
  std::string error = check_map(bytes);
  if (!error.empty()) return {nullptr, std::move(error)};
  auto tree = std::make_unique<octomap::OcTree>(bytes.resolution);
  MemoryBuffer buffer(bytes.data, bytes.size);
  std::istream stream(&buffer);
  if (bytes.binary) {
    tree->readBinaryData(stream);
  } else {
    tree->readData(stream);
  }
  if (tree->getRoot() == nullptr) return {nullptr, "the map holds no node"};
  return {std::move(tree), {}};
}

}  // namespace navvi_nav
