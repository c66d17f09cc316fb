#include "cues/phrases.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <navvi_config/reader.hpp>
#include <set>
#include <sstream>

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

std::string english() {
  std::ifstream file(kEnglish);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A phrase file that is gone with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "navvi_phrases_XXXXXX").string();
    const int handle = mkstemp(name.data());
    EXPECT_GE(handle, 0);
    path_ = name;
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { fs::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = english();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// The sentence with which `text` is refused; empty if it is taken.
std::string refusal(const std::string& text) {
  const TemporaryFile file(text);
  try {
    const Phrases phrases(file.path());
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

TEST(Phrases, of_every_kind_can_be_spoken_in_each_language_and_wording) {
  for (const fs::path& language : {kEnglish, kSpanish})
    for (const WordingConfig& worded : all_wordings()) {
      const Phrases phrases(language, worded);
      for (const Content& content : navvi_types::contents())
        EXPECT_TRUE(speakable(phrases.say(content, everything()))) << to_string(content);
    }
}

TEST(Phrases, say_what_people_and_simulated_operators_listen_for) {
  const Phrases phrases(kEnglish);
  EXPECT_EQ(phrases.say(CueKind::direction, everything()), "turn to 3 o'clock, 8 meters");
  EXPECT_EQ(phrases.say(CueKind::straight, everything()), "drive straight, 8 meters");
  EXPECT_EQ(phrases.say(CueKind::turn_ahead, everything()), "in 8 meters, turn to 3 o'clock");
  EXPECT_EQ(phrases.say(CueKind::turn_now, everything()), "turn to 3 o'clock now");
  EXPECT_EQ(phrases.say(CueKind::start, everything()),
            "the goal is 8 meters along the path, at 3 o'clock");
  EXPECT_EQ(phrases.say(CueKind::near, everything()), "pallet robot on your left");
  EXPECT_EQ(phrases.say(CueKind::obstacle_stop, everything()), "stop, pallet robot on your left");
  EXPECT_EQ(phrases.say(CueKind::close, everything()), "pallet robot very close, on your left");
  EXPECT_EQ(phrases.say(CueKind::release_stick), "release the stick");
  EXPECT_EQ(phrases.say(CueKind::collision, everything()), "hit a pallet robot on your left");
  EXPECT_EQ(phrases.say(CueKind::stuck, everything()), "stuck, pallet robot left, try 3 o'clock");
  EXPECT_EQ(phrases.say(CueKind::arrived), "you have reached the goal");
}

TEST(Phrases, call_a_leg_straight_ahead_in_every_wording_but_a_place_by_its_hour) {
  Fillings ahead = everything();
  ahead.hour = 12;
  for (const char* directions : {"clock", "left_right", "degrees"})
    EXPECT_EQ(Phrases(kEnglish, wording(directions)).say(CueKind::rerouted, ahead),
              "new route, straight ahead, 8 meters");
  const Phrases phrases(kEnglish);
  EXPECT_EQ(phrases.say(CueKind::make_room, ahead),
            "move to 12 o'clock, 8 meters, to let a pallet robot pass");
  EXPECT_EQ(phrases.say(CueKind::goal_info, ahead), "the goal is 8 meters on, at 12 o'clock");
  EXPECT_EQ(phrases.say(CueKind::rerouted, everything()), "new route, 3 o'clock, 8 meters");
}

TEST(Phrases, offer_left_and_right_instead_of_the_clock) {
  const Phrases phrases(kEnglish, wording("left_right"));
  EXPECT_EQ(phrases.say(CueKind::direction, everything()), "turn right, 8 meters");
  EXPECT_EQ(phrases.say(CueKind::turn_now, everything()), "turn right now");
}

TEST(Phrases, count_degrees_to_either_side) {
  const Phrases phrases(kEnglish, wording("degrees"));
  EXPECT_EQ(phrases.say(CueKind::direction, everything()), "turn 90 degrees right, 8 meters");
  EXPECT_EQ(phrases.say(CueKind::turn_now, everything()), "turn 90 degrees right now");
  Fillings left = everything();
  left.hour = 10;
  EXPECT_EQ(phrases.say(CueKind::rerouted, left), "new route, 60 degrees left, 8 meters");
}

TEST(Phrases, are_shorter_or_longer_where_that_is_wanted) {
  const Phrases brief(kEnglish, wording("clock", "meters", "brief"));
  EXPECT_EQ(brief.say(CueKind::direction, everything()), "3 o'clock");
  EXPECT_EQ(brief.say(CueKind::turn_ahead, everything()), "in 8 meters, 3 o'clock");
  const Phrases full(kEnglish, wording("clock", "meters", "full"));
  EXPECT_EQ(full.say(CueKind::blocked, everything()),
            "wait, pallet robot in the way, I will say when to go on");
  const auto bytes = [](const Phrases& phrases) {
    std::size_t sum = 0;
    for (const Content& content : navvi_types::contents())
      sum += phrases.say(content, everything()).size();
    return sum;
  };
  for (const fs::path& language : {kEnglish, kSpanish}) {
    const Phrases normal(language);
    EXPECT_LT(bytes(Phrases(language, wording("clock", "meters", "brief"))), bytes(normal));
    EXPECT_GT(bytes(Phrases(language, wording("clock", "meters", "full"))), bytes(normal));
  }
}

TEST(Phrases, speak_spanish_with_its_letters_its_plurals_and_its_first_hour) {
  const Phrases phrases(kSpanish);
  EXPECT_EQ(phrases.voice(), "es");
  Fillings one = everything();
  one.hour = 1;
  one.distance = 1.0;
  EXPECT_EQ(phrases.say(CueKind::direction, one), "gire hacia la una, 1 metro");
  EXPECT_EQ(phrases.say(CueKind::direction, everything()), "gire hacia las 3, 8 metros");
  one.thing = ThingClass::shelf;
  EXPECT_EQ(phrases.say({CueKind::near, About::shelf}, one), "estanter\u00eda a su izquierda");
}

TEST(Phrases, name_what_the_hands_are_on) {
  Fillings keys = everything();
  keys.keys = true;
  const Phrases english(kEnglish);
  EXPECT_EQ(english.say(CueKind::robot_stopped), "robot stopped, release the stick");
  EXPECT_EQ(english.say(CueKind::robot_stopped, keys), "robot stopped, release the keys");
  EXPECT_EQ(english.say({CueKind::menu, About::setting_open}, keys),
            "volume, 2 percent, page up for more, page down for less");
  EXPECT_EQ(Phrases(kSpanish).say(CueKind::release_stick, keys), "suelte las teclas");
}

TEST(Phrases, call_what_has_no_name_something) {
  Fillings fillings = everything();
  fillings.thing = ThingClass::other;
  const Phrases english(kEnglish);
  EXPECT_EQ(english.say(CueKind::collision, fillings), "hit something on your left");
  EXPECT_EQ(english.say(CueKind::obstacle_comes, fillings), "something coming, on your left");
  EXPECT_EQ(english.say(CueKind::make_room, fillings),
            "move to 3 o'clock, 8 meters, to let something pass");
  EXPECT_EQ(Phrases(kSpanish).say(CueKind::collision, fillings),
            "choque, algo a su izquierda");
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

TEST(Phrases, refuse_letters_that_no_voice_reads_and_broken_utf8) {
  for (const char* text : {"caf\u00e9 ol\u00e9", "\u03bb\u03cc\u03b3\u03bf\u03c2",
                           "\u0441\u0442\u043e\u043f", "\u00dcber"})
    EXPECT_TRUE(speakable(text)) << text;
  for (const char* text : {"3 \u00d7 4", "\u20ac 5", "a\u0301", "\u202eabc", "\U0001F600 x",
                           "a\xc3", "\xe9t\xe9", "\xc1\xa1", "a\xc3 b"})
    EXPECT_FALSE(speakable(text)) << text;
}

TEST(Phrases, give_feet_where_they_are_wanted) {
  const Phrases phrases(kEnglish, wording("clock", "feet"));
  const std::vector<std::pair<double, std::string>> table = {{0.0, "1 foot"},  {0.4, "1 foot"},
                                                             {0.5, "2 feet"},  {5.9, "19 feet"},
                                                             {8.2, "25 feet"}, {1e9, "9999 feet"}};
  for (const auto& [metres, text] : table) EXPECT_EQ(phrases.distance(metres), text) << metres;
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

TEST(Phrases, round_distances_as_people_say_them) {
  const Phrases phrases(kEnglish);
  const std::vector<std::pair<double, std::string>> table = {
      {0.0, "0.5 meters"}, {0.6, "0.5 meters"},  {0.8, "1 meter"},    {1.2, "1 meter"},
      {1.3, "1.5 meters"}, {1.74, "1.5 meters"}, {1.76, "2 meters"},  {2.4, "2 meters"},
      {2.6, "3 meters"},   {49.6, "50 meters"},  {1e9, "9999 meters"}};
  for (const auto& [metres, text] : table) EXPECT_EQ(phrases.distance(metres), text) << metres;
  EXPECT_THROW((void)phrases.distance(std::nan("")), std::logic_error);
  EXPECT_THROW((void)phrases.distance(-1.0), std::logic_error);
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
}

TEST(Phrases, refuse_a_file_that_lacks_a_key_and_name_it) {
  const std::string no_phrase = refusal(replaced("  arrived:", "  # arrived:"));
  EXPECT_TRUE(names(no_phrase, "arrived") && names(no_phrase, "missing")) << no_phrase;
  const std::string no_word = refusal(replaced("  forklift: forklift\n", ""));
  EXPECT_TRUE(names(no_word, "words/forklift")) << no_word;
}

TEST(Phrases, stand_under_a_kind_for_all_that_it_may_be_about_but_what_has_one_of_its_own) {
  const std::string near = "  near: \"{thing} {where}\"\n";
  const TemporaryFile file(replaced(near, near + "  wall_near: \"mind the wall\"\n"));
  const Phrases phrases(file.path());
  EXPECT_EQ(phrases.say({CueKind::near, About::wall}, everything()), "mind the wall");
  EXPECT_EQ(phrases.say({CueKind::near, About::shelf}, everything()), "pallet robot on your left");
  EXPECT_TRUE(names(refusal(replaced(near, "  wall_near: \"mind the wall\"\n")), "shelf_near"));
  // One that needs no direction has no other words.
  EXPECT_TRUE(names(refusal(replaced("  start_distance:", "  # start_distance:")), "missing"));
}

TEST(Phrases, refuse_an_unknown_key_or_placeholder_with_its_line) {
  const std::string key = refusal(replaced("  no_goal:", "  typo: \"x\"\n  no_goal:"));
  EXPECT_TRUE(names(key, "phrases/typo") && names(key, "line ")) << key;
  const std::string placeholder = refusal(replaced("{direction}, {distance}", "{name} there"));
  EXPECT_TRUE(names(placeholder, "{name}") && names(placeholder, "line ")) << placeholder;
  EXPECT_NE(refusal(replaced("hit {a_thing} {where}", "hit {a_thing {where}")), "");
  EXPECT_NE(refusal(replaced("hit {a_thing} {where}", "hit {a_thing")), "");
  EXPECT_NE(refusal(replaced("  no_goal:", "  arrived: \"again\"\n  no_goal:")), "");
  EXPECT_NE(refusal(english() + "\nmore: {}\n"), "");
  EXPECT_TRUE(names(refusal(replaced("voice: en\n", "")), "voice"));
  EXPECT_TRUE(names(refusal(replaced("  clock_7: 7 o'clock\n", "")), "words/clock_7"));
  EXPECT_TRUE(names(refusal(replaced("  feet: feet\n", "")), "words/feet"));
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
