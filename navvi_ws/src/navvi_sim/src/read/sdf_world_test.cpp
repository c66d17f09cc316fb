#include "read/sdf_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

class SdfWorld : public SdfFolder {};

TEST_F(SdfWorld, that_ships_is_a_room_with_a_shelf) {
  const LoadedWorld loaded = load_world({std::string(NAVVI_SIM_DIR) + "/worlds/small_room.world"});
  EXPECT_TRUE(loaded.notes.empty());
  EXPECT_EQ(loaded.world.name, "small_room");
  EXPECT_EQ(loaded.world.things.size(), 8U);
  EXPECT_NEAR(loaded.world.floor_height, 0.0, 1e-9);
  const Thing* shelf = thing_named(loaded.world, "shelf");
  ASSERT_NE(shelf, nullptr);
  EXPECT_EQ(shelf->thing_class, ThingClass::shelf);
  EXPECT_EQ(shelf->shapes.size(), 4U) << "one of them in a nested model";
  EXPECT_NEAR(bounds(*shelf).max().x(), 2.0, 1e-9);
  EXPECT_EQ(thing_named(loaded.world, "pedestal")->thing_class, ThingClass::pedestal);
  EXPECT_EQ(thing_named(loaded.world, "box_upper")->thing_class, ThingClass::box);
  EXPECT_EQ(thing_named(loaded.world, "worker")->thing_class, ThingClass::worker);
  const navvi_floor::Voxels voxels = occupancy::voxels_of(loaded.world, {});
  EXPECT_GT(scenario::draw_scenario(loaded.world, voxels, {}, 1).route_length, 5.0);
}

TEST_F(SdfWorld, adds_up_poses_of_frame_model_link_and_collision) {
  write_model(
      "crate",
      "<link name='l'><pose>0 2 0 0 0 0</pose><collision name='c'><pose>0 0 0.5 0 0 0</pose>"
      "<geometry><box><size>1 1 1</size></box></geometry></collision></link>");
  const LoadedWorld loaded =
      load(ground_ +
               "<frame name='f'><pose>3 0 0 0 0 0</pose></frame><model name='crate_1'><include>"
               "<uri>model://crate</uri></include><pose relative_to='f'>1 0 0 0 0 "
               "1.5707963267948966</pose></model>",
           "1.7");
  const Thing* crate = thing_named(loaded.world, "crate_1");
  ASSERT_NE(crate, nullptr);
  EXPECT_LT((bounds(*crate).center() - Eigen::Vector3d(2.0, 0.0, 0.5)).norm(), 1e-9);
}

TEST_F(SdfWorld, takes_geometry_whatever_the_masses_are) {
  const LoadedWorld loaded = load_world({write_world(
      ground_ +
      "<model name='box'><link name='l'><inertial><mass>-3</mass><inertia><ixx>-1</ixx>"
      "</inertia></inertial><collision name='c'><geometry><box><size>1 1 1</size></box>"
      "</geometry></collision></link></model>")});
  EXPECT_NE(thing_named(loaded.world, "box"), nullptr);
}

TEST_F(SdfWorld, makes_a_floor_of_an_endless_plane) {
  const LoadedWorld loaded = load_world({write_world(
      "<model name='ground_plane'><link name='l'><collision name='c'><geometry><plane>"
      "<normal>0 0 1</normal><size>100 100</size></plane></geometry></collision></link>"
      "</model><model name='box'><pose>4 0 0.5 0 0 0</pose>" +
      cube_ + "</model>")});
  EXPECT_NEAR(loaded.world.floor_height, 0.0, 1e-9);
  EXPECT_EQ(thing_named(loaded.world, "ground_plane")->thing_class, ThingClass::floor);
}

TEST_F(SdfWorld, takes_no_thing_for_a_floor_because_of_its_name) {
  const std::string lamp = "<cylinder><radius>0.3</radius><length>1.5</length></cylinder>";
  const LoadedWorld loaded =
      load(ground_ + model("floor_lamp", lamp, "0 0 0.75 0 0 0") +
           box("floor_1_box", "1 1 1", "3 0 0.5") + box("floor_mat", "3 3 0.002", "6 0 0.001") +
           "<model name='ground_house'><link name='l'><collision name='a'><pose>-5 0 -0.05 0 0 0"
           "</pose><geometry><box><size>4 4 0.1</size></box></geometry></collision>"
           "<collision name='b'><pose>-7 0 1 0 0 0</pose><geometry><box><size>0.1 4 2</size></box>"
           "</geometry></collision></link></model>");
  EXPECT_EQ(thing_named(loaded.world, "floor_lamp")->thing_class, ThingClass::other);
  EXPECT_EQ(thing_named(loaded.world, "floor_1_box")->thing_class, ThingClass::box);
  EXPECT_EQ(thing_named(loaded.world, "floor_mat")->thing_class, ThingClass::floor);
  EXPECT_EQ(thing_named(loaded.world, "ground_house")->thing_class, ThingClass::floor);
}

