#include "cues/cue_queue.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace navvi_feedback::cues {
namespace {

/// Some words have short names.
Content content_of(const std::string& name) {
  static const std::map<std::string, std::string> names = {
      {"0", "goal_chosen"}, {"1", "goal_sure"},   {"2", "menu_begin"}, {"3", "menu_goals"},
      {"4", "menu_place"},  {"5", "menu_end"},    {"6", "menu_empty"}, {"7", "menu_closed"},
      {"8", "no_trial"},    {"9", "setting"},     {"a", "where"},      {"b", "around"},
      {"c", "no_goal"},     {"d", "help_pad"},    {"e", "help_keys"},  {"f", "goal_info"},
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

TEST(CueQueue, lets_a_word_to_stop_wait_for_nothing_but_an_important_one) {
  for (const bool asked : {false, true}) {
    CueQueue queue;
    Cue answer = cue("a", Priority::message);
    answer.asked = asked;
    (void)queue.update({answer, cue("b", Priority::message)}, false, 0.0);
    const auto step = queue.update({cue("blocked", Priority::message)}, true, 0.1);
    EXPECT_EQ(told(step), (Words{"queued blocked", "cut a", "started blocked"}));
    EXPECT_EQ(told(queue.update({cue("blocked", Priority::message)}, true, 0.2)),
              Words{"queued blocked"})
        << "it does not cut itself";
  }
  CueQueue queue;
  (void)queue.update({cue("s", Priority::important)}, false, 0.0);
  EXPECT_EQ(told(queue.update({cue("blocked", Priority::message)}, true, 0.1)),
            Words{"queued blocked"});
}

TEST(CueQueue, lets_a_higher_priority_cut_a_lower_one) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::text)}, false, 0.0);
  const auto step = queue.update({cue("b", Priority::message)}, true, 0.1);
  EXPECT_EQ(told(step), (Words{"queued b", "cut a", "started b"}));
  EXPECT_TRUE(step.stop);
  EXPECT_EQ(step.start, "text of b");
}

TEST(CueQueue, drops_the_ways_that_wait_for_a_word_to_stop) {
  CueQueue queue;
  (void)queue.update({cue("hit", Priority::important)}, false, 0.0);
  (void)queue.update({cue("direction", Priority::text), cue("welcome", Priority::text)}, true, 0.1);
  EXPECT_EQ(told(queue.update({cue("obstacle_stop", Priority::important)}, true, 0.2)),
            (Words{"queued obstacle_stop", "dropped direction"}));
}

TEST(CueQueue, keeps_what_ends_a_wait_and_says_it_before_its_equals) {
  CueQueue queue;
  Cue on = cue("straight", Priority::message);
  on.goes_on = true;
  (void)queue.update({cue("hit", Priority::important)}, false, 0.0);
  (void)queue.update({cue("a", Priority::message), cue("b", Priority::message)}, true, 0.1);
  EXPECT_EQ(told(queue.update({on}, true, 0.2)), (Words{"queued straight", "dropped b"}));
  EXPECT_EQ(told(queue.update({}, false, 0.3)), (Words{"ended hit", "started straight"}));
}

TEST(CueQueue, says_no_way_that_waited_behind_what_ends_a_wait_and_was_not_heard) {
  for (const bool cut : {false, true}) {
    CueQueue queue;
    Cue on = cue("make_room", Priority::message);
    on.goes_on = true;
    if (!cut) (void)queue.update({cue("hit", Priority::important)}, false, 0.0);
    (void)queue.update({on}, !cut, 0.1);
    (void)queue.update({cue("direction", Priority::text, 9.0)}, true, 0.2);
    const auto step = queue.update({cue("s", Priority::important)}, true, cut ? 0.3 : 2.2);
    EXPECT_EQ(told(step),
              cut ? (Words{"queued s", "cut make_room", "dropped direction", "started s"})
                  : (Words{"dropped make_room", "dropped direction", "queued s"}));
  }
}

TEST(CueQueue, replaces_what_ends_a_wait_only_by_what_ends_it_too) {
  CueQueue queue;
  Cue on = cue("direction", Priority::message);
  on.goes_on = true;
  (void)queue.update({cue("hit", Priority::important), on}, false, 0.0);
  EXPECT_EQ(told(queue.update({cue("direction", Priority::text)}, true, 0.1)),
            (Words{"queued direction", "dropped direction"}));
  EXPECT_EQ(told(queue.update({on}, true, 0.2)), (Words{"queued direction", "dropped direction"}));
  EXPECT_EQ(told(queue.update({}, false, 0.3)), (Words{"ended hit", "started direction"}));
}

TEST(CueQueue, never_waits_to_say_both_that_a_goal_is_seen_and_that_it_is_not) {
  CueQueue queue;
  (void)queue.update({cue("hit", Priority::important)}, false, 0.0);
  (void)queue.update({cue("goal_seen", Priority::text)}, true, 0.1);
  EXPECT_EQ(told(queue.update({cue("toward_goal", Priority::text)}, true, 0.2)),
            (Words{"queued toward_goal", "dropped goal_seen"}));
}

