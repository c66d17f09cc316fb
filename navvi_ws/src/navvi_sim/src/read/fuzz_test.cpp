// Damaged worlds, meshes, layouts and rules.

#include "fuzz.hpp"

#include <gtest/gtest.h>

#include "generate/layout_source.hpp"
#include "read/class_rules.hpp"
#include "read/mesh_file.hpp"
#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

class Fuzz : public SdfFolder {};

const std::string kMesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\ng part\nf 1//1 2//1 3//1\nf -3 -2 -1\n";
const std::string kFacet =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid s\n";
const std::string kBinaryStl = std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0');

/// A small world with something of everything.
constexpr const char* kSmall = R"(<?xml version='1.0'?>
<sdf version='1.9'><world name='w'><light name='sun' type='point'/>
<frame name='f'><pose relative_to='crate'>1 0 0 0 0 0</pose></frame>
<model name='ground'><link name='l'><collision name='c'><pose>0 0 -0.05 0 0 0</pose><geometry>
<box><size>20 20 0.1</size></box></geometry></collision></link></model>
<model name='crate' placement_frame='l'><pose degrees='true'>2 0 0.5 0 0 30</pose><link name='l'>
<collision name='c'><geometry><cylinder><radius>0.4</radius><length>1</length></cylinder></geometry>
</collision><visual name='v'/></link><joint name='j' type='fixed'><parent>world</parent><child>l
</child></joint></model>
<model name='shelf'><pose relative_to='f'>0 3 1 0 0 0</pose><link name='l'><collision name='c'>
<geometry><mesh><uri>m.obj</uri><scale>1 1 2</scale></mesh></geometry></collision></link><model
 name='in'><link name='k'><collision name='d'><geometry><capsule><radius>0.1</radius><length>1</length>
</capsule></geometry></collision></link></model></model>
<include><uri>model://part</uri><name>p1</name><pose>0 -3 0 0 0 0</pose></include>
<model name='post'><link name='l'><collision name='c'><geometry><polyline><height>1</height>
<point>0 0</point><point>1 0</point><point>0 1</point></polyline></geometry></collision></link>
<plugin name='p' filename='gz-sim-trajectory-follower-system'><loop>true</loop><waypoints>
<waypoint>4 0</waypoint><waypoint>4 4</waypoint></waypoints></plugin></model>
<actor name='ann'><script><loop>true</loop><delay_start>1</delay_start><trajectory id='0' type='w'>
<waypoint><time>0</time><pose>0 0 1 0 0 0</pose></waypoint><waypoint><time>3</time>
<pose>3 0 1 0 0 0</pose></waypoint></trajectory></script></actor>
<state world_name='w'><model name='post'><pose>1 1 0 0 0 0</pose></model></state>
</world></sdf>)";

TEST_F(Fuzz, a_world_is_read_or_refused_by_its_name) {
  write("m.obj", kMesh);
  write_model("part", cube_);
  ASSERT_EQ(sentence_of(write("a.world", kSmall)), "");
  const std::string models = (folder_ / "models").string();
  navvi_test::fuzz({kSmall}, "a.world", [&](const std::string& path) {
    try {
      static_cast<void>(load_world({path, models, 1, Workers::as_laid_out, "", Missing::leave_out}));
    } catch (const WorldError& error) {
      EXPECT_NE(std::string(error.what()).find("a.world"), std::string::npos) << error.what();
      throw;
    }
  });
}

TEST_F(Fuzz, a_mesh_is_read_or_refused) {
  const auto read = [](const std::string& path) { static_cast<void>(read_mesh(path, {})); };
  navvi_test::fuzz({kMesh}, "a.obj", read);
  navvi_test::fuzz({kFacet, kBinaryStl}, "a.stl", read);
  const std::string node = "<node><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>"
                           "<instance_geometry url='#g'/></node>";
  navvi_test::fuzz({collada("", node)}, "a.dae", read);
}

TEST_F(Fuzz, a_layout_is_built_or_refused) {
  navvi_test::fuzz({"name: hall\npreset: easy\nlayout:\n  length: 30\n  width: 20\n  forklifts: 2\n  workers: 1\n"},
                   "a.yaml", [](const std::string& path) {
                     static_cast<void>(generate::read_layout(path));
                   });
}

TEST_F(Fuzz, rules_of_classes_are_read_or_refused) {
  navvi_test::fuzz({"- {class: shelf, names: [\"*rack*\", shelf?]}\n- {class: worker, names: [person]}\n"},
                   "a.yaml", [](const std::string& path) {
                     static_cast<void>(ClassRules::read(path));
                   });
}

}  // namespace
}  // namespace navvi_sim::read

/// assimp loses memory over some broken files; the leak sanitizer asks here what is not ours.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp"; }