TEST_F(SdfWorld, has_its_floor_where_the_things_stand) {
  const std::string storeys =
      box("floor_01", "20 20 0.1", "0 0 -0.05") + box("floor_02", "20 20 0.1", "0 0 2.95");
  EXPECT_NEAR(load(storeys).world.floor_height, 0.0, 1e-9) << "the lower of two that are bare";
  const LoadedWorld below = load(storeys + box("shelf_a", "1 4 2", "3 0 1"));
  EXPECT_NEAR(below.world.floor_height, 0.0, 1e-9);
  EXPECT_NE(thing_named(below.world, "shelf_a"), nullptr);
  EXPECT_NEAR(load(storeys + box("shelf_a", "1 4 2", "3 0 4")).world.floor_height, 3.0, 1e-9);
}

TEST_F(SdfWorld, has_its_floor_on_a_slab_and_not_where_furniture_leads_up) {
  const std::string slab = box("floor_01", "16 16 0.1", "0 0 -0.05");
  const LoadedWorld on_slab =
      load("<include><uri>model://ground_plane</uri><pose>0 0 -0.1 0 0 0</pose></include>" + slab +
           box("shelf_a", "1 4 2", "3 0 1"));
  EXPECT_NEAR(on_slab.world.floor_height, 0.0, 1e-9);
  EXPECT_EQ(thing_named(on_slab.world, "floor_01")->thing_class, ThingClass::floor);
  std::string storeys =
      slab + box("floor_02", "16 16 0.1", "0 0 2.95") + box("floor_03", "16 16 0.1", "0 0 5.95");
  for (int i = 0; i < 6; ++i)
    storeys += box("floor_02_chair_" + std::to_string(i), "1 1 0.1",
                   std::to_string(i) + " 0 " + std::to_string(3.45 + 0.5 * i));
  for (int i = 0; i < 4; ++i)
    storeys += box("shelf_" + std::to_string(i), "1 1 2", std::to_string(i) + " 4 1");
  const LoadedWorld below = load(storeys);
  EXPECT_NEAR(below.world.floor_height, 0.0, 1e-9);
  EXPECT_EQ(below.world.things.size(), 5U) << "the lowest slab and its shelves";
}

TEST_F(SdfWorld, is_read_without_storeys_and_ceilings_above_its_floor) {
  const LoadedWorld loaded =
      load(box("floor_01", "20 20 0.1", "0 0 -0.05") + box("floor_02", "20 20 0.1", "0 0 2.95") +
           box("shelf_a", "1 4 2", "3 0 1") + box("lamp", "0.2 0.2 0.2", "0 0 2.5") +
           box("shelf_b", "1 4 2", "3 0 4") + box("bed", "1 2 0.5", "0 0 3.25"));
  EXPECT_NEAR(loaded.world.floor_height, 0.0, 1e-9);
  EXPECT_NE(thing_named(loaded.world, "shelf_a"), nullptr);
  EXPECT_NE(thing_named(loaded.world, "lamp"), nullptr) << "it hangs below";
  EXPECT_EQ(loaded.world.things.size(), 3U);
  EXPECT_TRUE(has_note(loaded, {"STOREY OR CEILING at 3 m", "3 things", "'floor_02'", "'bed'"}));
}

