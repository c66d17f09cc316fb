#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace navvi_floor {

/// The octree stream of an octomap_msgs/Octomap, not copied.
struct MapBytes {
  const std::int8_t* data = nullptr;
  std::size_t size = 0;
  bool binary = true;       ///< false: node values as floats (OcTree::writeData)
  std::string id;           ///< OcTree or ColorOcTree
  double resolution = 0.0;  ///< m
};

inline constexpr double kMinResolution = 0.01;  ///< m
inline constexpr double kMaxResolution = 1.0;   ///< m
inline constexpr std::size_t kMaxMapBytes = 64U * 1024U * 1024U;
inline constexpr int kMapDepth = 16;             ///< levels of an octree
inline constexpr int kMapSide = 1 << kMapDepth;  ///< voxels along a side of an octree
inline constexpr int kMapCenter = kMapSide / 2;  ///< voxel whose lower corner is the map's origin

/// The occupied leaves among the eight children of one inner node.
struct Octet {
  std::uint16_t x = 0;  ///< voxels, lower corner of the node; the map's origin is kMapCenter
  std::uint16_t y = 0;
  std::uint16_t z = 0;
  std::uint8_t level = 0;  ///< a child is a cube of 2^level voxels
  std::uint8_t mask =
      0;  ///< bit i: child i is an occupied leaf; child i lies at (i, i / 2, i / 4) mod 2
};

inline constexpr int kBlockLevel = 6;  ///< a block is a cube of 2^6 voxels

/// A block that is not one leaf, and the bytes of the stream that tell of it and of nothing else.
struct Block {
  std::array<std::uint16_t, 3> low{};  ///< voxels, lower corner; the map's origin is kMapCenter
  std::uint32_t begin = 0;
  std::uint32_t size = 0;
};

/// Voxels along the axes, from `low` on and before `high`; the map's origin is kMapCenter.
struct VoxelBox {
  std::array<int, 3> low;
  std::array<int, 3> high;
};

struct SeenGround;

/// All that navigation wants from an OctoMap: where it is occupied.
struct Voxels {
  std::string error;        ///< a sentence if the map was refused
  double resolution = 0.0;  ///< m
  std::vector<Octet> octets;
  std::vector<VoxelBox> boxes = {};  ///< besides, by one that knows them; they may overlap
  std::string source = {};         ///< what a file says of itself; may be empty
  std::vector<Block> blocks = {};  ///< of the stream, if they were read from one, by `low`
  std::shared_ptr<const SeenGround> seen = {};  ///< by see_ground(); null: not yet
};

/// The beginning of a word of a map, fit for a terminal.
[[nodiscard]] std::string printable(std::string text);

/// Told where a block begins, returns its size in bytes if it is not to be read, or 0. A size
/// beyond the end of the stream is as 0.
using SkipBlock = std::function<std::size_t(const Block& block)>;

/// Walks the stream once, without recursion and without building a tree, and takes the occupied
/// leaves as octomap would. Refuses a stream that is not one well-formed octree of at most 16
/// levels that uses every byte. (octomap itself takes a truncated stream in silence and overflows
/// the stack on one that nests without end.)
[[nodiscard]] Voxels read_voxels(const MapBytes& bytes, const SkipBlock& skip = nullptr);

/// The block that lies there, or null. \param blocks  by `low`
[[nodiscard]] const Block* find_block(const std::vector<Block>& blocks,
                                      const std::array<std::uint16_t, 3>& low);

}  // namespace navvi_floor
