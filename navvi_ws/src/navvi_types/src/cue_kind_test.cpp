#include "navvi_types/cue_kind.hpp"

#include <gtest/gtest.h>

#include <set>

namespace navvi_types {
namespace {

TEST(Content, has_a_word_of_its_own_that_leads_back_to_it) {
  std::set<std::string> words;
  for (const Content& content : contents()) {
    EXPECT_TRUE(words.insert(to_string(content)).second) << to_string(content);
    EXPECT_EQ(from_word<Content>(to_string(content)), content) << to_string(content);
  }
  for (const char* word : {"collision_shelf", "wall_near", "no_route", "start", "start_distance",
                           "straight_then", "where_goal", "way_blocked", "goal_chosen", "no_goal"})
    EXPECT_EQ(words.count(word), 1U) << word;
  EXPECT_EQ(from_word<Content>("near"), Content(CueKind::near)) << "all that may be near";
  for (const char* word : {"", "*", "none", "shelf", "menu_shelf", "shelf_stuck"})
    EXPECT_FALSE(from_word<Content>(word)) << word;
}

TEST(Content, is_another_where_it_is_about_another_thing_but_of_the_same_kind) {
  const Content shelf(CueKind::near, About::shelf), wall(CueKind::near, About::wall);
  EXPECT_NE(shelf, wall);
  EXPECT_TRUE(shelf < wall && !(wall < shelf));
  EXPECT_TRUE(shelf == CueKind::near && wall == CueKind::near && shelf != CueKind::close);
}

}  // namespace
}  // namespace navvi_types
