#include "occupancy/octree_writer.hpp"

#include <cstring>
#include <string>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::occupancy {
namespace {

/// Bit i of a byte to bit 2 i + 1: the leaves among eight children, as octomap writes them.
unsigned as_leaves(unsigned children) {
  children = (children | children << 4) & 0x0F0FU;
  children = (children | children << 2) & 0x3333U;
  children = (children | children << 1) & 0x5555U;
  return children << 1;
}

/// Puts all shapes in at once, from the root down: what they fill is one leaf whatever its size,
/// and what they leave free is not entered. Where every body of a cube spans it along an axis, one
/// half of the cube is a copy of the other: a bare floor costs as good as nothing.
class OctreeWriter {
 public:
  OctreeWriter(const OccupiedShapes& shapes, double resolution, std::size_t most)
      : shapes_(shapes), resolution_(resolution), most_(most) {
    for (std::size_t i = 0; i < shapes.boxes.size(); ++i) boxes_.push_back({i, 0});
    const std::size_t others =
        shapes.solids.size() + shapes.closed.size() + shapes.triangles.size();
    for (std::size_t i = 0; i < others; ++i) others_.push_back({i, 0});
  }

  std::vector<std::int8_t> write() {
    write({{0, 0, 0}, OccupancyMap::kDepth}, 0, 0);
    return std::move(out_);
  }

 private:
  struct Candidate {
    std::size_t body;
    unsigned touched;  ///< the eighths of the cube that it reaches into
  };
  using Candidates = std::vector<Candidate>;
  /// What became of a cube, and where it stands in the stream if it is partial.
  struct Written {
    Overlap overlap = Overlap::none;
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  [[nodiscard]] Cell cell(const VoxelCube& cube) const {
    const double half = 0.5 * (1 << cube.level);
    const auto centre = [&](std::size_t axis) {
      return (cube.low[axis] - OccupancyMap::kCenter + half) * resolution_;
    };
    return {{centre(0), centre(1), centre(2)}, half * resolution_};
  }

  /// What reaches by its way into the voxels of an eighth, reaches so into the eighth.
  [[nodiscard]] Octants octants_in(std::size_t other, const Cell& cell) const {
    if (other < shapes_.solids.size())
      return octants(shapes_.solids[other].solid, cell, shapes_.solids[other].reach);
    other -= shapes_.solids.size();
    if (other < shapes_.closed.size()) return shapes_.closed[other].octants(cell);
    return octants(shapes_.triangles[other - shapes_.closed.size()], cell);
  }

  /// Writes the cube that the candidates from these on reach into.
  Written write(const VoxelCube& cube, std::size_t first_box, std::size_t first_other) {
    if (cube.level == kBrickLevel) return write_brick(brick(cube, first_box, first_other));
    Octants all{0, 0};
    unsigned same = others_.size() > first_other ? 0U : 7U;
    for (std::size_t i = first_box; i < boxes_.size(); ++i) {
      const VoxelBox& box = shapes_.boxes[boxes_[i].body];
      const Octants part = box.octants(cube);
      boxes_[i].touched = part.touched;
      all.touched |= part.touched;
      all.full |= part.full;
      same &= box.spans(cube);
    }
    if (others_.size() > first_other) {
      const Cell where = cell(cube);
      for (std::size_t i = first_other; i < others_.size(); ++i) {
        const Octants part = octants_in(others_[i].body, where);
        others_[i].touched = part.touched;
        all.touched |= part.touched;
        all.full |= part.full;
      }
    }
    return write_children(cube, all, same, first_box, first_other);
  }

  /// \param same  axes along which the halves of the cube are the same
  Written write_children(const VoxelCube& cube, Octants all, unsigned same, std::size_t first_box,
                         std::size_t first_other) {
    const std::size_t begin = out_.size();
    grow(2);
    std::array<Written, 8> children;
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned twin = i & ~same;
      if (all.full >> i & 1U)
        children[i].overlap = Overlap::full;
      else if (twin != i)
        children[i] = copy(children[twin]);
      else if (all.touched >> i & 1U)
        children[i] = write_child(cube, i, first_box, first_other);
      bits |= (children[i].overlap == Overlap::full      ? 2U
               : children[i].overlap == Overlap::partial ? 3U
                                                         : 0U)
              << (2 * i);
    }
    if (bits == 0 || bits == 0xAAAAU) {
      out_.resize(begin);
      return {bits == 0 ? Overlap::none : Overlap::full, begin, begin};
    }
    put(begin, bits);
    return {Overlap::partial, begin, out_.size()};
  }