TEST_F(SdfWorld, names_what_is_not_static_and_hangs_in_the_air) {
  write("table.obj",
        "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv -1 -1 0\nv 1 -1 0\nf 1 2 3\nf 1 3 4\n"
        "f 1 2 6\nf 1 6 5\n");
  const std::string link =
      "<link name='l'><collision name='c'><geometry><box><size>1 1 1</size></box></geometry>"
      "</collision></link>";
  const auto at = [&](const std::string& name, const std::string& pose, const std::string& more) {
    return "<model name='" + name + "'>" + more + "<pose>" + pose + " 0 0 0</pose>" + link +
           "</model>\n";
  };
  write_model("loose", link);
  const std::string include = "<include><uri>model://loose</uri>";
  const LoadedWorld loaded = load(
      ground_ + "\n" + at("on_floor", "-5 0 0.5", "") + at("hangs", "2 0 3", "") +
      at("fixed", "2 3 3", "<static>true</static>") + at("upper", "-5 0 1.52", "") +
      model("table", "<mesh><uri>table.obj</uri></mesh>", "5 5 0 0 0 0") +
      at("on_table", "5 5 1.5", "") + at("over_table", "5 5 3.5", "") +
      at("hinged", "-3 5 3",
         "<joint name='j' type='revolute'><parent>world</parent><child>l"
         "</child></joint>") +
      "<model name='light'><pose>-3 -5 3 0 0 0</pose><link name='l'><gravity>0</gravity><collision "
      "name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link></model>" +
      include + "<name>put</name><static>1</static><pose>0 5 3 0 0 0</pose></include>" + include +
      "<name>dropped</name><pose>0 -5 3 0 0 0</pose></include>");
  EXPECT_TRUE(has_note(loaded, {"'hangs' is not static", "here it stays in the air", "2 more",
                                "'over_table'", "'dropped'"}));
  for (const char* carried :
       {"'on_floor'", "'fixed'", "'upper'", "'on_table'", "'hinged'", "'light'", "'put'"})
    EXPECT_FALSE(has_note(loaded, {carried})) << carried;
  EXPECT_NEAR(bounds(*thing_named(loaded.world, "hangs")).min().z(), 2.5, 1e-9);
  EXPECT_FALSE(
      has_note(load("<gravity>0 0 0</gravity>" + ground_ + at("hangs", "2 0 3", "")), {"hangs"}));
}

TEST_F(SdfWorld, has_the_floor_of_its_building_where_nothing_is_named_one) {
  write("house.obj",
        "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nv -5 -5 3\nv 5 -5 3\n"
        "f 1 2 3\nf 1 3 4\nf 1 2 6\nf 1 6 5\n");
  write("walls.obj",
        "v 0 0 0\nv 9 0 0\nv 9 0.5 0\nv 0 0.5 0\nv 0 0 3\nv 9 0 3\nv 9 0.5 3\nv 0 0.5 3\n"
        "v 0 9 0\nv 1 9 0\nv 1 9 3\n"
        "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 9 10 11\n");
  const auto building = [](const std::string& file) {
    return model("office", "<mesh><uri>" + file + "</uri></mesh>") +
           box("desk", "1 1 0.7", "2 2 0.35");
  };
  const LoadedWorld loaded = load(building("house.obj"));
  EXPECT_NEAR(loaded.world.floor_height, 0.0, 1e-9);
  EXPECT_EQ(thing_named(loaded.world, "office")->thing_class, ThingClass::floor);
  EXPECT_EQ(thing_named(loaded.world, "desk")->thing_class, ThingClass::other);
  EXPECT_TRUE(has_note(loaded, {"'office' has one of its own"}));
  const std::string sentence = sentence_of(write_world(building("walls.obj")));
  EXPECT_NE(sentence.find("add <include><uri>model://ground_plane</uri></include>"),
            std::string::npos)
      << sentence;
}

TEST_F(SdfWorld, is_refused_if_much_of_it_lies_under_the_floor) {
  std::string body = ground_;
  for (int i = 0; i < 3; ++i) body += box("crate_" + std::to_string(i), "1 1 1", "0 0 -5");
  const std::string sentence = sentence_of(write_world(body));
  EXPECT_NE(sentence.find("3 of 4 things lie under the floor"), std::string::npos) << sentence;
}

