#include "person/saver.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "person/person_file.hpp"
#include "temp_folder.hpp"

namespace navvi_feedback::person {
namespace {

namespace fs = std::filesystem;

struct Config {
  int rate = 220;
  int volume = 50;
  void describe(navvi_config::Visitor& visit) {
    visit(rate, "rate", navvi_config::Range{80.0, 449.0}, "words/min", "rate of speech");
    visit(volume, "volume", navvi_config::Range{0.0, 100.0}, "%", "volume of speech");
  }
};

class SaverTest : public testing::Test {
 protected:
  SaverTest() { setenv("NAVVI_PEOPLE", folder_.c_str(), 1); }
  static PersonFile anna() { return PersonFile::of<Config>("anna"); }
  static Saver<std::string> saver_of_anna() {
    return {[](const std::vector<std::string>& words) { anna().save(words); },
            {CueKind::settings, About::not_saved}};
  }

  const navvi_test::TempFolder home_;
  const fs::path folder_ = home_ / "people";
};

TEST_F(SaverTest, saves_all_there_is_before_the_end) {
  Saver<std::string> saver = saver_of_anna();
  saver.save("rate:=300");
  EXPECT_TRUE(saver.update().empty());
  saver.save("rate:=310");  // while the first is being written
  saver.save("volume:=80");
  EXPECT_TRUE(saver.finish().empty());
  EXPECT_EQ(anna().load()["rate"].as<int>(), 310);
  EXPECT_EQ(anna().load()["volume"].as<int>(), 80);
}

TEST_F(SaverTest, without_a_file_says_once_that_nothing_is_kept) {
  Saver<std::string> saver({}, {CueKind::settings, About::not_kept});
  EXPECT_TRUE(saver.update().empty());
  saver.save("rate:=300");
  const std::vector<Failure> failures = saver.update();
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].cue, Content(CueKind::settings, About::not_kept));
  saver.save("rate:=310");
  EXPECT_TRUE(saver.finish().empty());
}

TEST_F(SaverTest, tells_what_cannot_be_written) {
  std::ofstream(folder_) << "a file where the folder should be";
  Saver<std::string> saver = saver_of_anna();
  saver.save("rate:=300");
  const std::vector<Failure> failures = saver.finish();
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].cue, Content(CueKind::settings, About::not_saved));
  EXPECT_NE(failures[0].detail.find(folder_.string()), std::string::npos) << failures[0].detail;
}

}  // namespace
}  // namespace navvi_feedback::person
