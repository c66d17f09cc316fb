#include "lessons/tutorial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace navvi_feedback::lessons {
namespace {

using drive::Button;

/// A newcomer with a robot that obeys the stick, who hears each sentence for a second.
class TutorialTest : public testing::Test {
 protected:
  /// What the person does about a step, tick by tick, from the time that it was told.
  using Hand = std::function<void(double since)>;

  TutorialTest() {
    hands_ = {
        {"let_go", [this](double t) { seen_.stick.y = t < 1.0 ? 0.8 : 0.0; }},
        {"ahead", [this](double t) { seen_.stick.y = said("enough") ? 0.0
                                                     : t < 8.0      ? 1.0
                                                                    : 0.0; }},
        {"halt", [this](double) { seen_.stick.y = heard("stop", 0.5) ? 0.0 : 1.0; }},
        {"wait", [this](double t) { wait(t); }},
        {"back_away", [this](double) { obey("said_back_away", -0.6, 0.0); }},
        {"turn_right", [this](double) { seen_.stick.x = off_ && *off_ > 0.2 ? -0.5 : 0.0; }},
        {"turn_left", [this](double) { seen_.stick.x = off_ && *off_ < -0.2 ? 0.5 : 0.0; }},
        {"by_sound", [this](double) { follow(Lead::flow); }},
        {"by_hand", [this](double) { follow(Lead::hand); }},
        {"make_room", [this](double) { make_room(0.5); }},
        {"near_right", [this](double t) { seen_.stick.x = t > 0.5 && near_ ? -1.0 : 0.0; }},
        {"near_ahead", [this](double t) { seen_.stick.y = t > 0.5 && near_ ? 1.0 : 0.0; }},
        {"near_left", [this](double t) { seen_.stick.x = t > 0.5 && near_ ? 1.0 : 0.0; }},
        {"press_help", [this](double t) { press(Button::help, t); }},
        {"press_around", [this](double t) { press(Button::around, t); }},
        {"press_where", [this](double t) { press(Button::where, t); }},
        {"goal", [this](double t) { drive_to_goal(t); }}};
  }

  /// Lets go at "wait", and drives on by a metre at "go on".
  void wait(double since) {
    seen_.stick.y = heard("said_go_on", 1.8)   ? 0.0
                    : heard("said_go_on", 0.5) ? 1.0
                    : heard("said_wait", 0.5)  ? 0.0
                    : since < 8.0              ? 1.0
                                               : 0.0;
  }
  /// Pushes for a second once that is heard.
  void obey(const std::string& word, double forward, double left) {
    const bool now = heard(word, 0.5) && !heard(word, 1.5);
    seen_.stick = {now ? left : 0.0, now ? forward : 0.0};
  }
  /// Turns until the ticks end, then drives.
  void make_room(double left) {
    if (!heard("said_make_room", 0.5)) return;
    if (off_ && *off_ * left < -0.1 && !arrives_)
      seen_.stick.x = left;
    else if (!arrives_)
      arrives_ = time_ + 0.5;
    if (arrives_ && time_ > *arrives_ && time_ < *arrives_ + 1.2) seen_.stick.y = 1.0;
  }
  /// Steers to where the lesson shows.
  void follow(Lead lead) {
    if (!course_) return;
    EXPECT_EQ(course_->lead, lead);
    seen_.stick = {std::clamp(-2.0 * course_->course.turn, -1.0, 1.0), course_->course.speed};
  }
  void press(Button button, double since) {
    if (since >= 0.5 && since < 0.52) seen_.pressed = {button};
  }
  void drive_to_goal(double since) {
    seen_.trial = since < 1.0   ? TrialState::State::ready
                  : since < 6.0 ? TrialState::State::running
                                : TrialState::State::choose_goal;
    arrive(since > 5.9);
  }
  void arrive(bool arrived) {
    seen_.guidance.emplace();
    if (arrived) seen_.guidance->state = Guidance::State::arrived;
  }
  [[nodiscard]] bool said(const std::string& name) const {
    return last_ == "tutorial_" + name || heard_.count("tutorial_" + name) > 0;
  }
  [[nodiscard]] bool heard(const std::string& name, double for_seconds) const {
    const auto at = heard_.find("tutorial_" + name);
    return at != heard_.end() && time_ - at->second >= for_seconds;
  }