TEST_F(SdfWorld, lists_by_name_and_line_what_it_does_not_take_over) {
  const LoadedWorld loaded =
      load("<light name='lamp' type='point'/>\n" + ground_ +
           "\n<model name='ghost'><link name='l'/></model>\n" + "\n" +
           model("ramp", "<plane><normal>1 0 1</normal></plane>") + "\n" +
           box("cellar", "1 1 1", "0 0 -5") + "\n" + "<model name='door'>" + cube_ +
           "<joint name='hinge' type='revolute'><parent>world</parent><child>l</child></joint>\n"
           "<plugin name='opener' filename='libDoor.so'/>\n"
           "<link name='sign'><visual name='v'/></link></model>\n"
           "<bench name='seat'/>\n<plugin name='weather' filename='libRain.so'/>\n"
           "<road name='street'/>");
  EXPECT_EQ(loaded.world.things.size(), 2U) << "ground and door";
  EXPECT_TRUE(has_note(loaded, {"line 3", "ghost", "no collision geometry"}));
  EXPECT_TRUE(has_note(loaded, {"line 5", "ramp", "not level"}));
  EXPECT_TRUE(has_note(loaded, {"line 6", "cellar", "far below the floor"}));
  EXPECT_TRUE(has_note(loaded, {"line 8", "plugins move", "stands still here: 'door'"}));
  EXPECT_TRUE(has_note(loaded, {"line 9", "sign", "touches nothing"}));
  EXPECT_TRUE(has_note(loaded, {"line 10", "<bench>"}));
  EXPECT_TRUE(has_note(loaded, {"without meaning", "'weather', line 11", "'street', line 12"}));
  EXPECT_TRUE(has_note(loaded, {"without meaning", "'lamp', line 1", "'hinge', line 7"}));
  EXPECT_TRUE(has_note(loaded, {"ghost", "1 more of the same kind: 'ramp'"}));
  EXPECT_EQ(loaded.notes.size(), 7U);
}

TEST_F(SdfWorld, names_all_that_plugins_move_in_one_line) {
  std::string body = ground_;
  for (const char* name : {"door", "lift", "walker"})
    body += "<model name='" + std::string(name) + "'><static>true</static>" + cube_ +
            "<plugin name='p' filename='lib" + name + ".so'/></model>";
  const LoadedWorld loaded = load(body);
  EXPECT_TRUE(has_note(loaded, {"stands still here: 'door', 'lift', 'walker'"}));
  EXPECT_EQ(loaded.notes.size(), 1U);
}

TEST_F(SdfWorld, leaves_out_spares_that_are_parked_far_below_the_floor) {
  std::string body = ground_ + box("box", "1 1 1", "3 0 0.5");
  for (int i = 0; i < 3; ++i) body += box("helper_" + std::to_string(i), "1 1 1", "0 0 -100");
  const LoadedWorld loaded = load(body);
  EXPECT_EQ(loaded.world.things.size(), 2U);
  EXPECT_TRUE(has_note(loaded, {"'helper_0' is parked far below", "2 more of the same kind"}));
  const std::string cellar = box("floor_below", "9 9 1", "0 0 -101");
  EXPECT_NE(sentence_of(write_world(body + cellar)).find("3 of 6 things lie under the floor"),
            std::string::npos)
      << "they stand on a level of their own";
}

TEST_F(SdfWorld, names_the_far_thing_that_makes_a_plane_too_wide) {
  const std::string sentence = sentence_of(
      write_world("<include><uri>model://ground_plane</uri></include>" +
                  box("near", "1 1 1", "-490 0 0.5") + box("far", "1 1 1", "600 0 0.5")));
  EXPECT_NE(sentence.find("up to 1095 m apart, such as 'far'"), std::string::npos) << sentence;
}

TEST_F(SdfWorld, tells_hills_from_floors) {
  /// A sheet of 40 x 20 m, level up to x = `level` m and rising by 1 in 4 from there on.
  const auto hill = [&](double level) {
    std::ostringstream mesh;
    for (const double x : {0.0, level, 40.0})
      for (const double y : {0.0, 20.0})
        mesh << "v " << x << ' ' << y << ' ' << std::max(0.0, x - level) / 4.0 << '\n';
    mesh << "f 1 3 4\nf 1 4 2\nf 3 5 6\nf 3 6 4\n";
    write("hill.obj", mesh.str());
    return write_world(model("ground", "<mesh><uri>hill.obj</uri></mesh>"));
  };
  EXPECT_TRUE(load_world({hill(20.0)}).notes.empty());
  EXPECT_TRUE(has_note(load_world({hill(5.0)}), {"only 12.5 % of the floor", "'ground'"}));
  const std::string sentence = sentence_of(hill(0.5));
  EXPECT_NE(sentence.find("only 1.3 % of the floor"), std::string::npos) << sentence;
}

