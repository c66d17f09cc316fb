#include "core/events.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::core {
namespace {

TEST(RumbleEvent, is_a_cue_that_is_felt) {
  const navvi_types::CueEvent event = rumble_event({0.25, 0.5}, std::nullopt, 3);
  EXPECT_EQ(rumble_event({}, haptics::Pattern::hit_shelf, 4).word(), "hit_shelf");
  EXPECT_EQ(event.id, 3U);
  EXPECT_EQ(event.modality(), navvi_types::Modality::rumble);
  EXPECT_EQ(event.stage, navvi_types::CueStage::started);
  EXPECT_EQ(event.left, 0.25);
  EXPECT_EQ(event.right, 0.5);
}

TEST(SoundEvent, is_a_cue_that_tells_what_to_play_again) {
  const sounds::Play play{sounds::Earcon::forklift_near, {1.0, -1.0}, 0.6};
  const navvi_types::CueEvent event = sound_event(play, 7);
  EXPECT_EQ(event.id, 7U);
  EXPECT_EQ(event.word(), "forklift_near");
  EXPECT_EQ(event.modality(), navvi_types::Modality::sound);
  EXPECT_GT(event.right, event.left);
  const auto again = sound_of(event);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->earcon, play.earcon);
  EXPECT_NEAR(again->volume, 0.6, 1e-6);
  EXPECT_TRUE(again->from.isApprox(play.from.normalized(), 1e-6));
  EXPECT_FALSE(sound_of(rumble_event({1.0, 1.0}, haptics::Pattern::arrived, 1)));
}

}  // namespace
}  // namespace navvi_feedback::core
