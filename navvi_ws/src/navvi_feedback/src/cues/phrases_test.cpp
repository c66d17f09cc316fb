#include "cues/phrases.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>
#include <navvi_files/files.hpp>
#include <set>
#include <tuple>

#include "temp_folder.hpp"

namespace navvi_feedback::cues {
namespace {

namespace fs = std::filesystem;

const fs::path kPhrases = fs::path(NAVVI_FEEDBACK_CONFIG_DIR) / "phrases";
const fs::path kEnglish = kPhrases / "en.yaml";
const fs::path kSpanish = kPhrases / "es.yaml";

WordingConfig wording(const std::string& directions, const std::string& units = "meters",
                      const std::string& verbosity = "normal") {
  return {directions, units, verbosity};
}

/// Each way in which a language may be worded.
std::vector<WordingConfig> all_wordings() {
  std::vector<WordingConfig> all;
  for (const char* directions : {"clock", "left_right", "degrees"})
    for (const char* units : {"meters", "feet"})
      for (const char* verbosity : {"brief", "normal", "full"})
        all.push_back(wording(directions, units, verbosity));
  return all;
}

std::string english() { return navvi_files::read_file(kEnglish).value(); }

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = english();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// The sentence with which `text` is refused; empty if it is taken.
std::string refusal(const std::string& text) {
  const navvi_test::TempFolder folder;
  try {
    const Phrases phrases(folder.write("a.yaml", text));
    return "";
  } catch (const navvi_config::ConfigError& error) {
    return error.what();
  }
}

bool names(const std::string& sentence, const std::string& part) {
  return sentence.find(part) != std::string::npos;
}

Fillings everything() {
  Fillings fillings;
  fillings.hour = 3;
  fillings.distance = 8.2;
  fillings.thing = ThingClass::pallet_robot;
  fillings.side = Side::left;
  fillings.place = PlaceName::dock;
  fillings.number = 2;
  fillings.setting = SettingName::volume;
  fillings.person = "anna";
  return fillings;
}

TEST(Phrases, say_what_the_table_says) {
  const Fillings all = everything();
  Fillings ahead = all, left = all, keys = all, nameless = all;
  ahead.hour = 12;
  left.hour = 10;
  keys.keys = true;
  nameless.thing = ThingClass::other;
  struct Row {
    Phrases phrases;
    std::vector<std::tuple<Content, Fillings, const char*>> sayings;
  };
  for (const Row& row : std::vector<Row>{
           {Phrases(kEnglish),
            {{CueKind::direction, all, "turn to 3 o'clock, 8 meters"},
             {CueKind::straight, all, "drive straight, 8 meters"},
             {CueKind::turn_ahead, all, "in 8 meters, turn to 3 o'clock"},
             {CueKind::turn_now, all, "turn to 3 o'clock now"},
             {CueKind::start, all, "the goal is 8 meters along the path, at 3 o'clock"},
             {CueKind::near, all, "pallet robot on your left"},
             {CueKind::obstacle_stop, all, "stop, pallet robot on your left"},
             {CueKind::close, all, "pallet robot very close, on your left"},
             {CueKind::release_stick, {}, "release the stick"},
             {CueKind::collision, all, "hit a pallet robot on your left"},
             {CueKind::collision, nameless, "hit something on your left"},
             {CueKind::obstacle_comes, nameless, "something coming, on your left"},
             {CueKind::make_room, nameless, "move to 3 o'clock, 8 meters, to let something pass"},
             {CueKind::stuck, all, "stuck, pallet robot left, try 3 o'clock"},
             {CueKind::arrived, {}, "you have reached the goal"},
             {CueKind::robot_stopped, {}, "robot stopped, release the stick"},
             {CueKind::robot_stopped, keys, "robot stopped, release the keys"},
             {{CueKind::menu, About::setting_open},
              keys,
              "volume, 2 percent, page up for more, page down for less"},
             // A leg is straight ahead, but a place is at its hour.
             {CueKind::rerouted, all, "new route, 3 o'clock, 8 meters"},
             {CueKind::rerouted, ahead, "new route, straight ahead, 8 meters"},
             {CueKind::make_room,
              ahead,
              "move to 12 o'clock, 8 meters, to let a pallet robot pass"},
             {CueKind::goal_info, ahead, "the goal is 8 meters on, at 12 o'clock"}}},
           {Phrases(kEnglish, wording("left_right")),
            {{CueKind::direction, all, "turn right, 8 meters"},
             {CueKind::turn_now, all, "turn right now"},
             {CueKind::rerouted, ahead, "new route, straight ahead, 8 meters"}}},
           {Phrases(kEnglish, wording("degrees")),
            {{CueKind::direction, all, "turn 90 degrees right, 8 meters"},
             {CueKind::turn_now, all, "turn 90 degrees right now"},
             {CueKind::rerouted, left, "new route, 60 degrees left, 8 meters"},
             {CueKind::rerouted, ahead, "new route, straight ahead, 8 meters"}}},
           {Phrases(kEnglish, wording("clock", "meters", "brief")),
            {{CueKind::direction, all, "3 o'clock"},
             {CueKind::turn_ahead, all, "in 8 meters, 3 o'clock"}}},
           {Phrases(kEnglish, wording("clock", "meters", "full")),
            {{CueKind::blocked, all, "wait, pallet robot in the way"},
             {CueKind::release_stick, {}, "release the stick for a moment, then drive"}}},
           {Phrases(kSpanish),
            {{CueKind::direction, all, "gire hacia las 3, 8 metros"},
             {CueKind::release_stick, keys, "suelte las teclas"},
             {CueKind::collision, nameless, "choque, algo a su izquierda"}}}})
    for (const auto& [content, fillings, text] : row.sayings)
      EXPECT_EQ(row.phrases.say(content, fillings), text);
}

TEST(Phrases, are_shorter_or_longer_where_that_is_wanted) {
  for (const fs::path& language : {kEnglish, kSpanish}) {
    const auto bytes = [&](const char* verbosity) {
      const Phrases phrases(language, wording("clock", "meters", verbosity));
      std::size_t sum = 0;
      for (const Content& content : navvi_types::contents())
        sum += phrases.say(content, everything()).size();
      return sum;
    };
    EXPECT_LT(bytes("brief"), bytes("normal"));
    EXPECT_GT(bytes("full"), bytes("normal"));
  }
}

TEST(Phrases, speak_spanish_with_its_letters_its_plurals_and_its_first_hour) {
  const Phrases phrases(kSpanish);
  EXPECT_EQ(phrases.voice(), "es");
  Fillings one = everything();
  one.hour = 1;
  one.distance = 1.0;
  EXPECT_EQ(phrases.say(CueKind::direction, one), "gire hacia la una, 1 metro");
  one.thing = ThingClass::shelf;
  EXPECT_EQ(phrases.say({CueKind::near, About::shelf}, one), "estanter\u00eda a su izquierda");
}

TEST(Phrases, of_the_end_of_a_wait_and_of_straight_ahead_begin_with_other_words) {
  for (const fs::path& language : {kEnglish, kSpanish})
    for (const WordingConfig& worded : all_wordings()) {
      const Phrases phrases(language, worded);
      const auto first = [&](CueKind kind) {
        const std::string text = phrases.say(kind, everything());
        return text.substr(0, text.find_first_of(" ,"));
      };
      const std::set<std::string> words = {first(CueKind::go_on), first(CueKind::straight),
                                           first(CueKind::obstacle_stop), first(CueKind::blocked)};
      EXPECT_EQ(words.size(), 4U) << language;
    }
}

TEST(Phrases, of_the_way_must_leave_room_for_the_end_of_a_wait) {
  const std::string sentence = refusal(
      replaced("slight: \"keep a little {side}, {distance}\"",
               "slight: \"a little bit farther there to the {side} hand, {distance}, {way}\""));
  EXPECT_TRUE(names(sentence, "phrases/slight")) << sentence;
}

TEST(Phrases, teach_the_word_to_stop_that_is_said) {
  for (const fs::path& language : {kEnglish, kSpanish}) {
    const Phrases phrases(language);
    const std::string stop = phrases.say(CueKind::obstacle_stop, everything());
    EXPECT_EQ(phrases.lessons().at("tutorial_stop"), stop.substr(0, stop.find(',')));
  }
}

TEST(Phrases, call_a_way_of_leading_as_the_lesson_does_that_teaches_it) {
  for (const fs::path& language : {kEnglish, kSpanish}) {
    const Phrases phrases(language);
    const auto called = [&](SettingValue value) {
      Fillings fillings;
      fillings.setting = SettingName::lead;
      fillings.value = value;
      const std::string text = phrases.say({CueKind::menu, About::setting}, fillings);
      return text.substr(text.find(", ") + 2);
    };
    EXPECT_TRUE(names(phrases.lessons().at("glossary_sound_turn"), called(SettingValue::ticks)));
    EXPECT_TRUE(names(phrases.lessons().at("glossary_sound_flow"), called(SettingValue::flow)));
  }
}

TEST(Phrases, refuse_letters_that_no_voice_reads_and_broken_utf8) {
  for (const char* text : {"caf\u00e9 ol\u00e9", "\u03bb\u03cc\u03b3\u03bf\u03c2",
                           "\u0441\u0442\u043e\u043f", "\u00dcber"})
    EXPECT_TRUE(speakable(text)) << text;
  for (const char* text : {"3 \u00d7 4", "\u20ac 5", "a\u0301", "\u202eabc", "\U0001F600 x",
                           "a\xc3", "\xe9t\xe9", "\xc1\xa1", "a\xc3 b"})
    EXPECT_FALSE(speakable(text)) << text;
}

TEST(Phrases, round_distances_as_people_say_them) {
  using Table = std::vector<std::pair<double, const char*>>;
  const Table metric = {{0.0, "0.5 meters"}, {0.6, "0.5 meters"},  {0.8, "1 meter"},
                        {1.2, "1 meter"},    {1.3, "1.5 meters"},  {1.74, "1.5 meters"},
                        {1.76, "2 meters"},  {2.4, "2 meters"},    {2.6, "3 meters"},
                        {49.6, "50 meters"}, {1e9, "9999 meters"}};
  const Table feet = {{0.0, "1 foot"},  {0.4, "1 foot"},  {0.5, "2 feet"},
                      {5.9, "19 feet"}, {8.2, "25 feet"}, {1e9, "9999 feet"}};
  for (const auto& [units, table] : {std::pair("meters", metric), std::pair("feet", feet)}) {
    const Phrases phrases(kEnglish, wording("clock", units));
    for (const auto& [metres, text] : table) EXPECT_EQ(phrases.distance(metres), text) << metres;
    EXPECT_THROW((void)phrases.distance(std::nan("")), std::logic_error);
    EXPECT_THROW((void)phrases.distance(-1.0), std::logic_error);
  }
}

TEST(Phrases, name_places_with_their_number) {
  const Phrases phrases(kEnglish);
  EXPECT_EQ(phrases.say({CueKind::menu, About::menu_place}, everything()), "dock 2");
  Fillings task;
  task.place = PlaceName::task;
  EXPECT_EQ(phrases.say({CueKind::menu_closed, About::goal_chosen}, task),
            "you are heading for the goal of the task");
  EXPECT_THROW(static_cast<void>(phrases.say({CueKind::menu, About::menu_place})),
               std::logic_error);
}

TEST(Phrases, call_a_place_by_a_name_of_its_own_and_by_no_other_text) {
  for (const fs::path& language : {kEnglish, kSpanish})
    for (const WordingConfig& worded : all_wordings())
      for (const char* name : {"gate 4", "a234567890123456789a b23456789012345678b",
                               "a23456789012345678a b234567890123456789b"})
        for (const Content& content :
             {Content(CueKind::menu, About::menu_place), Content(CueKind::menu, About::goal_sure),
              Content(CueKind::menu_closed, About::goal_chosen)}) {
          Fillings fillings;
          fillings.place_name = name;
          const std::string said = Phrases(language, worded).say(content, fillings);
          EXPECT_TRUE(names(said, name) && speakable(said)) << said;
        }
  Fillings fillings = everything();
  fillings.place_name = "<audio src='x'/>";
  EXPECT_THROW((void)Phrases(kEnglish).say({CueKind::menu, About::menu_place}, fillings),
               std::logic_error);
}

TEST(Phrases, let_a_place_be_called_by_letters_digits_and_single_blanks) {
  for (const char* name : {"7", "packing table", "B 12", "\u00c1rea de env\u00edo",
                           "a234567890123456789a b23456789012345678b"})
    EXPECT_TRUE(is_place_name(name)) << name;
  for (const char* name :
       {"", " ", " gate", "gate ", "two  gates", "gate, left", "pick-up", "[[x]]", "<b>", "a\nb",
        "a234567890123456789a1", "a\xc3", "a234567890123456789a b234567890123456789b"})
    EXPECT_FALSE(is_place_name(name)) << name;
}

TEST(Phrases, refuse_to_speak_without_what_the_phrase_needs) {
  const Phrases phrases(kEnglish);
  EXPECT_THROW((void)phrases.say(CueKind::direction), std::logic_error);
  EXPECT_THROW((void)phrases.say(CueKind::lesson), std::logic_error);
  Fillings thirteen = everything();
  thirteen.hour = 13;
  EXPECT_THROW((void)phrases.say(CueKind::direction, thirteen), std::logic_error);
}

TEST(Phrases, refuse_a_file_that_is_missing_or_no_map) {
  EXPECT_THROW(Phrases(fs::path("/nowhere/en.yaml")), navvi_config::ConfigError);
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("- a\n- b\n"), "");
  EXPECT_NE(refusal("phrases: [1, 2]\n"), "");
  EXPECT_NE(refusal("phrases: {\n"), "");
  EXPECT_LT(refusal(std::string(900, 'x') + ": {}\n").size(), 300U) << "cites no long key";
}

TEST(Phrases, stand_under_a_kind_for_all_that_it_may_be_about_but_what_has_one_of_its_own) {
  const std::string near = "  near: \"{thing} {where}\"\n";
  const navvi_test::TempFolder folder;
  const Phrases phrases(
      folder.write("a.yaml", replaced(near, near + "  wall_near: \"mind the wall\"\n")));
  EXPECT_EQ(phrases.say({CueKind::near, About::wall}, everything()), "mind the wall");
  EXPECT_EQ(phrases.say({CueKind::near, About::shelf}, everything()), "pallet robot on your left");
  EXPECT_TRUE(names(refusal(replaced(near, "  wall_near: \"mind the wall\"\n")), "shelf_near"));
}

TEST(Phrases, refuse_a_file_with_a_missing_or_unknown_key_or_placeholder_and_name_it) {
  struct Row {
    const char *from, *to;
    std::vector<std::string> named;
  };
  for (const Row& row : std::vector<Row>{
           {"  arrived:", "  # arrived:", {"arrived", "missing"}},
           {"  start_distance:", "  # start_distance:", {"missing"}},  // it needs no direction
           {"  forklift: forklift\n", "", {"words/forklift"}},
           {"  clock_7: 7 o'clock\n", "", {"words/clock_7"}},
           {"  feet: feet\n", "", {"words/feet"}},
           {"voice: en\n", "", {"voice"}},
           {"voice: en\n", "voice: en\nmore: {}\n", {"more"}},
           {"  no_goal:", "  typo: \"x\"\n  no_goal:", {"phrases/typo", "line "}},
           {"  no_goal:", "  arrived: \"again\"\n  no_goal:", {"arrived"}},
           {"{direction}, {distance}", "{name} there", {"{name}", "line "}},
           {"hit {a_thing} {where}", "hit {a_thing {where}", {"collision"}},
           {"hit {a_thing} {where}", "hit {a_thing", {"collision"}}}) {
    const std::string sentence = refusal(replaced(row.from, row.to));
    for (const std::string& part : row.named)
      EXPECT_TRUE(names(sentence, part)) << row.to << ": " << sentence;
  }
  const std::string whole = english();
  const std::string sentence = refusal(whole.substr(0, whole.find("\nlessons:") + 1));
  EXPECT_TRUE(names(sentence, "\"lessons\" is missing")) << sentence;
}

TEST(Phrases, refuse_text_that_could_harm_the_voice) {
  std::string hostile;
  for (int i = 0; i < 68; ++i) hostile += "s'";
  const std::vector<std::string> texts = {
      hostile,
      "<voice name='x'>",
      "[[h@loU]]",
      "5 \xe2\x82\xac",
      "\xff\xfe",
      "line\\nbreak",
      "nul\\0",
      "",
      "   ",
      std::string(25, 'a'),
      "one two three four five six seven eight nine ten eleven twelve thirteen fourteen x"};
  for (const std::string& text : texts)
    EXPECT_NE(refusal(replaced("\"you have reached the goal\"", "\"" + text + "\"")), "") << text;
  EXPECT_NE(refusal(replaced("forklift: forklift", "forklift: " + std::string(24, 'f') + "t")), "");
}

TEST(Phrases, refuse_a_phrase_that_is_too_long_only_when_filled) {
  const std::string sentence = refusal(
      replaced("\"hit {a_thing} {where}\"",
               "\"hit a {thing} {where} and that is quite a long sentence for so small a thing\""));
  EXPECT_TRUE(names(sentence, "filled")) << sentence;
}

TEST(Phrases, F3_cannot_be_made_to_speak_anything_else) {
  // Whatever is put in comes from fixed sets; every combination stays within the limits.
  for (const fs::path& language : {kEnglish, kSpanish})
    for (const WordingConfig& worded : all_wordings()) {
      const Phrases phrases(language, worded);
      for (const Content& content : navvi_types::contents())
        for (int hour = 1; hour <= 12; ++hour)
          for (int thing = static_cast<int>(ThingClass::shelf);
               thing <= static_cast<int>(ThingClass::other); ++thing)
            for (int side = 0; side < 4; ++side)
              for (const double metres : {0.0, 1.5, 1e300}) {
                const Fillings fillings{hour,
                                        metres,
                                        static_cast<ThingClass>(thing),
                                        static_cast<Side>(side),
                                        PlaceName::cross_aisle,
                                        1000,
                                        static_cast<SettingName>(hour),
                                        std::nullopt,
                                        "a23456789_123456789-1234"};
                ASSERT_TRUE(speakable(phrases.say(content, fillings))) << to_string(content);
              }
    }
}

}  // namespace
}  // namespace navvi_feedback::cues
