#include <gtest/gtest.h>

#include "navvi_sim/model_class.hpp"
#include "navvi_sim/world_description.hpp"

namespace navvi_sim {
namespace {

TEST(ThingClassNames, come_back_as_the_class_they_name) {
  for (int i = 0; i <= static_cast<int>(ThingClass::other); ++i) {
    const auto thing_class = static_cast<ThingClass>(i);
    EXPECT_EQ(thing_class_from(to_string(thing_class)), thing_class);
  }
}

TEST(ThingClassNames, are_the_only_words_taken) {
  for (const char* word : {"", "Shelf", "shelf ", "robot", "pallet robot"})
    EXPECT_FALSE(thing_class_from(word).has_value()) << word;
}

TEST(ModelClass, is_told_by_the_name_that_others_gave) {
  const std::vector<std::pair<const char*, ThingClass>> cases{
      {"aws_robomaker_warehouse_ShelfD_01_002", ThingClass::shelf},
      {"aws_robomaker_warehouse_WallB_01", ThingClass::wall},
      {"aws_robomaker_warehouse_GroundB_01", ThingClass::floor},
      {"aws_robomaker_warehouse_ClutteringA_01", ThingClass::box},
      {"aws_robomaker_warehouse_PalletJackB_01", ThingClass::other},
      {"aws_robomaker_warehouse_Lamp_01", ThingClass::other},
      {"ground_plane", ThingClass::floor},
      {"Euro pallet", ThingClass::pedestal},
      {"CardboardBox_3", ThingClass::box},
      {"person_standing", ThingClass::worker},
      {"FORKLIFT", ThingClass::forklift},
      {"", ThingClass::other},
  };
  for (const auto& [name, thing_class] : cases)
    EXPECT_EQ(class_of_model(name), thing_class) << name;
}

}  // namespace
}  // namespace navvi_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
