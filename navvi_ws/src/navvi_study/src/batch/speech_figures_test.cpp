#include "batch/speech_figures.hpp"

#include <gtest/gtest.h>

namespace navvi_study::batch {
namespace {

using navvi_types::CueEvent;
using navvi_types::CueKind;
using navvi_types::CueStage;
using navvi_types::Priority;

CueEvent cue(CueStage stage, CueKind kind, const std::string& text) {
  return {1, stage, kind, text, Priority::text};
}

record::Fields after(const SpeechFigures& figures, double duration) {
  record::Fields row;
  figures.add_to(row, duration);
  return row;
}

TEST(SpeechFigures, count_sentences_words_and_the_share_of_the_time) {
  SpeechFigures figures;
  figures.hear(cue(CueStage::queued, CueKind::straight, "drive straight, 2 meters"), false, 0.0);
  figures.hear(cue(CueStage::started, CueKind::straight, "drive straight, 2 meters"), false, 0.0);
  figures.hear(cue(CueStage::ended, CueKind::straight, "drive straight, 2 meters"), false, 1.5);
  figures.hear(cue(CueStage::started, CueKind::go_on, "go on"), false, 9.0);
  figures.hear(cue(CueStage::cut, CueKind::go_on, "go on"), false, 10.5);
  const record::Fields row = after(figures, 30.0);
  EXPECT_DOUBLE_EQ(row.number("cues").value(), 4.0);
  EXPECT_DOUBLE_EQ(row.number("words").value(), 12.0);
  EXPECT_DOUBLE_EQ(row.number("talk").value(), 0.1);
}

TEST(SpeechFigures, count_a_sentence_said_again_too_soon_unless_it_was_asked_for) {
  SpeechFigures figures;
  figures.hear(cue(CueStage::started, CueKind::straight, "straight ahead"), false, 0.0);
  figures.hear(cue(CueStage::started, CueKind::straight, "straight ahead"), true, 5.0);
  figures.hear(cue(CueStage::started, CueKind::straight, "straight ahead"), false, 16.0);
  figures.hear(cue(CueStage::started, CueKind::straight, "straight ahead"), false, 20.0);
  EXPECT_EQ(after(figures, 30.0).get("repeats"), "1");
}

TEST(SpeechFigures, count_a_wait_that_is_followed_before_it_can_be_obeyed) {
  SpeechFigures figures;
  figures.hear(cue(CueStage::started, CueKind::blocked, "wait"), false, 0.0);
  figures.hear(cue(CueStage::started, CueKind::go_on, "go on"), false, 2.5);
  figures.hear(cue(CueStage::started, CueKind::obstacle_stop, "stop"), false, 10.0);
  figures.hear(cue(CueStage::started, CueKind::direction, "1 o'clock"), false, 11.0);
  figures.hear(cue(CueStage::started, CueKind::blocked, "wait"), false, 20.0);
  figures.hear({1, CueStage::started, CueKind::collision_wall, "hit a wall", Priority::important},
               false, 21.0);
  const record::Fields row = after(figures, 30.0);
  EXPECT_EQ(row.get("waits"), "3");
  EXPECT_EQ(row.get("hasty"), "1");
}

TEST(SpeechFigures, count_straight_ahead_said_beside_what_is_ahead) {
  SpeechFigures figures;
  figures.hear(cue(CueStage::started, CueKind::shelf_near, "shelf ahead"), false, 0.0);
  figures.hear(cue(CueStage::started, CueKind::straight, "drive straight, 2 meters"), false, 1.5);
  figures.hear(cue(CueStage::started, CueKind::shelf_near, "shelf on your left"), false, 2.0);
  figures.hear(cue(CueStage::started, CueKind::obstacle_near, "box ahead"), false, 3.0);
  figures.hear(cue(CueStage::started, CueKind::straight, "straight ahead"), false, 5.5);
  EXPECT_EQ(after(figures, 30.0).get("at_odds"), "2");
}

}  // namespace
}  // namespace navvi_study::batch