  /// Until the tutorial ends. \return what was told, in order
  void run(double most = 400.0) {
    for (const double end = time_ + most; time_ < end && !tutorial_.over(); time_ += 0.02) tick();
  }
  void restart(const cues::Phrases& phrases) {
    tutorial_ = Tutorial(phrases, {});
    step_ = last_ = "";
    acts_since_.reset();
    seen_.trial = TrialState::State::free;
    arrive(false);
  }
  void tick() {
    seen_.voice_busy = time_ < speaks_until_;
    seen_.pressed = std::exchange(presses_, {});
    const std::string step = tutorial_.results().empty() ? "" : tutorial_.results().back().step;
    if (step != step_ || tries_ != told_) {
      step_ = step;
      told_ = tries_;
      acts_since_.reset();
      arrives_.reset();
      heard_.clear();
    }
    seen_.stick = {};
    // Between two sentences it is silent for a moment.
    if (last_ == "tutorial_" + step && time_ > speaks_until_ + 0.3 && !acts_since_)
      acts_since_ = time_;
    if (acts_since_) hands_.at(step)(time_ - *acts_since_);
    seen_.measured =
        tutorial_.drives() ? Velocity{0.8 * seen_.stick.y, 1.2 * seen_.stick.x} : Velocity{};
    const Taught taught = tutorial_.update(seen_, time_);
    seen_.begun.clear();
    off_ = taught.off;
    course_ = taught.course;
    near_ = !taught.near.empty();
    if (taught.pattern) felt_[step] = *taught.pattern;
    for (const cues::Cue& cue : taught.cues) {
      const bool goes_on = last_ == cue.word();  // with its next sentence
      last_ = cue.word();
      seen_.begun = {cue.word()};
      heard_[cue.word()] = time_;
      all_.push_back(cue.word());
      texts_[cue.word()] = cue.text;
      speaks_until_ = time_ + 1.0;
      if (!goes_on && cue.word().rfind("tutorial_wrong", 0) == 0) ++tries_;
    }
  }
  [[nodiscard]] auto count(const std::string& name) const {
    return std::count(all_.begin(), all_.end(), "tutorial_" + name);
  }
  [[nodiscard]] const Tutorial::Result& result(std::size_t i) const {
    return tutorial_.results().at(i);
  }

