#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace navvi_nav {

/// The octree stream of an octomap_msgs/Octomap, not copied.
struct MapBytes {
  const std::int8_t* data = nullptr;
  std::size_t size = 0;
  bool binary = true;       ///< false: node values as floats (OcTree::writeData)
  std::string id;           ///< must be OcTree
  double resolution = 0.0;  ///< m
};

inline constexpr double kMinResolution = 0.01;  ///< m
inline constexpr double kMaxResolution = 1.0;   ///< m
inline constexpr std::size_t kMaxMapBytes = 64U * 1024U * 1024U;

/// Walks the whole stream without recursion. \returns an empty string if it is one well-formed
/// octree of at most 16 levels that uses every byte, else a sentence. (octomap itself takes a
/// truncated stream in silence and overflows the stack on one that nests without end.)
[[nodiscard]] std::string check_map(const MapBytes& bytes);

struct ReadMap {
  std::unique_ptr<octomap::OcTree> tree;  ///< null if refused
  std::string error;                      ///< a sentence if refused
};

/// Checks the stream, then lets octomap read it.
[[nodiscard]] ReadMap read_map(const MapBytes& bytes);

}  // namespace navvi_nav
