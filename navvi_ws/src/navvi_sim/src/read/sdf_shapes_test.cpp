#include <gtest/gtest.h>

#include <cmath>

#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

/// A tetrahedron and a cube as two groups of an OBJ file, apart from each other.
constexpr const char* kTwoParts =
    "o tetra\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"
    "o sheet\nv 10 10 0\nv 12 10 0\nv 12 10 2\nf 5 6 7\n";

class SdfShapesTest : public SdfFolder {
 protected:
  /// The one thing beside the ground.
  Thing thing_of(const std::string& geometry) const {
    const LoadedWorld loaded = load(ground_ + model("it", geometry), "1.9");
    const Thing* thing = thing_named(loaded.world, "it");
    return thing == nullptr ? Thing{} : *thing;
  }
};

TEST_F(SdfShapesTest, are_box_cylinder_and_sphere_as_they_are_and_a_capsule_is_of_these) {
  struct Row {
    const char* geometry;
    std::size_t shapes;
    Eigen::Vector3d size;
  };
  for (const Row& row :
       {Row{"<box><size>1 2 3</size></box>", 1, {1, 2, 3}},
        Row{"<cylinder><radius>0.5</radius><length>2</length></cylinder>", 1, {1, 1, 2}},
        Row{"<sphere><radius>0.5</radius></sphere>", 1, {1, 1, 1}},
        Row{"<capsule><radius>0.2</radius><length>1</length></capsule>", 3, {0.4, 0.4, 1.4}}}) {
    const Thing thing = thing_of(row.geometry);
    EXPECT_EQ(thing.shapes.size(), row.shapes) << row.geometry;
    EXPECT_LT((bounds(thing).sizes() - row.size).norm(), 1e-9) << row.geometry;
  }
}

TEST_F(SdfShapesTest, are_all_taken_with_a_note_where_a_geometry_has_several) {
  const std::string two = "<box><size>1 1 1</size></box><sphere><radius>0.2</radius></sphere>";
  const LoadedWorld loaded = load(ground_ + model("it", two), "1.9");
  EXPECT_EQ(thing_named(loaded.world, "it")->shapes.size(), 2U);
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_NE(loaded.notes[0].find("of 'it' has several shapes"), std::string::npos);
}

TEST_F(SdfShapesTest, make_a_cone_with_its_tip_up) {
  const Thing cone = thing_of("<cone><radius>0.5</radius><length>2</length></cone>");
  ASSERT_EQ(cone.shapes.size(), 1U);
  EXPECT_NEAR(bounds(cone).max().z(), 1.0, 1e-6);
  EXPECT_NEAR(bounds(cone).min().z(), -1.0, 1e-6);
  EXPECT_NEAR(bounds(cone).sizes().x(), 1.0, 0.02);
  const auto& mesh = *std::get<std::shared_ptr<const Mesh>>(cone.shapes[0].geometry);
  double volume = 0.0;  // of a closed surface whose sides all face outwards
  for (const auto& side : mesh.triangles)
    volume +=
        mesh.vertices[side[0]].cross(mesh.vertices[side[1]]).dot(mesh.vertices[side[2]]) / 6.0;
  EXPECT_NEAR(volume, 3.14159 * 0.25 * 2.0 / 3.0, 0.02);
}

TEST_F(SdfShapesTest, make_a_mesh_of_an_ellipsoid_and_a_sphere_of_a_round_one) {
  const Thing egg = thing_of("<ellipsoid><radii>0.2 0.4 0.6</radii></ellipsoid>");
  EXPECT_LT((bounds(egg).sizes() - Eigen::Vector3d(0.4, 0.8, 1.2)).norm(), 1e-6);
  const auto& mesh = *std::get<std::shared_ptr<const Mesh>>(egg.shapes.at(0).geometry);
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const std::uint32_t corner : triangle) middle += mesh.vertices[corner] / 3.0F;
    const float depth = middle.cwiseQuotient(Eigen::Vector3f(0.2F, 0.4F, 0.6F)).norm();
    EXPECT_GT(depth, 0.98F);
    EXPECT_LE(depth, 1.001F);
  }
  const Thing ball = thing_of("<ellipsoid><radii>0.4 0.4 0.4</radii></ellipsoid>");
  EXPECT_TRUE(std::holds_alternative<Sphere>(ball.shapes.at(0).geometry));
}

double area_of(const Mesh& mesh, double z) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f normal =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    const bool there = std::abs(static_cast<double>(mesh.vertices[a].z()) - z) < 1e-6 &&
                       std::abs(normal.z()) > 0.999F * normal.norm();
    if (there) area += static_cast<double>(normal.norm()) / 2.0;
  }
  return area;
}

TEST_F(SdfShapesTest, make_a_prism_of_a_polyline_either_way_round) {
  const std::string l_shape =
      "<polyline><height>2</height><point>0 0</point><point>2 0</point><point>2 1</point>"
      "<point>1 1</point><point>1 3</point><point>0 3</point><point>0 0</point></polyline>";
  const std::string other_way =
      "<polyline><height>2</height><point>0 3</point><point>1 3</point><point>1 1</point>"
      "<point>2 1</point><point>2 0</point><point>0 0</point></polyline>";
  for (const std::string& polyline : {l_shape, other_way}) {
    const Thing thing = thing_of(polyline);
    ASSERT_EQ(thing.shapes.size(), 1U);
    const auto& mesh = *std::get<std::shared_ptr<const Mesh>>(thing.shapes[0].geometry);
    EXPECT_NEAR(area_of(mesh, 0.0), 4.0, 1e-6);
    EXPECT_NEAR(area_of(mesh, 2.0), 4.0, 1e-6);
    EXPECT_LT((bounds(thing).sizes() - Eigen::Vector3d(2, 3, 2)).norm(), 1e-6);
  }
}

