#include "navvi_floor/octomap_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <tuple>
#include <vector>

#include "fuzz.hpp"
#include "navvi_floor/map_survey.hpp"
#include "voxel_world.hpp"

namespace navvi_floor {
namespace {

using Bytes = std::vector<std::int8_t>;
using Leaf = std::tuple<int, int, int, int>;  // voxels, lower corner and level

Bytes stream_of(octomap::OcTree tree, bool binary) {
  std::ostringstream out;
  if (binary) {
    tree.writeBinaryData(out);
  } else {
    tree.writeData(out);
  }
  const std::string text = out.str();
  return Bytes(text.begin(), text.end());
}

Bytes stream_of(bool binary) {
  SmallWorld world;
  world.room(4, 3).box(1, 1, 0, 2, 2, 0.5);
  return stream_of(world.tree(), binary);
}

MapBytes bytes_of(const Bytes& data, bool binary = true, double resolution = 0.05) {
  return {data.data(), data.size(), binary, "OcTree", resolution};
}

std::string refusal(const Bytes& data, bool binary = true) {
  const Voxels read = read_voxels(bytes_of(data, binary));
  EXPECT_TRUE(read.error.empty() || read.octets.empty());
  return read.error;
}

std::set<Leaf> leaves_of(const Voxels& voxels) {
  std::set<Leaf> out;
  for (const Octet& octet : voxels.octets) {
    const int side = 1 << octet.level;
    for (int child = 0; child < 8; ++child) {
      if (((octet.mask >> child) & 1) == 0) continue;
      const bool is_new =
          out.insert({octet.x + (child & 1) * side, octet.y + ((child >> 1) & 1) * side,
                      octet.z + ((child >> 2) & 1) * side, octet.level})
              .second;
      EXPECT_TRUE(is_new);
    }
  }
  return out;
}

/// Blocks of all sizes, single voxels, free space, and cells that are neither.
octomap::OcTree random_tree(unsigned seed) {
  std::mt19937 random(seed);
  const auto pick = [&random](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  octomap::OcTree tree(0.05);
  for (int block = 0; block < 12; ++block) {
    const int side = 1 << pick(5);
    const octomap::OcTreeKey low(static_cast<octomap::key_type>(32768 - 40 + pick(80)),
                                 static_cast<octomap::key_type>(32768 - 40 + pick(80)),
                                 static_cast<octomap::key_type>(32768 - 10 + pick(20)));
    const bool occupied = pick(3) > 0;
    for (int x = 0; x < side; ++x) {
      for (int y = 0; y < side; ++y) {
        for (int z = 0; z < side; ++z)
          tree.setNodeValue(octomap::OcTreeKey(static_cast<octomap::key_type>(low[0] + x),
                                               static_cast<octomap::key_type>(low[1] + y),
                                               static_cast<octomap::key_type>(low[2] + z)),
                            occupied ? 2.0F : -2.0F, true);
      }
    }
  }
  tree.updateInnerOccupancy();
  if (pick(2) == 0) tree.prune();
  return tree;
}

TEST(OctomapReader, refuses_an_empty_stream) {
  EXPECT_EQ(read_voxels({nullptr, 0, true, "OcTree", 0.05}).error, "the map is empty");
}

TEST(OctomapReader, refuses_what_nests_without_end_and_survives) {
  const Bytes ones(8 * 1024 * 1024, -1);
  EXPECT_EQ(refusal(ones), "the map nests deeper than 16 levels");
  EXPECT_FALSE(refusal(ones, false).empty());
}

TEST(OctomapReader, refuses_bad_resolutions_and_other_trees) {
  const Bytes data = stream_of(true);
  for (const double bad : {0.0, -0.05, 1e-3, 2.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(read_voxels(bytes_of(data, true, bad)).error.empty()) << bad;
  MapBytes bytes = bytes_of(data);
  bytes.id = "CountingOcTree\n";
  EXPECT_EQ(read_voxels(bytes).error,
            "the map is of the kind \"CountingOcTree?\"; OcTree and ColorOcTree are allowed");
}

TEST(OctomapReader, N9_refuses_a_stream_cut_anywhere) {
  for (const bool binary : {true, false}) {
    const Bytes data = stream_of(binary);
    for (std::size_t part = 0; part < 64; ++part)
      EXPECT_FALSE(refusal(Bytes(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(
                                                                  data.size() * part / 64)),
                           binary)
                       .empty())
          << part;
  }
}

TEST(OctomapReader, refuses_bytes_after_the_last_node) {
  Bytes data = stream_of(true);
  data.push_back(0);
  data.push_back(0);
  EXPECT_EQ(refusal(data), "the map has 2 bytes after its last node");
}

TEST(OctomapReader, refuses_a_node_whose_value_is_not_finite) {
  Bytes data = stream_of(false);
  data[2] = static_cast<std::int8_t>(0x80);
  data[3] = static_cast<std::int8_t>(0x7f);
  EXPECT_EQ(refusal(data, false), "the map has a node whose value is not finite");
}

TEST(OctomapReader, refuses_a_lone_node_which_might_be_all_free_or_all_occupied) {
  EXPECT_FALSE(refusal({0, 0}).empty());
  EXPECT_FALSE(refusal({0, 0, 0, 0, 0}, false).empty());
}

TEST(OctomapReader, takes_the_leaves_that_octomap_takes) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const octomap::OcTree tree = random_tree(seed);
    const std::set<Leaf> expected = leaves_of(voxels_of(tree));
    for (const bool binary : {true, false}) {
      const Bytes data = stream_of(tree, binary);
      const Voxels read = read_voxels(bytes_of(data, binary));
      ASSERT_EQ(read.error, "");
      if (!binary) {
        EXPECT_EQ(leaves_of(read), expected) << seed;
        continue;
      }
      // The binary form merges what its clamped values let it merge, as octomap's reader sees it.
      octomap::OcTree again(0.05);
      std::istringstream stream(std::string(data.begin(), data.end()));
      again.readBinaryData(stream);
      EXPECT_EQ(leaves_of(read), leaves_of(voxels_of(again))) << seed;
    }
  }
}

TEST(OctomapReader,
     leads_to_the_same_survey_whichever_way_a_map_came_and_on_any_number_of_threads) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const octomap::OcTree tree = random_tree(seed);
    SurveyConfig config;
    config.climb = seed % 2 == 0 ? 0.0 : 0.1;
    config.cell_size = seed % 3 == 0 ? 0.1 : 0.0;
    config.threads = 1;
    Voxels voxels = voxels_of(tree);
    const MapSurvey expected = survey_map(voxels, config);
    config.threads = 2 + static_cast<int>(seed % 3);
    std::shuffle(voxels.octets.begin(), voxels.octets.end(), std::mt19937(seed));
    EXPECT_TRUE(survey_map(voxels, config).ground == expected.ground) << seed;
    for (const bool binary : {true, false}) {
      const Bytes data = stream_of(tree, binary);
      const MapSurvey read = survey_map(read_voxels(bytes_of(data, binary)), config);
      ASSERT_EQ(read.error, expected.error);
      EXPECT_TRUE(read.ground == expected.ground) << seed;
      EXPECT_EQ(read.low.x, expected.low.x);
      EXPECT_EQ(read.low.y, expected.low.y);
      EXPECT_EQ(read.columns, expected.columns);
      EXPECT_EQ(read.floor_height, expected.floor_height);
    }
  }
}

TEST(OctomapReader, N9_refuses_or_reads_whatever_a_damaged_stream_has_become) {
  int refused = 0, taken = 0;
  for (const bool binary : {true, false}) {
    const Bytes whole = stream_of(random_tree(3), binary);
    for (unsigned seed = 0; seed < 600; ++seed) {
      const std::string damaged =
          navvi_test::Mutator({std::string(whole.begin(), whole.end())}, seed).next();
      // A leaf near the root may fill the world; the survey then refuses it by its size.
      const Voxels read = read_voxels(bytes_of(Bytes(damaged.begin(), damaged.end()), binary));
      const MapSurvey survey = survey_map(read, {});
      ++(survey.error.empty() ? taken : refused);
      EXPECT_EQ(survey.ground.empty(), !survey.error.empty());
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(taken, 30);
}

}  // namespace
}  // namespace navvi_floor
