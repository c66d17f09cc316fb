#include "cues/near_words.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::cues {
namespace {

TEST(InsteadOf, is_a_sound_for_what_is_near_where_its_family_is_heard) {
  const Utterance shelf{{CueKind::close, About::wall}, {{}, {}, ThingClass::wall, Side::left}};
  const Utterance worker{{CueKind::near, About::obstacle},
                         {{}, {}, ThingClass::worker, Side::right}};
  const Utterance stop{CueKind::obstacle_stop, {{}, {}, ThingClass::worker, Side::ahead}};
  const Sounds all{true, true};
  EXPECT_FALSE(instead_of(shelf, {false, true}));
  EXPECT_FALSE(instead_of(worker, {true, false}));
  EXPECT_FALSE(instead_of(stop, all));
  EXPECT_EQ(instead_of(shelf, all).value().earcon, sounds::Earcon::shelf_close);
  EXPECT_GT(instead_of(shelf, all).value().from.y(), 0.9);
  EXPECT_EQ(instead_of(worker, all).value().earcon, sounds::Earcon::worker_near);
  EXPECT_LT(instead_of(worker, all).value().from.y(), -0.9);
}

TEST(InsteadOf, sounds_stand_for_what_is_near_and_for_no_other_words) {
  const Sounds all{true, true};
  for (const Content& content : navvi_types::contents()) {
    Utterance told{content};
    told.fillings.thing = ThingClass::shelf;
    told.fillings.side = Side::left;
    EXPECT_EQ(instead_of(told, all).has_value(), is_near(content.kind)) << to_string(content);
  }
  EXPECT_FALSE(instead_of({CueKind::menu_closed}, all)) << "a menu is not a thing";
}

}  // namespace
}  // namespace navvi_feedback::cues
