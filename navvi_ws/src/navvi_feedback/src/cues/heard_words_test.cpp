#include "cues/heard_words.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::cues {
namespace {

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
