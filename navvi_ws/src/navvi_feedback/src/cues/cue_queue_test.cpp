#include "cues/cue_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace navvi_feedback::cues {
namespace {

/// Some words have short names.
Content content_of(const std::string& name) {
  static const std::map<std::string, std::string> names = {
      {"0", "goal_chosen"}, {"1", "goal_sure"},       {"2", "menu_begin"},     {"3", "menu_goals"},
      {"4", "menu_place"},  {"5", "menu_end"},        {"6", "menu_empty"},     {"7", "menu_closed"},
      {"8", "no_trial"},    {"9", "setting"},         {"a", "where"},          {"b", "around"},
      {"c", "no_goal"},     {"d", "where_place"},     {"e", "around_nothing"}, {"f", "goal_info"},
      {"s", "pad_lost"},    {"hit", "collision_wall"}};
  const auto found = names.find(name);
  return *navvi_types::from_word<Content>(found != names.end() ? found->second : name);
}

Cue cue(const std::string& name, Priority priority, double max_age = 2.0) {
  return {content_of(name), "text of " + name, priority, max_age};
}

/// "stage kind" of each event, in order.
std::vector<std::string> told(const CueQueue::Step& step) {
  const std::vector<std::string> stages = {"queued", "started", "ended", "cut", "dropped"};
  std::vector<std::string> words;
  for (const CueEvent& event : step.events)
    words.push_back(stages.at(static_cast<std::size_t>(event.stage)) + " " +
                    event.text.substr(8, event.text.find(',') - 8));
  return words;
}

using Words = std::vector<std::string>;

TEST(CueQueue, says_nothing_without_cues) {
  CueQueue queue;
  const auto step = queue.update({}, false, 0.0);
  EXPECT_TRUE(step.events.empty());
  EXPECT_FALSE(step.stop);
  EXPECT_FALSE(step.start);
  EXPECT_TRUE(queue.empty());
}

TEST(CueQueue, starts_a_cue_at_once_and_ends_it_when_the_speaker_is_done) {
  CueQueue queue;
  const auto first = queue.update({cue("a", Priority::text)}, false, 0.0);
  EXPECT_EQ(told(first), (Words{"queued a", "started a"}));
  EXPECT_EQ(first.start, "text of a");
  EXPECT_TRUE(queue.update({}, true, 0.1).events.empty());
  EXPECT_EQ(told(queue.update({}, false, 0.2)), (Words{"ended a"}));
  EXPECT_TRUE(queue.empty());
}

TEST(CueQueue, ends_all_at_the_shut_down) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::text), cue("b", Priority::text)}, false, 0.0);
  const auto step = queue.clear();
  EXPECT_TRUE(step.stop);
  EXPECT_EQ(told(step), (Words{"cut a", "dropped b"}));
  EXPECT_TRUE(queue.empty());
}

Cue answer(const std::string& name) {
  Cue asked = cue(name, Priority::message);
  asked.asked = true;
  return asked;
}
/// It ends a wait.
Cue on(const std::string& name) {
  Cue ends = cue(name, Priority::message);
  ends.goes_on = true;
  return ends;
}
Cue text(const std::string& name, double max_age = 2.0) {
  return cue(name, Priority::text, max_age);
}
Cue message(const std::string& name) { return cue(name, Priority::message); }
Cue important(const std::string& name) { return cue(name, Priority::important); }

/// What comes 0.1 s after the step before, and what is told of it.
struct Beat {
  std::vector<Cue> fresh;
  Words told;
  bool speaks = true;  ///< the speaker is still busy
  double after = 0.1;  ///< s
};
struct Row {
  const char* rule;
  std::vector<Cue> first;
  std::vector<Beat> then;
};