TEST_F(SdfShapesTest, take_a_submesh_by_its_name_and_centre_it) {
  write("two.obj", kTwoParts);
  const auto mesh = [&](const std::string& more) {
    return thing_of("<mesh><uri>two.obj</uri>" + more + "</mesh>");
  };
  EXPECT_NEAR(bounds(mesh("")).max().x(), 12.0, 1e-6);
  const Eigen::AlignedBox3d tetra = bounds(mesh("<submesh><name>tetra</name></submesh>"));
  EXPECT_LT((tetra.max() - Eigen::Vector3d(1, 1, 1)).norm(), 1e-6);
  const Eigen::AlignedBox3d sheet = bounds(
      mesh("<submesh><name>sheet</name><center>true</center></submesh><scale>2 1 1</scale>"));
  EXPECT_LT((sheet.max() - Eigen::Vector3d(2, 0, 1)).norm(), 1e-6);
  EXPECT_LT((sheet.min() + Eigen::Vector3d(2, 0, 1)).norm(), 1e-6);
  const std::string sentence = sentence_of(write_world(
      ground_ +
      model("it", "<mesh><uri>two.obj</uri><submesh><name>none</name></submesh></mesh>")));
  EXPECT_NE(sentence.find("'sheet', 'tetra'"), std::string::npos) << sentence;
}

TEST_F(SdfShapesTest, that_are_too_odd_are_refused_with_line_and_what_is_allowed) {
  const std::vector<std::string> geometries{
      "<box/>",
      "<box><size>1 1</size></box>",
      "<box><size>1 1 1 1</size></box>",
      "<box><size>1 1 one</size></box>",
      "<box><size>1 1 nan</size></box>",
      "<box><size>1 1 inf</size></box>",
      "<box><size>1 1 0</size></box>",
      "<box><size>1 1 -1</size></box>",
      "<box><size>1 1 1e9</size></box>",
      "<cylinder><radius>1</radius></cylinder>",
      "<cylinder><radius>0</radius><length>1</length></cylinder>",
      "<sphere><radius>1e400</radius></sphere>",
      "<sphere><radius></radius></sphere>",
      "<capsule><radius>1</radius><length>-1</length></capsule>",
      "<ellipsoid><radii>1 2 0</radii></ellipsoid>",
      "<polyline><height>1</height><point>0 0</point><point>1 0</point></polyline>",
      "<polyline><height>1</height><point>0 0</point><point>1 0</point><point>2 0</point>"
      "</polyline>",
      "<polyline><height>1</height><point>0 0</point><point>1 1e7</point><point>2 0</point>"
      "</polyline>",
      "<polyline><height>1</height><point>0 0</point><point>2 2</point><point>2 0</point>"
      "<point>0 2.1</point></polyline>",
      "<polyline><height>0</height><point>0 0</point><point>1 0</point><point>0 1</point>"
      "</polyline>",
      "<plane><normal>0 0</normal></plane>",
      "<mesh/>",
      "<mesh><uri></uri></mesh>",
      "<mesh><uri>.</uri></mesh>",
      "<mesh><uri>two.obj</uri><scale>1 0 1</scale></mesh>",
      "<mesh><uri>two.obj</uri><scale>1 1</scale></mesh>",
      "<mesh><uri>two.obj</uri><submesh/></mesh>",
      "<mesh><uri>far.obj</uri></mesh>",
      "<mesh><uri>nan.obj</uri></mesh>",
      "<mesh><uri>range.obj</uri></mesh>",
      "<mesh><uri>empty.obj</uri></mesh>",
      "<mesh><uri>words.stl</uri></mesh>",
      "<mesh><uri>model://../outside.obj</uri></mesh>",
      "<mesh><uri>model://models/../../outside.obj</uri></mesh>",
      "<mesh><uri>http://example.org/a.obj</uri></mesh>",
      "<mesh><uri>/dev/zero</uri></mesh>",
  };
  write("two.obj", kTwoParts);
  write("far.obj", "v 0 0 0\nv 1e8 0 0\nv 0 1 0\nf 1 2 3\n");
  write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 30\n");
  write("empty.obj", "");
  write("words.stl", "solid x\nfacet\n");
  for (const std::string& geometry : geometries) {
    const std::string sentence =
        sentence_of(write_world(ground_ + "\n\n" + model("it", geometry), "1.9"));
    EXPECT_NE(sentence.find("a.world"), std::string::npos) << geometry << ": " << sentence;
    EXPECT_NE(sentence.find("; "), std::string::npos) << geometry << ": " << sentence;
    const bool has_line = sentence.find("line 3") != std::string::npos;
    EXPECT_TRUE(has_line || geometry.find("far") != std::string::npos) << sentence;
  }
}

}  // namespace
}  // namespace navvi_sim::read
