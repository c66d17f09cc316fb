#include "navvi_floor/map_file.hpp"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include <cstdlib>
#include <filesystem>

#include "navvi_floor/map_survey.hpp"
#include "temp_folder.hpp"
#include "voxel_world.hpp"

namespace navvi_floor {
namespace {

class MapFile : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder_.write(name, bytes);
  }

 private:
  navvi_test::TempFolder folder_;
};

TEST_F(MapFile, reads_what_octomap_writes) {
  SmallWorld world;
  world.room(4, 3).box(1, 1, 0, 2, 2, 0.5);
  octomap::OcTree tree = world.tree();
  ASSERT_TRUE(tree.writeBinary(path("map.bt")));
  ASSERT_TRUE(tree.write(path("map.ot")));
  const MapSurvey expected = survey_map(voxels_of(tree), {});
  for (const char* name : {"map.bt", "map.ot"}) {
    const MapSurvey survey = survey_file(path(name), {});
    ASSERT_EQ(survey.error, "");
    EXPECT_TRUE(survey.ground == expected.ground);
    EXPECT_EQ(survey.floor_height, expected.floor_height);
  }
}

TEST_F(MapFile, reads_a_map_with_colours_like_one_without) {
  SmallWorld world;
  const octomap::OcTree plain = world.room(4, 3).box(1, 1, 0, 2, 2, 0.5).tree();
  octomap::ColorOcTree tree(plain.getResolution());
  for (auto leaf = plain.begin_leafs(), end = plain.end_leafs(); leaf != end; ++leaf)
    tree.updateNode(leaf.getCoordinate(), true);
  tree.setNodeColor(tree.begin_leafs().getKey(), 200, 100, 50);
  tree.updateInnerOccupancy();
  ASSERT_TRUE(tree.writeBinary(path("map.bt")));
  ASSERT_TRUE(tree.write(path("map.ot")));
  const std::string nodes = std::to_string(tree.size());
  for (const char* name : {"map.bt", "map.ot"}) {
    const Voxels voxels = read_octomap_file(path(name));
    ASSERT_EQ(voxels.error, "");
    EXPECT_EQ(voxels.source, "ColorOcTree of " + nodes + " nodes");
    EXPECT_FALSE(voxels.octets.empty());
  }
  EXPECT_TRUE(survey_file(path("map.bt"), {}).ground == survey_file(path("map.ot"), {}).ground);
}

TEST_F(MapFile, refuses_a_damaged_map_in_a_sentence_that_names_the_file) {
  const auto error = [&](const std::string& bytes) {
    return read_octomap_file(write("bad.bt", bytes)).error;
  };
  const std::string first = "# Octomap OcTree binary file\n";
  const std::string name = path("bad.bt") + ": ";
  EXPECT_EQ(error("nonsense"), name + "the first line is not that of an OctoMap file (.bt or .ot)");
  EXPECT_EQ(error(first + "id OcTree\n"), name + "the header has no line \"data\"");
  EXPECT_EQ(error(first + "id OcTree\nres 0.1\ndata"), name + "the map is empty");
  EXPECT_EQ(error(first + "id OcTreeStamped\nres 0.1\ndata\nxx"),
            name + "the map is of the kind \"OcTreeStamped\"; OcTree and ColorOcTree are allowed");
  EXPECT_EQ(error(first + "id OcTree\nres 1e-9\ndata\nxx"),
            name + "the map's resolution is not within 0.01 and 1 m");
  EXPECT_EQ(error(first + "id OcTree\nres nan\ndata\nxx"),
            name + "the map's resolution is not within 0.01 and 1 m");
  EXPECT_EQ(error(first + "id OcTree\ncolour red\ndata\nxx"),
            name + "the header has a line \"colour\"; id, size, res and data are allowed");
  EXPECT_EQ(error(first + "id OcTree\nres 0.1\ndata\n"), name + "the map is empty");
  EXPECT_EQ(survey_file(path("none.bt"), {}).error, path("none.bt") + ": there is no such file");
  EXPECT_EQ(survey_file(path("map.png"), {}).error,
            path("map.png") + ": maps end in .bt, .ot (OctoMap) or .yaml (map_server)");
}

