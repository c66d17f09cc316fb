#include "read/class_rules.hpp"

#include <gtest/gtest.h>

#include "temp_folder.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

TEST(StandardClassRules, tell_the_class_by_the_name_that_others_gave) {
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
      {"my_pallet_robot_2", ThingClass::pallet_robot},
      {"", ThingClass::other},
  };
  for (const auto& [name, thing_class] : cases)
    EXPECT_EQ(ClassRules::standard().match(name).value_or(ThingClass::other), thing_class) << name;
}

class ClassRulesFile : public testing::Test {
 protected:
  fs::path write(const std::string& text) const {
    return folder_.write("rules.yaml", text);
  }
  std::string sentence_of(const std::string& text) const {
    try {
      static_cast<void>(ClassRules::read(write(text)));
    } catch (const WorldError& error) {
      return error.what();
    }
    return "";
  }

  navvi_test::TempFolder folder_;
};

TEST_F(ClassRulesFile, that_ships_is_the_standard_one) {
  const ClassRules shipped = ClassRules::read(fs::path(NAVVI_SIM_DIR) / "config/classes.yaml");
  for (const char* name : {"rack_3", "Track_1", "pallet", "palletjack", "wall", "x"})
    EXPECT_EQ(shipped.match(name), ClassRules::standard().match(name));
}

TEST_F(ClassRulesFile, is_read_in_order_with_its_wild_cards) {
  const ClassRules rules = ClassRules::read(write(
      "- {class: wall, names: ['Bay_1?', exact]}\n- {class: shelf, names: ['bay*', 'a*b*c']}"));
  EXPECT_EQ(rules.match("BAY_12"), ThingClass::wall);
  EXPECT_EQ(rules.match("bay_123"), ThingClass::shelf);
  EXPECT_EQ(rules.match("exact"), ThingClass::wall);
  EXPECT_EQ(rules.match("not exact"), std::nullopt);
  EXPECT_EQ(rules.match("aXbYbZc"), ThingClass::shelf);
  EXPECT_EQ(rules.match("abd"), std::nullopt);
  EXPECT_EQ(rules.match("a wall"), std::nullopt) << "the standard rules are gone";
}

TEST_F(ClassRulesFile, of_a_hostile_pattern_is_matched_all_the_same) {
  std::string stars;
  for (int i = 0; i < 90; ++i) stars += "*a";
  const ClassRules rules = ClassRules::read(write("- {class: wall, names: ['" + stars + "']}"));
  EXPECT_EQ(rules.match(std::string(5000, 'a') + "b"), std::nullopt);
}

TEST_F(ClassRulesFile, is_refused_with_line_and_what_is_allowed) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "line 1"},
      {"{class: wall, names: [a]}", "line 1"},
      {"[]", "list"},
      {"- wall", "line 1"},
      {"- {class: wall}", "class and names"},
      {"- {class: wall, names: [a], also: 1}", "class and names"},
      {"- {class: wall, names: [a]}\n- {class: robot, names: [a]}", "line 2"},
      {"- {class: robot, names: [a]}", "pallet_robot"},
      {"- {class: [wall], names: [a]}", "not a class"},
      {"- {class: wall, names: a}", "names is not a list"},
      {"- {class: wall, names: []}", "names is not a list"},
      {"- {class: wall, names: ['']}", "pattern"},
      {"- {class: wall, names: [[a]]}", "pattern"},
      {"- {class: wall, names: [" + std::string(300, 'a') + "]}", "characters"},
      {"- {class: wall\n", "line"},
  };
  for (const auto& [text, words] : cases) {
    const std::string sentence = sentence_of(text);
    EXPECT_NE(sentence.find("rules.yaml"), std::string::npos) << text << ": " << sentence;
    EXPECT_NE(sentence.find(words), std::string::npos) << text << ": " << sentence;
  }
  EXPECT_THROW(static_cast<void>(ClassRules::read(folder_)), WorldError);
  EXPECT_THROW(static_cast<void>(ClassRules::read(folder_ / "none.yaml")), WorldError);
}

}  // namespace
}  // namespace navvi_sim::read
