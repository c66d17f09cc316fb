#include "cues/collision_cues.hpp"

#include <gtest/gtest.h>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

class CollisionCuesTest : public CuePolicyTest {};

TEST_F(CollisionCuesTest, says_what_was_hit_and_where_and_then_the_way_on) {
  under_way();
  now_.contacts = {{ThingClass::shelf, {0.0, 0.35}}};
  EXPECT_EQ(pass(0.1), Texts{"hit a shelf on your left"});
  EXPECT_EQ(last_.priority, Priority::important);
  EXPECT_EQ(Content(last_), Content(CueKind::collision, About::shelf));
  EXPECT_EQ(pass(2.0), Texts{"drive straight, 20 meters"});
  now_.contacts = {{ThingClass::forklift, {0.35, 0.0}}};
  EXPECT_EQ(pass(0.1), Texts{"hit a forklift ahead"});
}

TEST_F(CollisionCuesTest, says_every_thing_that_is_hit_but_the_same_only_once_in_a_while) {
  under_way();
  now_.contacts = {{ThingClass::box, {0.35, 0.0}, 4}, {ThingClass::pedestal, {0.0, -0.35}, 5}};
  EXPECT_EQ(pass(0.5), (Texts{"hit a box ahead", "hit a pedestal on your right"}));
  now_.contacts = {{ThingClass::box, {0.35, 0.0}, 4}, {ThingClass::box, {0.0, 0.35}, 6}};
  EXPECT_EQ(pass(0.5), Texts{"hit a box on your left"});
  pass(3.0);
  now_.contacts = {{ThingClass::box, {0.35, 0.0}, 4}};
  EXPECT_EQ(pass(0.1), Texts{"hit again, box ahead"});
}

}  // namespace
}  // namespace navvi_feedback::cues
