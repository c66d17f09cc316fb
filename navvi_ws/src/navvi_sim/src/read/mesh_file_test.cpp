#include "read/mesh_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

const std::string kPiece = "<instance_geometry url='#g'/>";

class MeshFile : public SdfFolder {
 protected:
  /// What a mesh is refused with; empty if it is read.
  std::string refusal(const std::string& name, const std::string& text) const {
    try {
      triangles_ = read_mesh(write(name, text), {}).triangles.size();
    } catch (const WorldError& error) {
      return error.what();
    }
    return "";
  }
  mutable std::size_t triangles_ = 0;  ///< of the last one that was read
};

TEST_F(MeshFile, takes_collada_apart_node_by_node) {
  EXPECT_EQ(refusal("a.dae", collada("", "<node id='n'>" + kPiece + "</node>")), "");
  EXPECT_EQ(triangles_, 1U);
  // A node of the scene may have the name of the one that it instances.
  const std::string library = "<library_nodes><node id='wheel'>" + kPiece +
                              "</node>"
                              "<node id='two'><instance_node url='#wheel'/><node>" +
                              kPiece + "</node></node></library_nodes>";
  EXPECT_EQ(refusal("b.dae", collada(library,
                                     "<node name='wheel'><instance_node url='#wheel'/>"
                                     "<instance_node url='#two'/></node>")),
            "");
  EXPECT_EQ(triangles_, 3U);
  EXPECT_EQ(refusal("c.DAE", collada("", repeated("<node>" + kPiece + "</node>", 5000))), "");
  EXPECT_EQ(triangles_, 5000U);
}

TEST_F(MeshFile, refuses_collada_whose_array_is_shorter_than_what_is_read_of_it) {
  std::string text = collada("", "<node id='n'>" + kPiece + "</node>");
  text.replace(text.find("count='9'"), 9, "count='0'");
  EXPECT_NE(refusal("a.dae", text).find("smaller count"), std::string::npos);
}

TEST_F(MeshFile, survives_collada_whose_reader_crashes_or_never_ends) {
  std::string levels = "<library_nodes><node id='n0'>" + kPiece + "</node>";
  for (int i = 1; i <= 10; ++i)
    levels += "<node id='n" + std::to_string(i) + "'>" +
              repeated("<instance_node url='#n" + std::to_string(i - 1) + "'/>", 10) + "</node>";
  levels += "</library_nodes>";
  std::string word = collada("", "<node>" + kPiece + "</node>");
  word.replace(word.find("0 1 2</p>"), 5, "0 1 foo");
  for (const std::string& text :
       {collada(levels, "<node><instance_node url='#n10'/></node>"), word,
        collada("", "<node id='n'>" + kPiece + "<instance_node url='#n'/></node>"),
        collada(repeated("<a>", 200'000) + repeated("</a>", 200'000), "")})
    EXPECT_NE(refusal("bad.dae", text).find("bad.dae"), std::string::npos) << text.substr(0, 1000);
  EXPECT_EQ(refusal("few.dae", collada(levels, "<node><instance_node url='#n3'/></node>")), "");
  EXPECT_EQ(triangles_, 1000U);
}

TEST_F(MeshFile, opens_the_mesh_alone_and_no_file_that_it_names) {
  ASSERT_EQ(mkfifo((folder_ / "x.mtl").c_str(), 0600), 0);
  EXPECT_EQ(refusal("a.obj", "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"), "");
  EXPECT_EQ(triangles_, 1U);
  EXPECT_EQ(refusal("b.obj", "mtllib ../../../../etc/passwd\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            "");
  ASSERT_EQ(mkfifo((folder_ / "pipe.stl").c_str(), 0600), 0);
  EXPECT_THROW(static_cast<void>(read_mesh(folder_ / "pipe.stl", {})), WorldError);
}

TEST_F(MeshFile, refuses_what_is_neither_dae_nor_stl_nor_obj) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
      "3 0 1 2\n";
  for (const char* name : {"a.ply", "a.gltf", "a.fbx", "a", "a.dae.ply"}) {
    const std::string sentence = refusal(name, ply);
    EXPECT_NE(sentence.find("allowed are .dae, .stl and .obj files"), std::string::npos) << name;
  }
  for (const char* name : {"a.dae", "a.stl", "a.obj"}) EXPECT_NE(refusal(name, ply), "") << name;
  EXPECT_EQ(refusal("A.STL",
                    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                    "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n"),
            "");
}

TEST_F(MeshFile, without_extent_or_with_corners_that_are_no_numbers_is_refused) {
  const auto stl = [](const std::string& corner) {
    return "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " +
           corner + "\nendloop\nendfacet\nendsolid a\n";
  };
  EXPECT_EQ(refusal("good.stl", stl("0 1 0")), "");
  EXPECT_NE(refusal("nan.stl", stl("nan 1 0")), "");
  EXPECT_NE(refusal("inf.stl", stl("0 inf 0")), "");
  const auto node = [](const std::string& inside) {
    return collada("", "<node id='n'>" + inside + kPiece + "</node>");
  };
  const std::string zeros = "<matrix>0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1</matrix>";
  EXPECT_NE(refusal("zeros.dae", node(zeros)).find("less than 1 mm"), std::string::npos);
  EXPECT_NE(refusal("tiny.dae", node("<scale>1e-30 1e-30 1e-30</scale>")).find("less than 1 mm"),
            std::string::npos);
}

}  // namespace
}  // namespace navvi_sim::read
