#include "search/search_node.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace navvi_nav::search {
namespace {

TEST(OpenList, gives_the_least_key_first_in_whatever_order_things_come_and_go) {
  std::mt19937 random(1);
  OpenList<unsigned, int> open;
  std::multiset<unsigned> kept;
  for (int i = 0; i < 3000; ++i) {
    if (random() % 5 < (i < 1500 ? 3U : 2U)) {
      const auto key = static_cast<unsigned>(random() % 500U);
      kept.insert(key);
      open.push(key, static_cast<int>(key) + 7);
    } else if (!open.empty()) {
      const auto [key, item] = open.pop();
      ASSERT_EQ(key, *kept.begin());
      ASSERT_EQ(item, static_cast<int>(key) + 7);
      kept.erase(kept.begin());
    }
    ASSERT_EQ(open.empty(), kept.empty());
  }
}

TEST(OpenList, is_empty_when_cleared) {
  OpenList<double, int> open;
  for (int i = 0; i < 3; ++i) open.push(i, i);
  open.clear();
  EXPECT_TRUE(open.empty());
}

}  // namespace
}  // namespace navvi_nav::search
