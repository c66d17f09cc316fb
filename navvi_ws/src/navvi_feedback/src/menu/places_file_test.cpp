#include "navvi_feedback/menu/places_file.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

#include "temp_folder.hpp"

namespace navvi_feedback::menu {
namespace {

namespace fs = std::filesystem;

class PlacesFileTest : public testing::Test {
 protected:
  [[nodiscard]] fs::path file() const { return folder_ / "places.yaml"; }
  [[nodiscard]] std::vector<NamedPlace> read(const std::string& text) const {
    return read_places(folder_.write("places.yaml", text));
  }
  /// The sentence without the file, which every one names first.
  [[nodiscard]] std::string rejected(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const navvi_config::ConfigError& error) {
      const std::string sentence = error.what(), name = file().string() + ", ";
      EXPECT_EQ(sentence.rfind(name, 0), 0U) << sentence;
      return sentence.substr(std::min(name.size(), sentence.size()));
    }
    return "";
  }

  navvi_test::TempFolder folder_;
};

TEST_F(PlacesFileTest, holds_places_in_their_order) {
  const auto places = read(
      "- {name: packing table, x: 3.2, y: -1.5}\n"
      "- name: 7\n  x: 0\n  y: 1e2\n");
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].name, "packing table");
  EXPECT_EQ(places[0].at, Eigen::Vector2d(3.2, -1.5));
  EXPECT_EQ(places[1].name, "7");
  EXPECT_EQ(places[1].at, Eigen::Vector2d(0.0, 100.0));
  for (const char* none : {"[]", "", "# none yet\n"}) EXPECT_TRUE(read(none).empty()) << none;
}

TEST_F(PlacesFileTest, names_line_key_and_what_is_allowed_where_it_is_wrong) {
  const std::string good = "- {name: gate, x: 1, y: 2}\n";
  const std::string metres = "; allowed is -100000 to 100000 m.";
  for (const auto& [text, sentence] : std::vector<std::pair<std::string, std::string>>{
           {good + "- {name: a, x: .nan, y: 2}", "line 2: \"x\" is .nan" + metres},
           {good + "- {name: a, x: 1, y: -.inf}", "line 2: \"y\" is -.inf" + metres},
           {good + "- {name: a, x: 1, y: 100001}", "line 2: \"y\" is 100001" + metres},
           {good + "- {name: a, x: [1], y: 2}",
            "line 2: \"x\" is a list or map; allowed is a number."},
           {"- {name: a, x: 1,\n   y: two}", "line 2: \"y\" is two; allowed is a number."},
           {"- {name: [a], x: 1, y: 2}",
            "line 1: \"name\" is a list or map; allowed is a text."},
           {"- {name: a, x: 1, y: 2, yaw: 3}",
            "line 1: the key \"yaw\" is unknown; known here are do, name, x, y."},
           {"- {name: a, x: 1, x: 2, y: 3}", "line 1: the key \"x\" is given twice."},
           {good + "- {name: a, x: 1}", "line 2: a place lacks \"y\"; it must have name, x and y."},
           {good + "- gate", "line 2: there must be a map of keys and values."},
           {good + "- {name: b, x: 0, y: 0}\n- {name: GATE, x: 3, y: 4}",
            "line 3: \"name\" is \"GATE\", as in line 1; allowed are names that differ in more "
            "than "
            "capital letters."}})
    EXPECT_EQ(rejected(text), sentence) << text;
}

TEST_F(PlacesFileTest, holds_no_name_that_could_be_more_than_words) {
  for (const char* name :
       {"''", "\"<break/>\"", "\"[[x]]\"", "\"a\\nb\"", "\" a\"", "a234567890123456789a1"})
    EXPECT_EQ(rejected("- {name: " + std::string(name) + ", x: 1, y: 2}")
                  .rfind("line 1: \"name\" cannot be spoken; allowed are letters", 0),
              0U)
        << name;
}

TEST_F(PlacesFileTest, is_a_list_of_at_most_100_places) {
  std::string text;
  for (int i = 1; i <= 100; ++i) text += "- {name: place " + std::to_string(i) + ", x: 0, y: 0}\n";
  EXPECT_EQ(read(text).size(), 100U);
  EXPECT_EQ(rejected(text + "- {name: a, x: 0, y: 0}"),
            "line 1: there are 101 places; allowed are 100.");
  for (const char* other : {"name: a", "gate"})
    EXPECT_NE(rejected(other).find("the file must be a list of places"), std::string::npos);
  EXPECT_THROW((void)read_places(folder_ / "none.yaml"), navvi_config::ConfigError);
}

TEST_F(PlacesFileTest, goes_on_with_more_places_and_keeps_what_was_there) {
  const std::string mine = "# our hall\n- name: gate  # in the north\n  x: 1\n  y: 2";
  const std::string more = "- {name: place 1, x: 3.14, y: -0.50}\n";
  for (const auto& [before, after] : std::vector<std::pair<std::string, std::string>>{
           {mine, mine + "\n" + more},
           {"", more},
           {"[]\n", more},
           {"[{name: gate, x: 1, y: 2}]", "- {name: gate, x: 1.00, y: 2.00}\n" + more},
           {"  - {name: gate, x: 1, y: 2}\n", "- {name: gate, x: 1.00, y: 2.00}\n" + more}}) {
    (void)read(before);
    add_places(file(), {{"place 1", {3.1415, -0.5}}});
    EXPECT_EQ(folder_.text("places.yaml"), after);
    EXPECT_EQ(read_places(file()).back().name, "place 1");
  }
}

TEST_F(PlacesFileTest, holds_the_old_places_where_more_cannot_be_added) {
  const std::string mine = "- {name: Place 1, x: 1, y: 2}\n";
  (void)read(mine);
  EXPECT_THROW(add_places(file(), {{"place 1", {3.0, 0.0}}}), std::runtime_error) << "named twice";
  EXPECT_EQ(read_places(file()).size(), 1U);
  EXPECT_THROW(add_places(folder_ / "none.yaml", {{"place 1", {3.0, 0.0}}}), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder_ / "none.yaml"));
}

}  // namespace
}  // namespace navvi_feedback::menu