TEST_F(SdfWorld, finds_a_model_with_three_slashes_as_Gazebo_does) {
  write_model("crate", cube_);
  const std::string include = "<include><name>c</name><uri>model:///crate</uri></include>";
  EXPECT_NE(thing_named(load(ground_ + include).world, "c"), nullptr);
  EXPECT_NE(sentence_of(write_world(ground_ + "<include><uri>model:////</uri></include>")), "");
  EXPECT_NE(sentence_of(write_world(ground_ + "<include><uri>model:///../crate</uri></include>")),
            "");
}

TEST_F(SdfWorld, may_have_comments_before_its_declaration) {
  const std::string rest = "<sdf version='1.6'><world name='w'>" + ground_ + "</world></sdf>";
  const std::string declaration = "<?xml version='1.0'?>\n";
  for (const char* before : {"<!-- a -->", " <!-- a\n --> <!-- <?xml b?> -->\n", "\n"})
    EXPECT_EQ(load_world({write("a.world", before + declaration + rest)}).world.things.size(), 1U)
        << before;
  EXPECT_TRUE(has_note(load_world({write("two.world", declaration + rest + declaration + rest)}),
                       {"what follows the root element is left out"}));
  EXPECT_NE(sentence_of(write("open.world", "<!-- a " + declaration + rest)), "");
}

TEST_F(SdfWorld, sets_up_the_models_of_a_population) {
  const auto population = [&](const std::string& distribution, const std::string& region) {
    return "<population name='cans'><pose>1 2 0.5 0 0 0</pose><model "
           "name='can'><static>1</static>" +
           cube_ + "</model>" + region + "<model_count>5</model_count><distribution>" +
           distribution + "</distribution></population>";
  };
  const std::string box = "<box><size>8 6 0.01</size></box>";
  const LoadedWorld grid = load(ground_ + population("<type>grid</type><rows>2</rows><cols>3</cols>"
                                                     "<step>2 3 0</step>",
                                                     box));
  EXPECT_EQ(grid.world.things.size(), 7U);
  const auto middle = [](const LoadedWorld& loaded, const char* name) -> Eigen::Vector3d {
    return bounds(*thing_named(loaded.world, name)).center();
  };
  EXPECT_LT((middle(grid, "can_0") - Eigen::Vector3d(-1.0, 0.5, 0.5)).norm(), 1e-6);
  EXPECT_LT((middle(grid, "can_5") - Eigen::Vector3d(3.0, 3.5, 0.5)).norm(), 1e-6);
  const LoadedWorld row = load(ground_ + population("<type>linear-y</type>", box));
  EXPECT_LT((middle(row, "can_4") - Eigen::Vector3d(1.0, 5.0, 0.5)).norm(), 1e-6);
  const std::string round = "<cylinder><radius>3</radius><length>0.1</length></cylinder>";
  const LoadedWorld drawn = load(ground_ + population("<type>random</type>", round));
  for (const char* name : {"can_0", "can_1", "can_2", "can_3", "can_4"}) {
    EXPECT_LT((middle(drawn, name) - Eigen::Vector3d(1, 2, 0.5)).head<2>().norm(), 3.0);
    EXPECT_LT((middle(drawn, name) -
               middle(load(ground_ + population("<type>random</type>", round)), name))
                  .norm(),
              1e-12)
        << "the same at each start";
  }
  EXPECT_NE(sentence_of(write_world(ground_ + population("<type>odd</type>", box))).find("odd"),
            std::string::npos);
  EXPECT_NE(sentence_of(write_world(ground_ + population("<type>random</type>", ""))), "");
}

TEST_F(SdfWorld, leaves_out_what_everything_passes_through) {
  const std::string ghost =
      "<model name='ghost'><link name='l'><collision name='c'><geometry><box><size>1 1 1</size>"
      "</box></geometry><surface><contact><collide_bitmask>MASK</collide_bitmask></contact>"
      "</surface></collision></link></model>";
  const auto with = [&](const std::string& mask) {
    std::string body = ghost;
    return body.replace(body.find("MASK"), 4, mask);
  };
  const LoadedWorld loaded = load(ground_ + with("0x0"));
  EXPECT_EQ(thing_named(loaded.world, "ghost"), nullptr);
  EXPECT_TRUE(has_note(loaded, {"'ghost'", "touches nothing"}));
  EXPECT_NE(thing_named(load(ground_ + with("0x01")).world, "ghost"), nullptr);
}