  Tutorial tutorial_{cues::Phrases(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml"),
                     {}};
  std::map<std::string, Hand> hands_;
  Observation seen_;
  std::vector<Button> presses_;
  double time_ = 10.0;
  double speaks_until_ = 0.0;
  std::optional<double> acts_since_;
  std::optional<double> arrives_;  // s, when the turn to the place is made
  std::string step_, last_;
  std::map<std::string, double> heard_;
  std::vector<std::string> all_;
  std::map<std::string, std::string> texts_;      // as spoken last
  std::map<std::string, haptics::Pattern> felt_;  // by step
  std::optional<double> off_;
  std::optional<Shown> course_;
  bool near_ = false;
  int tries_ = 0;
  int told_ = 0;
};

TEST_F(TutorialTest, is_passed_by_doing_each_step_and_practises_the_one_that_took_longest) {
  run();
  ASSERT_TRUE(tutorial_.over());
  const std::size_t steps = Tutorial::steps().size();
  ASSERT_EQ(tutorial_.results().size(), steps + 1);
  for (std::size_t i = 0; i < steps; ++i) {
    EXPECT_EQ(result(i).step, Tutorial::steps()[i].name);
    EXPECT_TRUE(result(i).passed) << result(i).step;
    EXPECT_EQ(result(i).tries, 1) << result(i).step;
  }
  EXPECT_TRUE(result(steps).practice);
  EXPECT_NE(result(steps).step, "goal");
  EXPECT_EQ(count("well"), 1);
  EXPECT_GE(time_, speaks_until_) << "heard to its last word";
}

TEST_F(TutorialTest, passes_over_ways_of_leading_that_do_not_reach_the_person) {
  seen_.audible = seen_.motors = false;
  hands_["turn_right"] = hands_["turn_left"] = [](double) {};
  run(30.0);
  for (std::size_t i = 0; i < Tutorial::steps().size() && !tutorial_.over(); ++i) {
    presses_ = {Button::next};
    run(5.0);
  }
  for (const Tutorial::Result& result : tutorial_.results()) {
    EXPECT_NE(result.step, "by_sound");
    EXPECT_NE(result.step, "by_hand");
  }
}

TEST_F(TutorialTest, asks_for_no_button_that_there_is_not_and_tells_of_those_without_a_name) {
  drive::ButtonsConfig buttons;
  buttons.index.at(static_cast<std::size_t>(Button::around)) = -1;
  buttons.index.at(static_cast<std::size_t>(Button::where)) = 99;
  buttons.index.at(static_cast<std::size_t>(Button::end)) = 99;
  tutorial_ =
      Tutorial(cues::Phrases(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml"), buttons);
  run();
  EXPECT_TRUE(tutorial_.over());
  EXPECT_EQ(count("press_around"), 0);
  EXPECT_EQ(count("press_where"), 1);
  EXPECT_EQ(count("buttons"), 3);
  EXPECT_EQ(count("well"), 1) << "all that there are";
}

TEST_F(TutorialTest, tells_what_was_wrong_and_practises_the_weakest_step_at_the_end) {
  const Hand well = hands_["turn_left"];
  hands_["turn_left"] = [this, well](double t) {
    if (tries_ > 0) return well(t);
    seen_.stick.x = off_ && *off_ < 0.8 ? 0.5 : 0.0;  // 45 degrees too far
  };
  run();
  ASSERT_TRUE(tutorial_.over());
  EXPECT_EQ(count("wrong_too_far"), 1);
  EXPECT_EQ(result(6).step, "turn_left");
  EXPECT_EQ(result(6).tries, 2);
  EXPECT_TRUE(result(6).passed);
  EXPECT_EQ(tutorial_.results().back().step, "turn_left");
  EXPECT_TRUE(tutorial_.results().back().practice);
  EXPECT_EQ(count("done"), 1);
  EXPECT_NE(tutorial_.record().find("\nturn_left,2,"), std::string::npos) << tutorial_.record();
}

TEST_F(TutorialTest, knows_each_way_to_go_wrong) {
  const std::map<std::string, std::map<std::string, Hand>> wrong = {
      {"let_go",
       {{"back", [this](double) { seen_.stick.y = -1.0; }},
        {"crooked", [this](double) { seen_.stick.x = 1.0; }}}},
      {"ahead", {{"short", [this](double t) { seen_.stick.y = t < 1.0 ? 0.8 : 0.0; }}}},
      {"halt",
       {{"late", [this](double) { seen_.stick.y = 1.0; }},
        {"early", [this](double t) { seen_.stick.y = t < 0.5 ? 1.0 : 0.0; }}}},
      {"wait",
       {{"late", [this](double) { seen_.stick.y = 1.0; }},
        {"early", [this](double t) { seen_.stick.y = t < 0.5 ? 1.0 : 0.0; }},
        {"back", [this](double) { seen_.stick.y = -1.0; }},
        {"moved",
         [this](double) {
           seen_.stick.y = heard("said_wait", 0.5) && !heard("said_wait", 1.5) ? 0.0 : 1.0;
         }},
        {"stood", [this](double) { seen_.stick.y = heard("said_wait", 0.5) ? 0.0 : 1.0; }},
        {"short",
         [this](double t) {
           wait(t);
           if (heard("said_go_on", 1.0)) seen_.stick.y = 0.0;
         }},
        {"crooked",
         [this](double t) {
           wait(t);
           if (heard("said_go_on", 0.5)) seen_.stick.x = 1.0;
         }}}},
      {"back_away",
       {{"soon", [this](double) { seen_.stick.y = -1.0; }},
        {"forward", [this](double) { obey("said_back_away", 1.0, 0.0); }},
        {"short", [this](double) { obey("said_back_away", -0.15, 0.0); }},
        {"not_back", [this](double) { obey("said_back_away", -1.0, 1.0); }}}},
      {"make_room",
       {{"soon", [this](double) { seen_.stick.y = 1.0; }},
        {"side", [this](double) { obey("said_make_room", 0.0, -1.0); }},
        {"place", [this](double) { obey("said_make_room", 1.0, 0.0); }},
        {"short",
         [this](double) {
           make_room(0.5);
           if (seen_.stick.y > 0.0) seen_.stick.y = 0.3;
         }}}},
      {"turn_right",
       {{"side", [this](double) { seen_.stick.x = 0.5; }},
        {"too_little", [this](double t) { seen_.stick.x = t < 1.0 ? -0.5 : 0.0; }},
        {"driven", [this](double) { seen_.stick.y = 1.0; }}}},
      {"by_sound", {{"place", [this](double) { seen_.stick.y = 1.0; }}}},
      {"by_hand",
       {{"place",
         [this](double t) {
           seen_.stick.x = t < 1.0 ? 1.0 : std::fmod(t, 1.0) < 0.5 ? 0.5 : -0.5;
         }}}},
      {"near_right", {{"was_right", [this](double t) { seen_.stick.x = t > 0.5 ? 1.0 : 0.0; }}}},
      {"near_left", {{"was_left", [this](double t) { seen_.stick.y = t > 0.5 ? 1.0 : 0.0; }}}},
      {"near_ahead", {{"was_ahead", [this](double t) { seen_.stick.x = t > 0.5 ? 1.0 : 0.0; }}}},
      {"press_around", {{"button", [this](double t) { press(Button::goal, t); }}}}};
  for (const auto& [step, ways] : wrong)
    for (const auto& [name, hand] : ways) {
      const Hand well = hands_.at(step);
      const Hand ill = hand;
      const int before = tries_;
      hands_[step] = [this, well, ill, before](double t) { tries_ == before ? ill(t) : well(t); };
      for (; time_ < 5000.0 && step_ != step; time_ += 0.02) tick();
      const auto count_before = count("wrong_" + name);
      for (const double end = time_ + 60.0; time_ < end && step_ == step; time_ += 0.02) tick();
      EXPECT_GT(count("wrong_" + name), count_before) << step;
      EXPECT_NE(step_, step) << "and then passed";
      hands_[step] = well;
      restart(cues::Phrases(std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml"));
    }
}

TEST_F(TutorialTest, says_what_the_guide_says_in_a_session_and_explains_it_by_the_same_words) {
  for (const char* language : {"en", "es"})
    for (const char* verbosity : {"brief", "normal", "full"}) {
      cues::WordingConfig wording;
      wording.verbosity = verbosity;
      const cues::Phrases phrases(
          std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/" + language + ".yaml", wording);
      restart(phrases);
      run();
      cues::Fillings words;
      words.hour = 12;
      words.distance = 1.0;
      words.side = cues::Side::ahead;
      words.thing = navvi_types::ThingClass::forklift;
      const std::string wait = phrases.say(CueKind::blocked, words);
      const std::string go_on = phrases.say(CueKind::go_on);
      EXPECT_EQ(texts_["tutorial_said_wait"], wait);
      EXPECT_EQ(texts_["tutorial_said_go_on"],
                go_on + ", " + phrases.say(CueKind::straight, words));
      words.hour = 10;
      EXPECT_EQ(texts_["tutorial_said_make_room"], phrases.say(CueKind::make_room, words));
      words.thing = navvi_types::ThingClass::shelf;
      const std::string back = phrases.say(CueKind::back_away, words);
      EXPECT_EQ(texts_["tutorial_said_back_away"], back);
      const auto first_words = [](const std::string& text) {
        return text.substr(0, text.find(','));
      };
      const std::string& told = phrases.lessons().at("tutorial_wait");
      EXPECT_NE(told.find(first_words(wait)), std::string::npos) << told;
      EXPECT_NE(told.find(go_on), std::string::npos) << told;
      EXPECT_NE(phrases.lessons().at("tutorial_wrong_moved").find(go_on), std::string::npos);
      for (const char* key : {"tutorial_back_away", "tutorial_back_away_keys"})
        EXPECT_NE(phrases.lessons().at(key).find(first_words(back)), std::string::npos) << key;
      EXPECT_EQ(felt_["wait"], haptics::Pattern::halt);
    }
}

TEST_F(TutorialTest, passes_nothing_without_doing_it_leaves_it_out_and_ends_by_buttons) {
  hands_["let_go"] = [](double) {};
  run(200.0);
  EXPECT_FALSE(tutorial_.over());
  EXPECT_EQ(tutorial_.results().size(), 1U);
  EXPECT_GT(count("let_go"), 3) << "told again now and then";
  presses_ = {Button::next};
  tick();
  ASSERT_EQ(tutorial_.results().size(), 2U);
  EXPECT_FALSE(result(0).passed);
  presses_ = {Button::end};
  run(10.0);
  EXPECT_TRUE(tutorial_.over());
  EXPECT_EQ(all_.back(), "tutorial_end");
}

TEST_F(TutorialTest,
       leaves_the_word_to_the_guide_at_once_where_the_trial_begins_before_its_last_word) {
  hands_["goal"] = [](double) {};
  for (; time_ < 300.0 && step_ != "goal"; time_ += 0.02) tick();
  seen_.trial = TrialState::State::running;
  seen_.stick.y = 1.0;
  seen_.measured = Velocity{0.5, 0.0};
  for (int i = 0; i < 3; ++i) (void)tutorial_.update(seen_, time_ += 0.02);
  EXPECT_FALSE(tutorial_.speaks());
  EXPECT_TRUE(tutorial_.update(seen_, time_ += 0.02).cues.empty());
}

TEST_F(TutorialTest, is_silent_while_the_trial_to_the_goal_runs) {
  for (; time_ < 300.0 && tutorial_.speaks(); time_ += 0.02) tick();
  EXPECT_EQ(step_, "goal");
  EXPECT_TRUE(tutorial_.drives());
  EXPECT_FALSE(tutorial_.takes(Button::end));
}

}  // namespace
}  // namespace navvi_feedback::lessons
