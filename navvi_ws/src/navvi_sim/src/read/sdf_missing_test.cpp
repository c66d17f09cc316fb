// Worlds of which a piece is missing or wrong.

#include <gtest/gtest.h>

#include <algorithm>

#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

class MissingPiece : public SdfFolder {
 protected:
  static std::string include(const std::string& model) {
    return "\n<include><uri>model://" + model + "</uri></include>";
  }
  static std::string cube(const std::string& name, const std::string& pose) {
    return "\n" + model(name, "<box><size>1 1 1</size></box>", pose);
  }
  static std::string mesh(const std::string& file, const std::string& more = "") {
    return "<mesh><uri>" + file + "</uri>" + more + "</mesh>";
  }
  /// Refused by default with `words`; left out, the rest of the world is read.
  void expect_left_out(const std::string& piece, const std::vector<std::string>& words) const {
    const std::string body = ground_ + piece + cube("crate", "3 0 0.5 0 0 0");
    const std::string sentence = sentence_of(write_world(body));
    for (const std::string& word : words)
      EXPECT_NE(sentence.find(word), std::string::npos) << word << " in: " << sentence;
    EXPECT_NE(sentence.find("missing:=leave_out"), std::string::npos) << sentence;
    const LoadedWorld loaded = load_leaving_out(body);
    EXPECT_EQ(loaded.world.things.size(), 2U) << sentence;
    EXPECT_NE(thing_named(loaded.world, "crate"), nullptr);
    std::vector<std::string> loud = words;
    loud.emplace_back("LEFT OUT");
    EXPECT_TRUE(has_note(loaded, loud)) << words[0];
  }
};

TEST_F(MissingPiece, and_all_others_are_named_at_once) {
  const std::string body = ground_ + include("none") + include("nowhere") + include("none") +
                           model("a", mesh("absent.dae")) + cube("far", "0 0 9999 0 0 0") +
                           cube("crate", "3 0 0.5 0 0 0");
  const std::string sentence = sentence_of(write_world(body));
  for (const char* word : {"5 pieces", "line 2", "'model://none'", "'model://nowhere'",
                           "2 more of the same kind", "'absent.dae'", "9999"})
    EXPECT_NE(sentence.find(word), std::string::npos) << word << " in: " << sentence;
  EXPECT_EQ(sentence.find("model://none", sentence.find("model://none") + 1), std::string::npos)
      << "once: " << sentence;
  const LoadedWorld loaded = load_leaving_out(body);
  EXPECT_EQ(loaded.world.things.size(), 2U) << "ground and crate";
  EXPECT_TRUE(has_note(loaded, {"LEFT OUT", "'model://nowhere'"}));
}

TEST_F(MissingPiece, of_a_model_leaves_the_rest_of_the_model) {
  const std::string body = ground_ +
                           "<model name='cart'><link name='l'><collision name='a'><geometry>" +
                           mesh("absent.dae") +
                           "</geometry></collision><collision name='b'><geometry><box><size>1 1 1"
                           "</size></box></geometry></collision></link></model>";
  EXPECT_EQ(thing_named(load_leaving_out(body).world, "cart")->shapes.size(), 1U);
}

TEST_F(MissingPiece, is_a_pose_that_no_stream_reads) {
  const LoadedWorld loaded = load(ground_ + cube("glued", "1 2-0.5 0 0 0"));
  EXPECT_LT(
      (thing_named(loaded.world, "glued")->pose.translation() - Eigen::Vector3d(1, 2, -0.5)).norm(),
      1e-12);
  for (const char* wrong : {"1 2 0 0 0", "1 2 0 0 0 0 0", "1 2 0 0 0 x", "1 2 0 0 0 0x1",
                            "1 2 0 0 0 1e999", "1,2,0,0,0,0"})
    expect_left_out(cube("it", wrong), {"line 2", wrong, "6 finite numbers"});
  expect_left_out(cube("it", "0 0 343582 0 0 0"), {"line 2", "up to 1000 m", "in 'it'"});
}