TEST_F(MapFile, reads_a_map_server_map_with_its_thresholds) {
  write("map.pgm", std::string("P5\n# drawn by hand\n3 2\n255\n") + '\x00' + '\xcd' + '\xfe' +
                       '\xfe' + '\xfe' + '\xfe');
  const std::string yaml =
      write("map.yaml",
            "image: map.pgm\nresolution: 0.1\norigin: [1.0, 2.0, 0.0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const GridFile file = read_grid_file(yaml);
  ASSERT_EQ(file.error, "");
  EXPECT_EQ(file.grid.cells, (std::vector<std::int8_t>{0, 0, 0, 100, -1, 0}));
  EXPECT_DOUBLE_EQ(file.grid.origin.y, 2.0);
  const MapSurvey survey = survey_file(yaml, {});
  ASSERT_EQ(survey.error, "");
  EXPECT_EQ(survey.low.x, 20);  // halves of pixels
  EXPECT_EQ(survey.ground.columns() * survey.ground.rows(), 24);
}

TEST_F(MapFile, takes_the_picture_beside_it_for_one_in_a_folder_of_its_author) {
  write("map.pgm", std::string("P5\n1 1\n255\n") + '\xfe');
  const GridFile file = read_grid_file(
      write("map.yaml", "image: /home/author/map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n"));
  EXPECT_EQ(file.error, "");
  EXPECT_EQ(file.source, "");
  EXPECT_EQ(file.grid.cells.size(), 1U);
}

TEST_F(MapFile, names_keys_of_other_map_servers_and_does_not_use_them) {
  write("map.pgm", std::string("P5\n1 1\n255\n") + '\xfe');
  const GridFile file = read_grid_file(write(
      "map.yaml", "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\ntype: map2d\nby: me\n"));
  EXPECT_EQ(file.error, "");
  EXPECT_EQ(file.grid.cells.size(), 1U);
  EXPECT_EQ(file.source, "without its unknown keys: type, by");
}

TEST_F(MapFile, takes_another_picture_for_the_one_that_the_file_names) {
  const std::string made = write("made.pgm", std::string("P5\n1 1\n255\n") + '\xfe');
  const std::string map = write("map.yaml", "image: a.png\nresolution: 0.1\norigin: [0, 0, 0]\n");
  EXPECT_EQ(read_grid_file(map, made).grid.cells, std::vector<std::int8_t>{0});
  EXPECT_NE(read_grid_file(map).error, "");
}

TEST_F(MapFile, refuses_a_map_server_map_in_a_sentence) {
  const std::string rest =
      "resolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const auto error = [&](const std::string& text) {
    return survey_file(write("map.yaml", text), {}).error;
  };
  EXPECT_EQ(error("image: none.pgm\n" + rest), path("none.pgm") + ": there is no such file");
  EXPECT_FALSE(error("resolution: 0.1\n").empty());
  EXPECT_NE(error("image: a.pgm\nresolution: 0.1\norigin: [0, 0]\noccupied_thresh: 0.1\n")
                .find("below free_thresh"),
            std::string::npos);
  EXPECT_FALSE(error("image: [").empty());
  for (const std::string& picture :
       {std::string("P6\n1 1\n255\nab"), std::string("P2\n2 1\n255\n0"),
        std::string("P5\n9 9\n255\nabc"), std::string("P5\n"), std::string("P5\n0 0\n255\n"), std::string("P5\n99999999 99999999\n255\n"),
        std::string("P5 1 1 70000 ab")}) {
    write("bad.pgm", picture);
    EXPECT_EQ(error("image: bad.pgm\n" + rest).rfind(path("bad.pgm") + ": ", 0), 0U) << picture;
  }
  write("good.pgm", std::string("P5\n1 1\n255\n") + '\xff');
  EXPECT_EQ(error("image: good.pgm\nresolution: 0.1\norigin: [0, 0, 1.5]\n"), "");
}

}  // namespace
}  // namespace navvi_floor
