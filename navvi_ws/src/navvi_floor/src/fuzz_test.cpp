// Damaged maps.

#include "fuzz.hpp"

#include <gtest/gtest.h>

#include "navvi_floor/map_survey.hpp"
#include "navvi_floor/map_file.hpp"
#include "navvi_floor/zones.hpp"
#include "voxel_world.hpp"

namespace navvi_floor {
namespace {

/// As fuzz() wants it: these readers return their sentence.
void survey(const std::string& path, const std::string& picture = {}) {
  const MapSurvey read = survey_file(path, {}, picture);
  if (!read.error.empty()) throw std::runtime_error(read.error);
}

TEST(FuzzMaps, octomap_files_are_read_or_refused) {
  SmallWorld world;
  octomap::OcTree tree = world.room(2, 2).box(1, 1, 0, 1.5, 1.5, 0.5).tree();
  const navvi_test::TempFolder folder;
  ASSERT_TRUE(tree.writeBinary((folder / "a.bt").string()));
  ASSERT_TRUE(tree.write((folder / "a.ot").string()));
  navvi_test::fuzz({folder.text("a.bt")}, "a.bt", [](const std::string& path) { survey(path); });
  navvi_test::fuzz({folder.text("a.ot")}, "a.ot", [](const std::string& path) { survey(path); });
}

TEST(FuzzMaps, files_of_map_server_and_their_pictures_are_read_or_refused) {
  const std::string picture = "P5\n# hall\n20 20\n255\n" + std::string(200, '\xfe') + std::string(200, '\0');
  const std::string map =
      "image: a.pgm\nresolution: 0.05\norigin: [-1.0, -2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\nmode: trinary\n";
  const navvi_test::TempFolder folder;
  const std::string whole_picture = folder.write("a.pgm", picture), whole_map = folder.write("a.yaml", map);
  navvi_test::fuzz({map}, "b.yaml", [&](const std::string& path) { survey(path, whole_picture); });
  navvi_test::fuzz({picture}, "b.pgm", [&](const std::string& path) { survey(whole_map, path); });
}

TEST(FuzzMaps, zones_are_read_or_refused) {
  const std::string zones =
      "- {name: press shop, kind: keep_out, corners: [0, 0, 4, 0, 4, 2.5]}\n"
      "- {name: packing, kind: slow, speed: 0.4, corners: [-1, -1, 1e1, -1, 4, 2]}\n";
  navvi_test::fuzz({zones}, "zones.yaml", [](const std::string& path) { (void)Zones(path); });
}

}  // namespace
}  // namespace navvi_floor