TEST_F(MissingPiece, is_a_mesh_that_is_flat_far_away_or_too_large) {
  write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_left_out("\n" + model("it", mesh("tri.obj", "<scale>1 0 0</scale>")),
                  {"line 2", "tri.obj", "scale that is zero"});
  write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 8e17 0\nf 1 2 3\n");
  expect_left_out("\n" + model("it", mesh("far.obj")), {"line 2", "far.obj", "8e+17"});
  constexpr std::uint32_t kCount = 1'200'000;
  std::string head(84, '\0');
  for (int i = 0; i < 4; ++i) head[80U + i] = static_cast<char>(kCount >> (8 * i) & 255U);
  write("large.stl", head);
  std::filesystem::resize_file(folder_ / "large.stl", 84 + 50ULL * kCount);
  expect_left_out("\n" + model("it", mesh("large.stl")), {"line 2", "large.stl", "1000000"});
}

TEST_F(MissingPiece, is_a_shape_that_is_not_known) {
  expect_left_out("\n" + model("hill", "<heightmap><uri>a.png</uri></heightmap>"),
                  {"line 2", "<heightmap>"});
}

TEST_F(MissingPiece, is_no_mesh_with_comments_and_blanks) {
  std::string text = collada(
      "<library_effects><effect id='e'><profile_COMMON><technique sid='t'><phong><diffuse><color> "
      "0.3 0.3 0.3 1</color></diffuse></phong></technique></profile_COMMON></effect>"
      "</library_effects><library_materials><material id='m'><instance_effect url='#e'/></material>"
      "</library_materials>",
      "<node><instance_geometry url='#g'/></node>");
  text = replaced(text, "<COLLADA", "<!-- made by hand -->\n<COLLADA");
  text = replaced(text, "0 0 0 1 0 0 0 1 0<", " 0 0 1 2 0 1\n0 3 1<");
  text = replaced(text, "</vertices>", "<!-- no normals --></vertices>");
  text = replaced(text, "count='1'", "count='1' material='m'");
  write("tri.dae", replaced(text, "<p>0", "<p> 0"));
  const LoadedWorld loaded = load(ground_ + model("it", mesh("tri.dae")));
  const Eigen::AlignedBox3d box = bounds(*thing_named(loaded.world, "it"));
  EXPECT_LT((box.max() - Eigen::Vector3d(2, 3, 1)).norm(), 1e-6);
}

TEST_F(MissingPiece, has_a_name_that_is_cut_where_it_is_long) {
  const std::string sentence =
      sentence_of(write_world(ground_ + include(std::string(10'000, 'x'))));
  EXPECT_NE(sentence.find("xxx...'"), std::string::npos) << sentence;
  EXPECT_LT(sentence.size(), 1'000U);
}

TEST_F(MissingPiece, is_said_once_for_all_notes_of_a_kind) {
  std::string body = ground_;
  for (int i = 1; i <= 30; ++i)
    body += "\n<model name='ghost_" + std::to_string(i) + "'><link name='l'/></model>";
  const LoadedWorld loaded = load(body);
  EXPECT_EQ(loaded.notes.size(), 2U) << "this, and that nothing stands";
  EXPECT_TRUE(has_note(loaded, {"'ghost_1'", "29 more of the same kind: 'ghost_2', 'ghost_3'"}));
  EXPECT_FALSE(has_note(loaded, {"'ghost_30'"}));
}

TEST_F(MissingPiece, is_said_to_be_in_the_folder_of_the_repository_that_has_it) {
  write(".git/HEAD", "ref");
  write("media/more/shelf/model.config", "<model/>");
  const std::string world =
      write("worlds/deep/my.world", "<sdf version='1.6'><world name='w'>" + include("shelf") +
                                        include("none") + "</world></sdf>");
  const std::string sentence = sentence_of(world);
  EXPECT_NE(sentence.find("models:=" + (folder_ / "media/more").string() + " has it"),
            std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("give its folder as models"), std::string::npos) << sentence;
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Depot";
  EXPECT_NE(sentence_of(write_world("<include><uri>" + fuel + "</uri></include>"))
                .find("gz fuel download -u " + fuel),
            std::string::npos);
}

TEST_F(MissingPiece, is_found_in_the_folder_that_the_package_exports_to_gazebo) {
  write("package.xml",
        "<package><export><gazebo_ros gazebo_model_path=\"${prefix}/media\"/></export></package>");
  write("media/crate/model.sdf", "<sdf version='1.6'>" + cube("crate", "3 0 0.5 0 0 0") + "</sdf>");
  const std::string world =
      write("worlds/deep/my.world",
            "<sdf version='1.6'><world name='w'>" + ground_ + include("crate") + "</world></sdf>");
  EXPECT_NE(thing_named(load_world({world}).world, "crate"), nullptr);
}

}  // namespace
}  // namespace navvi_sim::read
