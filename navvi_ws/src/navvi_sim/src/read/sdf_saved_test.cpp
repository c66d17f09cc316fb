// Worlds as Gazebo saved them, with a <state>.

#include <gtest/gtest.h>

#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

class SavedWorld : public SdfFolder {
 protected:
  static std::string state(const std::string& of_models) {
    return "<state world_name='w'><sim_time>1 0</sim_time>" + of_models + "</state>";
  }
  static void expect_box(const LoadedWorld& loaded, const std::string& name,
                         const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const Thing* thing = thing_named(loaded.world, name);
    ASSERT_NE(thing, nullptr) << name;
    EXPECT_LT((bounds(*thing).min() - low).norm(), 1e-6) << bounds(*thing).min().transpose();
    EXPECT_LT((bounds(*thing).max() - high).norm(), 1e-6) << bounds(*thing).max().transpose();
  }
};

TEST_F(SavedWorld, has_its_models_where_and_as_large_as_the_state_says) {
  const LoadedWorld loaded =
      load(ground_ + box("wall_1", "2 0.2 2", "0 5 1") + box("wall_2", "2 0.2 2", "0 -5 1") +
           state("<model name='wall_1'><pose>0 3 1 0 0 0</pose><scale>4 1 1</scale></model>"
                 "<model name='wall_2'><pose>0 -5 1 0 0 0</pose><scale>1 1 1</scale></model>"
                 "<model name='none'><pose>0 0 0 0 0 0</pose></model><insertions/>"));
  expect_box(loaded, "wall_1", {-4, 2.9, 0}, {4, 3.1, 2});
  expect_box(loaded, "wall_2", {-1, -5.1, 0}, {1, -4.9, 2});
  EXPECT_TRUE(has_note(loaded, {"moves 1 models and links, and scales 1 models"}));
  EXPECT_TRUE(has_note(loaded, {"the saved state has the model 'none', which the world lacks"}));
  EXPECT_TRUE(has_note(loaded, {"the saved state has <insertions>, which the world lacks"}));
}

TEST_F(SavedWorld, has_links_and_nested_models_where_the_state_says_in_map) {
  const std::string box =
      "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry>"
      "</collision>";
  const LoadedWorld loaded =
      load(ground_ + "<model name='train'><pose>1 1 0.5 0 0 0</pose><link name='a'>" + box +
           "</link><link name='A::b'><pose>2 0 0 0 0 0</pose>" + box +
           "</link><model name='cab'>"
           "<link name='roof'><pose>0 0 1 0 0 0</pose>" +
           box + "</link></model></model>" +
           state("<model name='train'><pose>1 2 0.5 0 0 1.5707963267948966</pose><link name='A::b'>"
                 "<pose frame=''>6 0 0.5 0 0 0</pose></link><model name='cab'>"
                 "<pose>-5 0 0.5 0 0 0</pose></model></model>"));
  const Thing* train = thing_named(loaded.world, "train");
  ASSERT_EQ(train->shapes.size(), 3U);
  const auto place = [&](std::size_t shape) -> Eigen::Vector3d {
    return (train->pose * train->shapes[shape].pose).translation();
  };
  EXPECT_LT((place(0) - Eigen::Vector3d(1, 2, 0.5)).norm(), 1e-6);
  EXPECT_LT((place(1) - Eigen::Vector3d(6, 0, 0.5)).norm(), 1e-6);
  EXPECT_LT((place(2) - Eigen::Vector3d(-5, 0, 1.5)).norm(), 1e-6) << "with its model";
  EXPECT_TRUE(has_note(loaded, {"moves 3 models and links"}));
}

TEST_F(SavedWorld, scales_each_shape_as_gazebo_does) {
  write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  const std::string scale = "<scale>2 3 4</scale></model>";
  const LoadedWorld loaded = load(
      ground_ +
      model("post", "<cylinder><radius>0.1</radius><length>1</length></cylinder>", "0 0 2 0 0 0") +
      model("ball", "<sphere><radius>0.5</radius></sphere>", "4 0 2 0 0 0") +
      model("cone", "<mesh><uri>tri.obj</uri><scale>9 9 9</scale></mesh>", "-5 0 1 0 0 0") +
      state("<model name='post'><pose>0 0 2 0 0 0</pose>" + scale +
            "<model name='ball'><pose>4 0 2 0 0 0</pose>" + scale +
            "<model name='cone'><pose>-5 0 1 0 0 0</pose>" + scale));
  expect_box(loaded, "post", {-0.3, -0.3, 0}, {0.3, 0.3, 4});
  expect_box(loaded, "ball", {2, -2, 0}, {6, 2, 4});
  expect_box(loaded, "cone", {-5, 0, 1}, {-3, 3, 5});
}

TEST_F(SavedWorld, whose_state_is_out_of_range_is_refused_or_read_without_that_model) {
  for (const char* wrong : {"<pose>0 0 343582 0 0 0</pose>",
                            "<pose>0 0 1 0 0 0</pose><scale>1 0 1"
                            "</scale>"}) {
    const std::string body = ground_ + box("book", "1 1 1") + box("desk", "1 1 1", "3 0 0.5") +
                             state("\n<model name='book'>" + std::string(wrong) + "</model>");
    EXPECT_NE(sentence_of(write_world(body)).find("line 2"), std::string::npos) << wrong;
    const LoadedWorld loaded = load_leaving_out(body);
    EXPECT_EQ(thing_named(loaded.world, "book"), nullptr);
    EXPECT_NE(thing_named(loaded.world, "desk"), nullptr);
  }
}

}  // namespace
}  // namespace navvi_sim::read