const std::vector<Row> kRules = {
    {"a word to stop cuts words", {message("a"), message("b")},
     {{{message("blocked")}, {"queued blocked", "cut a", "started blocked"}},
      {{message("blocked")}, {"queued blocked"}}}},  // it does not cut itself
    {"a word to stop cuts an answer", {answer("a"), message("b")},
     {{{message("blocked")}, {"queued blocked", "cut a", "started blocked"}}}},
    {"a word to stop waits for an important one", {important("s")},
     {{{message("blocked")}, {"queued blocked"}}}},
    {"a higher priority cuts a lower one", {text("a")},
     {{{message("b")}, {"queued b", "cut a", "started b"}}}},
    {"an equal one never cuts", {text("a")},
     {{{text("b")}, {"queued b"}}, {{}, {"ended a", "started b"}, false}}},
    {"an important one is never cut", {important("a")},
     {{{important("b"), message("c")}, {"queued b", "queued c"}}}},
    {"ways that wait are dropped for a word to stop", {important("hit")},
     {{{text("direction"), text("welcome")}, {"queued direction", "queued welcome"}},
      {{important("obstacle_stop")}, {"queued obstacle_stop", "dropped direction"}}}},
    {"what ends a wait is kept and said before its equals", {important("hit")},
     {{{message("a"), message("b")}, {"queued a", "queued b"}},
      {{on("straight")}, {"queued straight", "dropped b"}},
      {{}, {"ended hit", "started straight"}, false}}},
    {"no way is said that waited behind what ends a wait and was cut", {on("make_room")},
     {{{text("direction", 9.0)}, {"queued direction"}},
      {{important("s")}, {"queued s", "cut make_room", "dropped direction", "started s"}}}},
    {"no way is said that waited behind what ends a wait and was dropped", {important("hit")},
     {{{on("make_room")}, {"queued make_room"}},
      {{text("direction", 9.0)}, {"queued direction"}},
      {{important("s")}, {"dropped make_room", "dropped direction", "queued s"}, true, 2.0}}},
    {"what ends a wait is replaced only by what ends it too",
     {important("hit"), on("direction")},
     {{{text("direction")}, {"queued direction", "dropped direction"}},
      {{on("direction")}, {"queued direction", "dropped direction"}},
      {{}, {"ended hit", "started direction"}, false}}},
    {"that a goal is seen does not wait beside that it is not", {important("hit")},
     {{{text("goal_seen")}, {"queued goal_seen"}},
      {{text("toward_goal")}, {"queued toward_goal", "dropped goal_seen"}}}},
    {"an answer comes at once, before all but safety, to the last question alone",
     {message("a"), message("b")},
     {{{answer("c")}, {"queued c", "cut a", "started c"}},
      {{answer("d")}, {"queued d", "cut c", "started d"}},
      {{important("s")}, {"queued s", "cut d", "started s"}},
      {{answer("e")}, {"queued e"}},
      {{answer("f")}, {"queued f", "dropped e"}},
      {{}, {"ended s", "started f"}, false}}},
    {"a newer one of its kind replaces what waits", {important("a")},
     {{{text("b")}, {"queued b"}}, {{text("b")}, {"queued b", "dropped b"}}}},
    {"that a device is back is dropped once it is lost again", {important("keyboard_lost")},
     {{{message("keyboard_back")}, {"queued keyboard_back"}},
      {{important("keyboard_lost")}, {"queued keyboard_lost", "dropped keyboard_back"}}}},
    {"that the connection is back is dropped once it is lost again", {important("connection_lost")},
     {{{message("connection_back")}, {"queued connection_back"}},
      {{important("connection_lost")}, {"queued connection_lost", "dropped connection_back"}}}},
    {"two wait at most below important, the greatest", {important("a")},
     {{{cue("b", Priority::notification), text("c")}, {"queued b", "queued c"}},
      {{message("d")}, {"queued d", "dropped b"}},
      {{important("e")}, {"queued e"}}}}};

TEST(CueQueue, says_drops_and_cuts_by_the_rules_of_the_table) {
  for (const Row& row : kRules) {
    SCOPED_TRACE(row.rule);
    CueQueue queue;
    (void)queue.update(row.first, false, 0.0);
    double time = 0.0;
    for (const Beat& beat : row.then) {
      time += beat.after;
      const auto step = queue.update(beat.fresh, beat.speaks, time);
      EXPECT_EQ(told(step), beat.told);
      const auto cut = [](const CueEvent& event) { return event.stage == CueStage::cut; };
      EXPECT_EQ(step.stop, std::any_of(step.events.begin(), step.events.end(), cut));
    }
  }
}

TEST(CueQueue, F5_of_a_hundred_texts_at_once_says_the_newest_after_what_is_important) {
  CueQueue queue;
  (void)queue.update({text("a")}, false, 0.0);
  std::vector<Cue> burst(100, text("b"));
  for (std::size_t i = 0; i < burst.size(); ++i) burst[i].text = std::to_string(i);
  burst.insert(burst.begin() + 50, important("hit"));
  const auto step = queue.update(burst, true, 0.1);
  EXPECT_TRUE(step.stop);
  EXPECT_EQ(step.start, "text of hit");
  EXPECT_EQ(std::count_if(step.events.begin(), step.events.end(),
                          [](const CueEvent& event) { return event.stage == CueStage::dropped; }),
            99);
  EXPECT_EQ(queue.update({}, false, 0.5).start, "99");
  (void)queue.update({}, false, 1.0);
  EXPECT_TRUE(queue.empty());
}

TEST(CueQueue, F5_drops_what_waited_too_long) {
  CueQueue queue;
  (void)queue.update({important("a")}, false, 0.0);
  (void)queue.update({text("b", 1.0)}, true, 0.1);
  EXPECT_EQ(told(queue.update({}, false, 1.2)), (Words{"ended a", "dropped b"}));
}

TEST(CueQueue, keeps_important_cues_of_one_kind_that_say_different_things) {
  CueQueue queue;
  Cue box = important("hit");
  Cue shelf = box;
  shelf.text = "text of hit, another";
  EXPECT_EQ(told(queue.update({box, shelf, shelf}, false, 0.0)),
            (Words{"queued hit", "queued hit", "queued hit", "dropped hit", "started hit"}));
  EXPECT_EQ(queue.update({}, false, 0.5).start, "text of hit, another");
}