TEST_F(SdfWorld, without_a_floor_is_refused_with_a_sentence) {
  EXPECT_NE(sentence_of(write_world("<model name='box'>" + cube_ + "</model>")), "");
  EXPECT_NE(sentence_of(write_world("")), "");
}

TEST_F(SdfWorld, says_how_to_get_the_mesh_of_which_only_the_pointer_is_there) {
  write("absent.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n");
  const std::string sentence =
      sentence_of(write_world(ground_ + model("a", "<mesh><uri>absent.stl</uri></mesh>")));
  EXPECT_NE(sentence.find("git lfs pull"), std::string::npos) << sentence;
}

TEST_F(SdfWorld, finds_models_where_gazebo_and_most_repositories_keep_them) {
  const auto world = [&](const std::string& uri) {
    return write("worlds/a.world", "<sdf version='1.6'><world name='w'>" + ground_ +
                                       "<model name='a'><include><uri>" + uri +
                                       "</uri></include></model></world></sdf>");
  };
  write_model("crate", cube_);  // in models/, beside worlds/
  EXPECT_EQ(sentence_of(world("model://crate")), "");
  EXPECT_EQ(sentence_of(world("file://models/crate")), "");
  write("elsewhere/barrel/model.sdf",
        "<sdf version='1.6'><model name='barrel'>" + cube_ + "</model></sdf>");
  EXPECT_NE(sentence_of(world("model://barrel")), "");
  EXPECT_EQ(sentence_of(world("model://barrel"), (folder_ / "elsewhere").string()), "");
  EXPECT_NE(sentence_of(world("model://crate"), "nowhere").find("'nowhere' is not a folder"),
            std::string::npos);
}

TEST_F(SdfWorld, has_names_that_a_terminal_can_show) {
  const LoadedWorld loaded = load_world(
      {write("n.world", "<sdf version='1.6'><world name='a&#10;b'>" + ground_ +
                            "<model name='red&#27;[31m'>" + cube_ + "</model></world></sdf>")});
  EXPECT_EQ(loaded.world.name, "a b");
  EXPECT_NE(thing_named(loaded.world, "red [31m"), nullptr);
}

TEST_F(SdfWorld, takes_no_size_from_what_only_lines_use) {
  std::string text = collada("", "<node><instance_geometry url='#g'/></node>");
  text = replaced(text, "count='9'>0 0 0", "count='15'>700 0 0 700 1 0 0 0 0");
  text = replaced(text, "count='3'", "count='5'");
  text = replaced(text, "0 1 2</p></triangles>",
                  "2 3 4</p></triangles><lines count='1'><input semantic='VERTEX' source='#v' "
                  "offset='0'/><p>0 1</p></lines>");
  write("edge.dae", text);
  const LoadedWorld loaded = load(ground_ + model("a", "<mesh><uri>edge.dae</uri></mesh>"));
  const Thing* thing = thing_named(loaded.world, "a");
  ASSERT_NE(thing, nullptr);
  EXPECT_NEAR(bounds(*thing).max().x(), 1.0, 1e-6);
}

TEST_F(SdfWorld, takes_a_mesh_in_its_unit_and_as_it_lies_in_its_file) {
  std::string text = collada("", "<node><instance_geometry url='#g'/></node>");
  text = replaced(text, "meter='1'", "name='centimeter' meter='0.01'");
  text = replaced(text, "0 0 0 1 0 0 0 1 0", "0 0 100 200 0 100 0 300 100");
  for (const char* up : {"Z_UP", "Y_UP"}) {
    write("tri.dae", replaced(text, "Z_UP", up));
    const LoadedWorld loaded =
        load(ground_ + model("box", "<mesh><uri>tri.dae</uri><scale>1 1 2</scale></mesh>"));
    const Eigen::AlignedBox3d box = bounds(*thing_named(loaded.world, "box"));
    EXPECT_LT((box.max() - Eigen::Vector3d(2.0, 3.0, 2.0)).norm(), 1e-6) << up;
    EXPECT_LT((box.min() - Eigen::Vector3d(0.0, 0.0, 2.0)).norm(), 1e-6) << up;
  }
}

