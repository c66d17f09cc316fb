#include "navvi_nav/octomap_reader.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <vector>

#include "small_world.hpp"

namespace navvi_nav {
namespace {

using Bytes = std::vector<std::int8_t>;

Bytes stream_of(bool binary) {
  SmallWorld world;
  world.room(4, 3).box(1, 1, 0, 2, 2, 0.5);
  std::ostringstream out;
  if (binary) {
    octomap::OcTree tree = world.tree();
    tree.writeBinaryData(out);
  } else {
    world.tree().writeData(out);
  }
  const std::string text = out.str();
  return Bytes(text.begin(), text.end());
}

MapBytes bytes_of(const Bytes& data, bool binary = true) {
  return {data.data(), data.size(), binary, "OcTree", 0.05};
}

TEST(OctomapReader, refuses_an_empty_stream) {
  EXPECT_FALSE(check_map({nullptr, 0, true, "OcTree", 0.05}).empty());
}

TEST(OctomapReader, refuses_what_nests_without_end_and_survives) {
  const Bytes ones(256 * 1024, -1);
  EXPECT_EQ(check_map(bytes_of(ones)), "the map nests deeper than 16 levels");
  EXPECT_FALSE(check_map(bytes_of(ones, false)).empty());
}

TEST(OctomapReader, refuses_bad_resolutions_and_other_trees) {
  const Bytes data = stream_of(true);
  for (const double bad : {0.0, -0.05, 1e-3, 2.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    MapBytes bytes = bytes_of(data);
    bytes.resolution = bad;
    EXPECT_EQ(read_map(bytes).tree, nullptr) << bad;
  }
  MapBytes bytes = bytes_of(data);
  bytes.id = "ColorOcTree";
  EXPECT_FALSE(check_map(bytes).empty());
}

TEST(OctomapReader, refuses_a_stream_cut_anywhere) {
  for (const bool binary : {true, false}) {
    const Bytes data = stream_of(binary);
    for (std::size_t part = 0; part < 64; ++part) {
      Bytes cut(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(data.size() * part / 64));
      EXPECT_EQ(read_map(bytes_of(cut, binary)).tree, nullptr) << part;
      EXPECT_FALSE(read_map(bytes_of(cut, binary)).error.empty());
    }
  }
}

TEST(OctomapReader, refuses_bytes_after_the_last_node) {
  Bytes data = stream_of(true);
  data.push_back(0);
  data.push_back(0);
  EXPECT_FALSE(check_map(bytes_of(data)).empty());
}

TEST(OctomapReader, refuses_a_node_whose_value_is_not_finite) {
  Bytes data = stream_of(false);
  data[2] = static_cast<std::int8_t>(0x80);
  data[3] = static_cast<std::int8_t>(0x7f);
  EXPECT_FALSE(check_map(bytes_of(data, false)).empty());
}

TEST(OctomapReader, reads_what_octomap_wrote) {
  SmallWorld world;
  world.room(4, 3).box(1, 1, 0, 2, 2, 0.5);
  const octomap::OcTree& tree = world.tree();
  for (const bool binary : {true, false}) {
    const Bytes data = stream_of(binary);
    const ReadMap read = read_map(bytes_of(data, binary));
    ASSERT_NE(read.tree, nullptr) << read.error;
    std::size_t occupied = 0;
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
      const auto* node = read.tree->search(leaf.getX(), leaf.getY(), leaf.getZ());
      ASSERT_NE(node, nullptr);
      EXPECT_TRUE(read.tree->isNodeOccupied(node));
      ++occupied;
    }
    EXPECT_GT(occupied, 1000U);
  }
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
