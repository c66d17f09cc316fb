#include "lessons/glossary.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>
#include <map>
#include <set>

#include "lessons/calibration.hpp"
#include "lessons/questionnaire.hpp"
#include "lessons/tutorial.hpp"

namespace navvi_feedback::lessons {
namespace {

using drive::Button;

cues::Phrases phrases(const std::string& language = "en") {
  return cues::Phrases(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/" + language + ".yaml");
}

/// Somebody who hears each text for a second, and presses a button when all is silent.
class GlossaryTest : public testing::Test {
 protected:
  /// Until it is over, or waits for a button.
  void hear(std::optional<Button> button = std::nullopt) {
    seen_.pressed = button ? std::vector{*button} : std::vector<Button>{};
    silent_ = 0.0;
    while (!glossary_.over() && silent_ < 4.0) {
      seen_.voice_busy = time_ < speaks_until_;
      const Taught taught = glossary_.update(seen_, time_);
      seen_.pressed.clear();
      for (const cues::Cue& cue : taught.cues) {
        kinds_.push_back(cue.word());
        speaks_until_ = time_ + 1.0;
      }
      if (taught.pattern) felt_.push_back(*taught.pattern);
      if (taught.pattern) sides_[*taught.pattern].push_back(taught.side);
      if (taught.off) ++counted_;
      if (taught.course) ++shown_[taught.course->lead];
      near_ += taught.near.empty() ? 0 : 1;
      for (const sounds::Play& play : taught.plays) heard_.insert(play.earcon);
      const bool nothing = taught.cues.empty() && !taught.pattern && taught.near.empty() &&
                           taught.plays.empty() && !seen_.voice_busy;
      silent_ = nothing ? silent_ + 0.02 : 0.0;
      time_ += 0.02;
    }
  }

  sounds::SoundsConfig sounds_ = [] {
    sounds::SoundsConfig all;
    all.beacon.on = true;
    return all;
  }();
  Glossary glossary_{phrases(), {}, {}, sounds_};
  Observation seen_;
  double time_ = 10.0;
  double silent_ = 0.0;
  double speaks_until_ = 0.0;
  std::vector<std::string> kinds_;
  std::vector<haptics::Pattern> felt_;
  std::map<haptics::Pattern, std::vector<haptics::Zone>> sides_;
  std::set<sounds::Earcon> heard_;
  int counted_ = 0;
  std::map<Lead, int> shown_;
  int near_ = 0;
};

TEST_F(GlossaryTest, gives_every_pattern_sound_and_word_one_after_another) {
  for (int i = 0; i < 100 && !glossary_.over(); ++i)
    hear(i > 0 ? std::optional(Button::next) : std::nullopt);
  EXPECT_TRUE(glossary_.over());
  EXPECT_EQ(felt_.size(), 2 * names(haptics::Pattern{}).size());
  using haptics::Zone;
  EXPECT_EQ(sides_[haptics::Pattern::answer], (std::vector{Zone::left, Zone::right}));
  EXPECT_EQ(sides_[haptics::Pattern::halt], (std::vector{Zone::center, Zone::center}));
  EXPECT_EQ(heard_.size() + 2, names(sounds::Earcon{}).size())
      << "all but the one that is counted and the one that lasts";
  EXPECT_GT(shown_[Lead::flow], 150);
  EXPECT_GT(shown_[Lead::hand], 150);
  EXPECT_GT(counted_, 100);
  EXPECT_GT(near_, 300);
  for (const char* kind : {"obstacle_stop", "blocked", "back_away", "go_on", "turn_now"})
    EXPECT_EQ(std::count(kinds_.begin(), kinds_.end(), kind),
              kind == std::string("turn_now") ? 5 : 1);
}

TEST_F(GlossaryTest, goes_on_back_again_and_ends_by_buttons) {
  hear();
  EXPECT_EQ(kinds_.back(), "glossary_near_left");
  hear(Button::next);
  EXPECT_EQ(kinds_.back(), "glossary_near_right");
  hear(Button::repeat);
  EXPECT_EQ(kinds_.back(), "glossary_near_right");
  hear(Button::previous);
  EXPECT_EQ(kinds_.back(), "glossary_near_left");
  hear(Button::end);
  EXPECT_EQ(kinds_.back(), "glossary_end");
  EXPECT_TRUE(glossary_.over());
}

TEST_F(GlossaryTest, leaves_out_what_cannot_be_felt_or_heard_here) {
  seen_.motors = seen_.audible = false;
  for (int i = 0; i < 100 && !glossary_.over(); ++i)
    hear(i > 0 ? std::optional(Button::next) : std::nullopt);
  EXPECT_TRUE(glossary_.over());
  EXPECT_TRUE(felt_.empty() && heard_.empty() && near_ == 0);
  EXPECT_EQ(std::count(kinds_.begin(), kinds_.end(), "glossary_no_motors"), 1);
  EXPECT_EQ(std::count(kinds_.begin(), kinds_.end(), "go_on"), 1);
}

TEST(Lessons, have_each_text_in_every_language_and_no_other) {
  for (const char* language : {"en", "es"}) {
    std::set<std::string> known = {"help"};
    for (const auto& keys :
         {Glossary::texts(), Tutorial::texts(), Calibration::texts(), Questionnaire::texts()})
      known.insert(keys.begin(), keys.end());
    const cues::Phrases spoken = phrases(language);
    const auto on_keys = [&](const std::string& key) {
      const std::size_t end = key.rfind("_keys");
      return end != std::string::npos && known.count(key.substr(0, end)) > 0;
    };
    for (const auto& [key, text] : spoken.lessons())
      EXPECT_TRUE(known.count(key) > 0 || on_keys(key) || key.rfind("pad_", 0) == 0 ||
                  key.rfind("key_", 0) == 0)
          << language << ": " << key;
    EXPECT_NO_THROW((Teller{spoken, {}, {known.begin(), known.end()}})) << language;
    for (int button = 0; button < 15; ++button) {
      drive::ButtonsConfig moved;
      moved.index.fill(button);
      if (spoken.lessons().count("pad_" + std::to_string(button)) == 0) continue;
      EXPECT_NO_THROW((Teller{spoken, moved, {known.begin(), known.end()}})) << language << button;
    }
  }
}

TEST(Lessons, tell_when_the_stick_answers_that_a_thing_is_ahead) {
  for (const auto& [language, when] :
       {std::pair("en", " if it is ahead"), std::pair("es", " si est\u00e1 delante")}) {
    const std::map<std::string, std::string> lessons = phrases(language).lessons();
    for (const char* key : {"tutorial_near_right", "tutorial_near_right_keys"})
      EXPECT_NE(lessons.at(key).find(when), std::string::npos) << key;
  }
}

TEST(Lessons, teach_no_hours_to_who_hears_no_hours) {
  cues::Phrases degrees = phrases();
  degrees.use({"degrees"});
  Glossary glossary(degrees, {}, {}, {});
  Observation seen;
  for (double time = 0.0; time < 100.0 && !glossary.over(); time += 0.02) {
    seen.pressed = {Button::next};
    for (const cues::Cue& cue : glossary.update(seen, time).cues)
      EXPECT_EQ(cue.word().rfind("glossary_hour", 0), std::string::npos) << cue.word();
  }
  EXPECT_TRUE(glossary.over());
}

TEST(Lessons, refuse_a_phrase_file_that_lacks_a_signal) {
  EXPECT_THROW((Teller{phrases(), {}, {"glossary_felt_new"}}), navvi_config::ConfigError);
}

}  // namespace
}  // namespace navvi_feedback::lessons