TEST_F(SdfWorld, is_read_as_gazebo_11_reads_what_is_no_xml_and_says_so_with_its_line) {
  const std::string body = ground_ + "\n<model name=box><pose>0 0 0.5 0 0 0</pose>" + cube_ +
                           "</model><gui fullscreen=0/>";
  const std::string file =
      write("lenient.world", "<sdf version='1.6'><world name='w'>" + body + "</world></sdf>\"");
  const LoadedWorld loaded = load_world({file});
  EXPECT_NE(thing_named(loaded.world, "box"), nullptr);
  EXPECT_TRUE(has_note(loaded, {"line 2", "no quotes around box"}));
  EXPECT_TRUE(has_note(loaded, {"line 2", "what follows the root element is left out"}));
  const LoadedWorld plain =
      load_world({write("comment.world", "<sdf version='1.6'><world name='w'>" + ground_ +
                                             "</world></sdf>\n<!-- end -->\n")});
  EXPECT_FALSE(has_note(plain, {"follows the root"}));
}

TEST_F(SdfWorld, that_is_malformed_is_refused_with_the_fault_and_its_line) {
  const std::string head = "<sdf version='1.6'>\n<world name='w'>\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"<model name='a' name='b'/>", "attribute"},
      {"<model name='a'>", "not closed"},
      {"<!-- ", "comment"},
      {"<pose><![CDATA[0", "CDATA"},
      {"<% 3.times do %>", "run erb first"}};
  for (const auto& [body, words] : cases) {
    const std::string sentence = sentence_of(write("bad.world", head + body + "</world></sdf>"));
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("line "), std::string::npos) << sentence;
  }
  EXPECT_NE(sentence_of(write_world(ground_ + model("a", "<box><size>${x} 1 1</size></box>")))
                .find("run xacro first"),
            std::string::npos);
}

TEST_F(SdfWorld, without_its_building_does_not_stand_on_a_rack) {
  const auto rack = [](const std::string& name, const std::string& x) {
    return "<model name='" + name + "'><static>1</static><pose>" + x +
           " 0 0 0 0 0</pose><link name='l'><collision name='a'><pose>0 0 -0.05 0 0 0</pose>"
           "<geometry><box><size>4 3 0.1</size></box></geometry></collision><collision name='b'>"
           "<pose>0 1.45 1.5 0 0 0</pose><geometry><box><size>4 0.1 3</size></box></geometry>"
           "</collision></link></model>";
  };
  const std::string hall = "<include><uri>model://hall_that_is_missing</uri></include>";
  const std::string body = hall + rack("palletRack0", "0") + rack("palletRack1", "9");
  try {
    (void)load_leaving_out(body);
    ADD_FAILURE() << "the bottom of a rack is no floor";
  } catch (const WorldError& error) {
    const std::string sentence = error.what();
    for (const char* words :
         {"no floor carries more than half", "add <include>", "LEFT OUT", "hall_that_is_missing"})
      EXPECT_NE(sentence.find(words), std::string::npos) << words << " in: " << sentence;
  }
  try {
    (void)load_leaving_out(hall);
    ADD_FAILURE();
  } catch (const WorldError& error) {
    EXPECT_NE(std::string(error.what()).find("hall_that_is_missing"), std::string::npos);
  }
  EXPECT_TRUE(has_note(load_leaving_out(hall + ground_), {"NOTHING STANDS"}));
}

TEST_F(SdfWorld, on_several_slabs_of_one_height_has_its_floor_on_top_of_them) {
  std::string body =
      "<model name='ground_plane'><link name='l'><collision name='c'><geometry><plane>"
      "<normal>0 0 1</normal></plane></geometry></collision></link></model>";
  for (const std::string at : {"-11 0 0", "0 0 0", "11 0 0"})
    body += box("asphalt" + at, "10 20 0.1", at);
  body += box("barrier", "1 1 1", "17 11 0.5");
  EXPECT_NEAR(load(body).world.floor_height, 0.05, 1e-9);
}

TEST_F(SdfWorld, leaves_out_people_who_are_plates_within_a_slab) {
  std::string body = ground_ + box("slab", "18 18 0.05", "0 0 0.025");
  for (int i = 0; i < 6; ++i)
    body += box("person" + std::to_string(i), "0.35 0.75 0.02", std::to_string(i) + " 0 0.01");
  body += box("wall", "10 0.15 2.5", "0 8 1.3");
  const LoadedWorld loaded = load(body);
  EXPECT_NEAR(loaded.world.floor_height, 0.05, 1e-9);
  EXPECT_EQ(thing_named(loaded.world, "person3"), nullptr);
  EXPECT_TRUE(has_note(loaded, {"'person0'", "within a slab"}));
}

}  // namespace
}  // namespace navvi_sim::read