/// A speaker that takes some ticks for each text.
struct FakeSpeaker {
  int left = 0;

  void apply(const CueQueue::Step& step, int ticks) {
    if (step.stop) left = 0;
    if (step.start) left = ticks;
  }
};

/// Follows the life of every cue and complains about what must not be.
class Witness {
 public:
  void see(const CueEvent& event) {
    const auto known = stages_.find(event.id);
    if (event.stage == CueStage::queued) {
      ASSERT_EQ(known, stages_.end());
      ASSERT_EQ(event.id, stages_.size() + 1) << "ids have no gaps";
      stages_[event.id] = event.stage;
      return;
    }
    ASSERT_NE(known, stages_.end());
    const bool runs = known->second == CueStage::started;
    if (event.stage == CueStage::started) {
      ASSERT_EQ(known->second, CueStage::queued);
      ASSERT_FALSE(running_) << "two at a time";
      if (cut_) {
        ASSERT_GT(event.priority, *cut_) << "cut by a lesser one";
      }
      running_ = event;
    } else if (event.stage == CueStage::dropped) {
      ASSERT_EQ(known->second, CueStage::queued);
    } else {
      ASSERT_TRUE(runs);
      if (event.stage == CueStage::cut) {
        ASSERT_NE(event.priority, Priority::important);
        cut_ = event.priority;
      }
      running_.reset();
    }
    known->second = event.stage;
  }

  void next_step() {
    ASSERT_FALSE(cut_ && !running_) << "cut for nothing";
    cut_.reset();
    std::size_t waiting = 0;
    for (const auto& [id, stage] : stages_) waiting += stage == CueStage::queued ? 1 : 0;
    ASSERT_LE(waiting, 2U + 2U) << "two, and the important kinds";
  }

  [[nodiscard]] bool all_over() const {
    for (const auto& [id, stage] : stages_)
      if (stage == CueStage::queued || stage == CueStage::started) return false;
    return true;
  }

 private:
  std::map<std::uint32_t, CueStage> stages_;
  std::optional<CueEvent> running_;
  std::optional<Priority> cut_;
};

TEST(CueQueue, loses_no_cue_in_any_sequence) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    CueQueue queue;
    FakeSpeaker speaker;
    Witness witness;
    const auto apply = [&](const CueQueue::Step& step) {
      for (const CueEvent& event : step.events) witness.see(event);
      speaker.apply(step, 1 + draw(40));
    };
    double time = 0.0;
    for (int tick = 0; tick < 500; ++tick, time += 0.02) {
      std::vector<Cue> fresh;
      for (int i = draw(3) == 0 ? draw(4) : 0; i > 0; --i) {
        const int kind = draw(10);  // two kinds of each priority
        fresh.push_back(cue(std::to_string(kind), static_cast<Priority>(kind / 2), draw(3)));
      }
      if (speaker.left > 0) --speaker.left;
      apply(queue.update(fresh, speaker.left > 0, time));
      witness.next_step();
      if (HasFatalFailure()) FAIL() << "seed " << seed << ", tick " << tick;
    }
    for (int tick = 0; tick < 1000 && !queue.empty(); ++tick, time += 0.02) {
      if (speaker.left > 0) --speaker.left;
      apply(queue.update({}, speaker.left > 0, time));
    }
    ASSERT_TRUE(witness.all_over()) << "seed " << seed;
  }
}

CueEvent event(std::uint32_t id, CueStage stage) {
  CueEvent event;
  event.id = id;
  event.stage = stage;
  return event;
}

/// \return the stages of these that count as heard, in order
std::vector<CueStage> stages(HeardWords& words, const std::vector<CueEvent>& events, bool hears,
                             bool heard = true) {
  std::vector<CueStage> result;
  for (const CueEvent& event : words.of(events, hears, heard)) result.push_back(event.stage);
  return result;
}

TEST(HeardWordsTest, are_those_that_start_while_somebody_hears_and_no_others) {
  using Stages = std::vector<CueStage>;
  HeardWords words;
  EXPECT_EQ(stages(words, {event(1, CueStage::queued), event(1, CueStage::started)}, true),
            (Stages{CueStage::queued, CueStage::started}));
  EXPECT_EQ(stages(words, {event(1, CueStage::ended)}, true), Stages{CueStage::ended});
  EXPECT_EQ(stages(words, {event(2, CueStage::started)}, false), Stages{CueStage::dropped});
  EXPECT_EQ(stages(words, {event(2, CueStage::ended)}, true), Stages{})
      << "the device is back before the words end, but nobody heard how they began";
  EXPECT_EQ(stages(words, {event(3, CueStage::started)}, true), Stages{CueStage::started});
  EXPECT_EQ(stages(words, {event(3, CueStage::ended), event(4, CueStage::started)}, true, false),
            (Stages{CueStage::cut, CueStage::started}))
      << "a device that was lost and is back, or a voice: the next words are heard";
}

}  // namespace
}  // namespace navvi_feedback::cues
