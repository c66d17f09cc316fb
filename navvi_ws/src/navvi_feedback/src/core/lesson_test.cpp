#include <gtest/gtest.h>

#include <functional>
#include <navvi_config/reader.hpp>
#include <set>

#include "beat.hpp"
#include "lessons/tutorial.hpp"
#include "temp_folder.hpp"

namespace navvi_feedback::core {
namespace {

/// Hears each text for half a second, and presses the arrow down when it is silent.
class Learner {
 public:
  explicit Learner(const std::string& lesson) : guide_(config(lesson), cues::Phrases(kEnglish)) {
    input_.hands.live = true;
    input_.hands.axes = {0.0, 0.0};
    input_.hands.buttons.resize(15);
    input_.pad = "pad";
  }
  static GuideConfig config(const std::string& lesson) {
    GuideConfig config;
    config->lesson = lesson;
    return config;
  }
  void learn(double seconds, const std::function<void(const Beat&)>& note) {
    for (const double end = time_ + seconds; time_ < end; time_ += 0.02) {
      input_.speaking = time_ < speaks_until_;
      const double silent = time_ - speaks_until_;
      input_.hands.buttons[12] = silent > 4.0 && silent < 4.1;
      const Beat output = beat(guide_, input_, time_);
      if (output.voice.start) speaks_until_ = time_ + 0.5;
      note(output);
    }
  }

  Guide guide_;
  Devices input_;
  double time_ = 10.0;
  double speaks_until_ = 0.0;
};

TEST(Lesson, is_given_by_the_motors_and_sounds_of_a_session_and_drives_no_robot) {
  Learner learner("glossary");
  std::set<std::string> said;
  std::set<sounds::Earcon> heard;
  std::set<haptics::Pattern> felt;
  double left_alone = 0.0;
  learner.input_.hands.axes = {0.0, 1.0};
  learner.learn(400.0, [&](const Beat& output) {
    EXPECT_FALSE(output.command);
    for (const cues::Cue& cue : output.cues) said.insert(cue.word());
    for (const sounds::Play& play : output.plays) heard.insert(play.earcon);
    if (output.pattern) felt.insert(*output.pattern);
    if (output.rumble.right == 0.0) left_alone = std::max(left_alone, output.rumble.left);
  });
  EXPECT_EQ(felt.size(), names(haptics::Pattern{}).size());
  EXPECT_EQ(heard.size(), names(sounds::Earcon{}).size() - 2) << "all but what is off";
  EXPECT_GT(left_alone, 0.5);
  EXPECT_EQ(said.count("glossary_said_go_on") + said.count("go_on"), 2U);
  for (const char* kind : {"simulator_lost", "guidance_lost", "proximity_lost", "release_stick"})
    EXPECT_EQ(said.count(kind), 0U) << kind;
}

TEST(Lesson, lets_a_newcomer_drive_before_the_trial_and_the_guide_says_what_is_urgent_only) {
  Learner learner("tutorial");
  TrialState waits;
  waits.state = TrialState::State::ready;
  learner.guide_.take(waits, learner.time_);
  std::set<std::string> said;
  double fastest = 0.0;
  learner.learn(30.0, [&](const Beat& output) {
    learner.guide_.take(Odometry{}, learner.time_);
    learner.guide_.take(Proximity{}, learner.time_);
    learner.input_.hands.axes = {0.0, learner.time_ > 15.0 ? 1.0 : 0.0};
    if (output.command) fastest = std::max(fastest, output.command->linear);
    for (const cues::Cue& cue : output.cues) said.insert(cue.word());
  });
  EXPECT_GT(fastest, 0.8);
  EXPECT_EQ(said.count("press_start"), 0U);
  EXPECT_EQ(said.count("tutorial_let_go"), 1U);
  EXPECT_EQ(said.count("stuck_unknown"), 1U);
}

TEST(Lesson, shows_the_sentence_that_it_says_in_each_of_its_steps) {
  for (const char* lesson : {"tutorial", "glossary", "calibrate"}) {
    Learner learner(lesson);
    TrialState waits;
    waits.state = TrialState::State::ready;
    learner.guide_.take(waits, learner.time_);
    std::set<std::string> keys, wrong;
    std::string said;
    learner.learn(400.0, [&](const Beat& output) {
      learner.guide_.take(Odometry{}, learner.time_);
      learner.guide_.take(Proximity{}, learner.time_);
      learner.guide_.take(Guidance{}, learner.time_);
      for (const CueEvent& event : output.events) {
        const navvi_types::Spoken* const spoken = event.spoken();
        if (event.stage != CueStage::started || !spoken || spoken->lesson.empty()) continue;
        keys.insert(spoken->lesson);
        said = event.text;
      }
      if (!learner.guide_.parts().teacher.speaks() || said.empty()) return;
      const auto order = learner.guide_.order();
      if (!order || order->text != said || order->kind() != CueKind::lesson)
        wrong.insert(said + " | " + (order ? order->text : "nothing"));
    });
    EXPECT_EQ(wrong, std::set<std::string>{}) << lesson;
    EXPECT_GT(keys.size(), 4U) << lesson;
    if (lesson != std::string("tutorial")) continue;
    for (const auto& step : lessons::Tutorial::steps())
      EXPECT_EQ(keys.count("tutorial_" + std::string(step.name)), 1U) << step.name;
  }
}

TEST(Lesson, lets_it_be_heard_that_what_it_found_cannot_be_saved) {
  Learner learner("calibrate");
  bool heard = false;
  learner.learn(20.0, [&](const Beat& output) {
    if (learner.time_ > 15.0 && learner.time_ < 15.02)
      learner.guide_.announce({CueKind::settings, About::not_saved});
    for (const CueEvent& event : output.events)
      heard = heard || (event.stage == CueStage::started &&
                        event.content() == Content(CueKind::settings, About::not_saved));
  });
  EXPECT_TRUE(heard);
}

/// The English phrases with a text of a lesson less.
cues::Phrases without(const char* text) {
  const navvi_test::TempFolder folder;
  YAML::Node file = YAML::LoadFile(kEnglish);
  file["lessons"].remove(text);
  return cues::Phrases(folder.write("phrases.yaml", YAML::Dump(file)));
}

TEST(Lesson, whose_texts_are_missing_is_refused_at_the_start_and_not_once_it_is_wanted) {
  const auto refusal = [](const char* lesson, const char* text) -> std::string {
    try {
      Guide(Learner::config(lesson), without(text));
      return "";
    } catch (const navvi_config::ConfigError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal("none", "tutorial_stop"), "");
  for (const char* text : {"help", "glossary_end"})
    EXPECT_NE(refusal("none", text).find(std::string("lessons/") + text), std::string::npos);
  EXPECT_NE(refusal("tutorial", "tutorial_stop").find("lessons/tutorial_stop"), std::string::npos);
}

}  // namespace
}  // namespace navvi_feedback::core