TEST(CueQueue, answers_at_once_whatever_but_safety_is_spoken_and_only_the_last_question) {
  const auto answer = [](const std::string& kind) {
    Cue asked = cue(kind, Priority::message);
    asked.asked = true;
    return asked;
  };
  CueQueue queue;
  (void)queue.update({cue("a", Priority::message), cue("b", Priority::message)}, false, 0.0);
  EXPECT_EQ(told(queue.update({answer("c")}, true, 0.1)),
            (Words{"queued c", "cut a", "started c"}));
  EXPECT_EQ(told(queue.update({answer("d")}, true, 0.2)),
            (Words{"queued d", "cut c", "started d"}));
  EXPECT_EQ(told(queue.update({cue("s", Priority::important)}, true, 0.3)),
            (Words{"queued s", "cut d", "started s"}));
  EXPECT_EQ(told(queue.update({answer("e")}, true, 0.4)), (Words{"queued e"}));
  EXPECT_EQ(told(queue.update({answer("f")}, true, 0.5)), (Words{"queued f", "dropped e"}));
  EXPECT_EQ(told(queue.update({}, false, 0.6)), (Words{"ended s", "started f"}));
}

TEST(CueQueue, never_lets_an_equal_one_cut) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::text)}, false, 0.0);
  EXPECT_EQ(told(queue.update({cue("b", Priority::text)}, true, 0.1)), (Words{"queued b"}));
  EXPECT_EQ(told(queue.update({}, false, 0.2)), (Words{"ended a", "started b"}));
}

TEST(CueQueue, never_cuts_an_important_one) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::important)}, false, 0.0);
  EXPECT_EQ(
      told(queue.update({cue("b", Priority::important), cue("c", Priority::message)}, true, 0.1)),
      (Words{"queued b", "queued c"}));
}

TEST(CueQueue, F5_drops_what_waited_too_long) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::important)}, false, 0.0);
  (void)queue.update({cue("b", Priority::text, 1.0)}, true, 0.1);
  EXPECT_EQ(told(queue.update({}, false, 1.2)), (Words{"ended a", "dropped b"}));
}

TEST(CueQueue, replaces_a_waiting_cue_by_a_newer_of_its_kind) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::important)}, false, 0.0);
  (void)queue.update({cue("b", Priority::text)}, true, 0.1);
  EXPECT_EQ(told(queue.update({cue("b", Priority::text)}, true, 0.2)),
            (Words{"queued b", "dropped b"}));
}

TEST(CueQueue, drops_that_a_device_is_back_once_it_is_lost_again) {
  CueQueue queue;
  (void)queue.update({cue("keyboard_lost", Priority::important)}, false, 0.0);
  EXPECT_EQ(told(queue.update({cue("keyboard_back", Priority::message)}, true, 0.1)),
            (Words{"queued keyboard_back"}));
  EXPECT_EQ(told(queue.update({cue("keyboard_lost", Priority::important)}, true, 0.2)),
            (Words{"queued keyboard_lost", "dropped keyboard_back"}));
}

TEST(CueQueue, keeps_important_cues_of_one_kind_that_say_different_things) {
  CueQueue queue;
  Cue box = cue("hit", Priority::important);
  Cue shelf = box;
  shelf.text = "text of hit, another";
  EXPECT_EQ(told(queue.update({box, shelf, shelf}, false, 0.0)),
            (Words{"queued hit", "queued hit", "queued hit", "dropped hit", "started hit"}));
  EXPECT_EQ(queue.update({}, false, 0.5).start, "text of hit, another");
}

TEST(CueQueue, keeps_at_most_two_waiting_below_important_and_the_greatest_of_them) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::important)}, false, 0.0);
  (void)queue.update({cue("b", Priority::notification), cue("c", Priority::text)}, true, 0.1);
  EXPECT_EQ(told(queue.update({cue("d", Priority::message)}, true, 0.2)),
            (Words{"queued d", "dropped b"}));
  EXPECT_EQ(told(queue.update({cue("e", Priority::important)}, true, 0.3)), (Words{"queued e"}));
}

TEST(CueQueue, ends_all_at_the_shut_down) {
  CueQueue queue;
  (void)queue.update({cue("a", Priority::text), cue("b", Priority::text)}, false, 0.0);
  const auto step = queue.clear();
  EXPECT_TRUE(step.stop);
  EXPECT_EQ(told(step), (Words{"cut a", "dropped b"}));
  EXPECT_TRUE(queue.empty());
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

std::vector<CueStage> stages(const std::vector<CueEvent>& events) {
  std::vector<CueStage> result;
  for (const CueEvent& event : events) result.push_back(event.stage);
  return result;
}

TEST(HeardWordsTest, are_those_that_start_while_somebody_hears) {
  HeardWords words;
  EXPECT_EQ(stages(words.of({event(1, CueStage::queued), event(1, CueStage::started)}, true)),
            (std::vector<CueStage>{CueStage::queued, CueStage::started}));
  EXPECT_EQ(stages(words.of({event(1, CueStage::ended)}, true)),
            std::vector<CueStage>{CueStage::ended});
}

TEST(HeardWordsTest, leave_out_what_began_without_a_device) {
  HeardWords words;
  EXPECT_EQ(stages(words.of({event(1, CueStage::started)}, false)),
            std::vector<CueStage>{CueStage::dropped});
  // The device is back before the words end; nobody heard how they began.
  EXPECT_TRUE(words.of({event(1, CueStage::ended)}, true).empty());
  EXPECT_EQ(stages(words.of({event(2, CueStage::started)}, true)),
            std::vector<CueStage>{CueStage::started});
}

}  // namespace
}  // namespace navvi_feedback::cues
