#include "person/person_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <fstream>

#include "temp_folder.hpp"

namespace navvi_feedback::person {
namespace {

namespace fs = std::filesystem;
using navvi_config::ConfigError;

struct Voice {
  int rate = 220;
  std::string name;
  void describe(navvi_config::Visitor& visit) {
    visit(rate, "rate", navvi_config::Range{80.0, 449.0}, "words/min", "rate of speech");
    visit(name, "name", navvi_config::Any{}, "", "who speaks");
  }
};
struct Config {
  bool speech = true;
  Voice voice;
  std::vector<std::string> classes;
  void describe(navvi_config::Visitor& visit) {
    visit(speech, "speech", navvi_config::Any{}, "", "whether anything is said");
    visit.group("voice", voice);
    visit(classes, "classes", navvi_config::OneOf{{"box", "worker"}}, "", "what is felt");
  }
};

class PersonFileTest : public testing::Test {
 protected:
  PersonFileTest() { setenv("NAVVI_PEOPLE", folder_.c_str(), 1); }

  static PersonFile anna() { return PersonFile::of<Config>("anna"); }
  [[nodiscard]] std::string content() const { return home_.text("people/anna.yaml"); }
  /// The sentence with which it is refused.
  template <typename Act>
  static std::string refused(const Act& act) {
    try {
      act();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const navvi_test::TempFolder home_;
  const fs::path folder_ = home_ / "people";
};

TEST_F(PersonFileTest, a_new_person_has_no_settings_and_gets_a_file_with_the_first) {
  EXPECT_EQ(anna().load().size(), 0U);
  EXPECT_FALSE(fs::exists(folder_)) << "nothing is made by looking";
  anna().save({"voice/rate:=300"});
  Config config;
  navvi_config::read(config, anna().load(), "test");
  EXPECT_EQ(config.voice.rate, 300);
}

TEST_F(PersonFileTest, tells_what_each_value_is_and_keeps_what_was_there) {
  anna().save({"voice/rate:=300", "classes:=[box, worker]"});
  anna().save({"voice/name:=", "voice/rate:=310"});
  anna().save({"speech:=false"});
  EXPECT_EQ(content(),
            "# Settings of anna in NavVI, instead of the profile's. What else can stand here: "
            "./navvi parameters feedback\n"
            "# whether anything is said; true or false\n"
            "speech: false\n"
            "voice:\n"
            "  # rate of speech; 80 to 449 words/min\n"
            "  rate: 310\n"
            "  # who speaks\n"
            "  name: \"\"\n"
            "# what is felt; one of box, worker\n"
            "classes: [box, worker]\n");
  EXPECT_EQ(anna().load()["voice"]["rate"].as<int>(), 310);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "and nothing beside it";
}

TEST_F(PersonFileTest, a_wrong_file_is_refused_by_a_sentence_and_never_written_over) {
  const std::string file = (folder_ / "anna.yaml").string();
  for (const auto& [text, sentence] : std::vector<std::pair<std::string, std::string>>{
           {"voice:\n  rate: 900\n",
            ", line 2: \"voice/rate\" is 900; allowed is 80 to 449 words/min."},
           {"pitch: 3\n",
            ", line 1: the key \"pitch\" is unknown; known here are classes, speech, voice."},
           {"voice: {rate: 1\n", ", line 2: this is not YAML: end of map flow not found."}}) {
    home_.write("people/anna.yaml", text);
    EXPECT_EQ(refused([] { (void)anna().load(); }), file + sentence);
    EXPECT_EQ(refused([] { anna().save({"voice/rate:=300"}); }), file + sentence);
    EXPECT_EQ(content(), text);
  }
}

TEST_F(PersonFileTest, a_wrong_value_is_not_saved) {
  anna().save({"voice/rate:=300"});
  const std::string before = content();
  EXPECT_EQ(refused([] { anna().save({"voice/rate:=900"}); }),
            "the settings of anna: \"voice/rate\" is 900; allowed is 80 to 449 words/min.");
  EXPECT_EQ(content(), before);
}

TEST_F(PersonFileTest, nothing_is_lost_where_nothing_can_be_written) {
  anna().save({"voice/rate:=300"});
  const std::string before = content();
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{}, full{};
  getrlimit(RLIMIT_FSIZE, &old);
  full = old;
  full.rlim_cur = 100;  // bytes: the disk is full in the midst of the file
  setrlimit(RLIMIT_FSIZE, &full);
  const std::string sentence = refused([] { anna().save({"voice/rate:=310"}); });
  setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_EQ(sentence, "The settings of anna are not kept: cannot write " +
                          (folder_ / "anna.yaml").string() + ": File too large.");
  EXPECT_EQ(content(), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "no half file stays";

  fs::remove_all(folder_);
  std::ofstream(folder_) << "a file where the folder should be";
  EXPECT_NE(refused([] { anna().save({"voice/rate:=310"}); }), "");
}

TEST_F(PersonFileTest, only_names_that_are_safe_are_taken) {
  for (const char* name :
       {"", "-anna", "../anna", "a b", "anna.yaml", "a123456789012345678901234", "\xC3\xA4"})
    EXPECT_EQ(refused([&] { (void)PersonFile::of<Config>(name); }),
              "\"" + std::string(name) +
                  "\" is not a name for a person's settings; allowed are up to 24 letters, digits, - "
                  "and _, a letter or digit first.");
  unsetenv("NAVVI_PEOPLE");
  setenv("HOME", home_.string().c_str(), 1);
  PersonFile::of<Config>("sub-01_b").save({"voice/rate:=300"});
  EXPECT_TRUE(fs::exists(home_ / ".navvi/people/sub-01_b.yaml"));
}

}  // namespace
}  // namespace navvi_feedback::person
