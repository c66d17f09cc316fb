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
const std::string kCollada =
    "<?xml version='1.0'?><COLLADA version='1.4.1'><asset><unit meter='1'/></asset>"
    "<library_geometries><geometry id='g'><mesh><source id='p'><float_array id='a' count='9'>0 0 0 1 "
    "0 0 0 1 0</float_array><technique_common><accessor source='#a' count='3' stride='3'><param "
    "name='X' type='float'/><param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
    "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
    "<triangles count='1'><input offset='0' semantic='VERTEX' source='#v'/><p>0 1 2</p></triangles>"
    "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='s'><node id='n'>"
    "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_geometry url='#g'/></node>"
    "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";

TEST_F(Fuzz, a_world_is_read_or_refused) {
  const std::string world =
      "<?xml version='1.0'?><sdf version='1.6'><world name='w'>" + ground_ +
      model("rack", "<box><size>1 2 3</size></box>", "3 1 1.5 0 0 0.3") +
      model("post", "<cylinder><radius>0.2</radius><length>2</length></cylinder>", "-3 1 1 0 0 0") +
      model("tool", "<mesh><uri>file.obj</uri><scale>1 1 1</scale></mesh>", "0 4 0 0 0 0") +
      "<actor name='a'><pose>1 1 0 0 0 0</pose><script><trajectory id='0' type='walk'><waypoint>"
      "<time>0</time><pose>1 1 0 0 0 0</pose></waypoint><waypoint><time>9</time><pose>4 1 0 0 0 0"
      "</pose></waypoint></trajectory></script></actor><include><uri>model://m</uri><pose>5 5 0 0 0 0"
      "</pose></include><state world_name='w'><model name='rack'><pose>2 1 1.5 0 0 0</pose></model>"
      "</state></world></sdf>";
  navvi_test::fuzz({world}, "a.world", [](const std::string& path) {
    static_cast<void>(load_world({path, "", 1, Workers::as_laid_out, "", Missing::leave_out}));
  });
}

TEST_F(Fuzz, a_mesh_is_read_or_refused) {
  const auto read = [](const std::string& path) { static_cast<void>(read_mesh(path, {})); };
  navvi_test::fuzz({kMesh}, "a.obj", read);
  navvi_test::fuzz({kFacet, kBinaryStl}, "a.stl", read);
  navvi_test::fuzz({kCollada}, "a.dae", read);
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