  Written write_child(const VoxelCube& parent, unsigned i, std::size_t first_box,
                      std::size_t first_other) {
    const std::size_t boxes = boxes_.size();
    const std::size_t others = others_.size();
    pass_on(boxes_, first_box, boxes, i);
    pass_on(others_, first_other, others, i);
    const Written written = write(octant(parent, i), boxes, others);
    boxes_.resize(boxes);
    others_.resize(others);
    return written;
  }
  /// Puts those that reach into an eighth on top of the stack.
  static void pass_on(Candidates& stack, std::size_t from, std::size_t to, unsigned eighth) {
    for (std::size_t k = from; k < to; ++k)
      if (stack[k].touched >> eighth & 1U) stack.push_back({stack[k].body, 0});
  }

  [[nodiscard]] Brick brick(const VoxelCube& cube, std::size_t first_box,
                            std::size_t first_other) const {
    Brick all = 0;
    for (std::size_t i = first_box; i < boxes_.size(); ++i)
      all |= shapes_.boxes[boxes_[i].body].brick(cube);
    for (std::size_t i = first_other; i < others_.size() && ~all != 0; ++i)
      all |= brick_of(others_[i].body, cube);
    return all;
  }
  [[nodiscard]] Brick brick_of(std::size_t other, const VoxelCube& cube) const {
    const Octants part = octants_in(other, cell(cube));
    Brick all = 0;
    for (unsigned i = 0; i < 8; ++i) {
      if (!(part.touched >> i & 1U)) continue;
      const Brick voxels =
          part.full >> i & 1U ? 0xFFU : octants_in(other, cell(octant(cube, i))).touched;
      all |= voxels << (8 * i);
    }
    return all;
  }

  Written write_brick(Brick brick) {
    const std::size_t begin = out_.size();
    if (brick == 0) return {Overlap::none, begin, begin};
    if (~brick == 0) return {Overlap::full, begin, begin};
    grow(2);
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i) {
      const auto voxels = static_cast<unsigned>(brick >> (8 * i) & 0xFFU);
      if (voxels == 0) continue;
      bits |= (voxels == 0xFFU ? 2U : 3U) << (2 * i);
      if (voxels != 0xFFU) put(grow(2), as_leaves(voxels));
    }
    put(begin, bits);
    return {Overlap::partial, begin, out_.size()};
  }

  Written copy(const Written& twin) {
    if (twin.overlap != Overlap::partial) return twin;
    const std::size_t size = twin.end - twin.begin;
    const std::size_t begin = grow(size);
    std::memcpy(out_.data() + begin, out_.data() + twin.begin, size);
    return {Overlap::partial, begin, begin + size};
  }

  /// \return where the room that was made begins
  std::size_t grow(std::size_t bytes) {
    const std::size_t at = out_.size();
    if (at + bytes > most_)
      throw WorldError("the OctoMap of this world comes to more than " + std::to_string(most_) +
                       " bytes; allowed is a smaller world or a coarser resolution than " +
                       std::to_string(resolution_) + " m");
    out_.resize(at + bytes);
    return at;
  }
  void put(std::size_t at, unsigned bits) {
    out_[at] = static_cast<std::int8_t>(bits & 0xFFU);
    out_[at + 1] = static_cast<std::int8_t>(bits >> 8);
  }

  const OccupiedShapes& shapes_;
  double resolution_;
  std::size_t most_;
  std::vector<std::int8_t> out_;
  /// Stacks: the candidates of the cubes from the root down.
  Candidates boxes_;
  Candidates others_;  ///< solids, then closed meshes, then triangles
};

}  // namespace

std::vector<std::int8_t> write_octree(const OccupiedShapes& shapes, double resolution,
                                      std::size_t most) {
  return OctreeWriter(shapes, resolution, most).write();
}

}  // namespace navvi_sim::occupancy
