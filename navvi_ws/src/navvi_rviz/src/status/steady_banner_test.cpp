#include "status/steady_banner.hpp"

#include <gtest/gtest.h>

namespace navvi_rviz::status {
namespace {

Shown with(const char* banner) {
  Shown shown;
  shown.banner = banner;
  shown.tone = *banner ? Shown::Tone::alarm : Shown::Tone::calm;
  return shown;
}

TEST(SteadyBanner, does_not_flash_whatever_trembles) {
  SteadyBanner banner;
  std::string last;
  int appeared = 0;
  for (int tick = 0; tick < 500; ++tick) {  // 10 s at 50 Hz
    const std::string now =
        banner.hold(with(tick % 2 == 0 ? "robot stopped" : ""), 0.02 * tick).banner;
    if (last.empty() && !now.empty()) ++appeared;
    last = now;
  }
  EXPECT_LE(appeared, 3 * 10);
  EXPECT_GE(appeared, 5);
}

TEST(SteadyBanner, shows_what_comes_after_calm_at_once_and_the_rest_as_it_is) {
  SteadyBanner banner;
  Shown shown = with("");
  EXPECT_EQ(banner.hold(shown, 0.0).banner, "");
  EXPECT_EQ(banner.hold(with("wait"), 1.0).banner, "wait");
  shown.instruction = "go on";
  EXPECT_EQ(banner.hold(shown, 1.1).banner, "wait");
  EXPECT_EQ(banner.hold(shown, 1.1).instruction, "go on");
  EXPECT_EQ(banner.hold(shown, 1.4).banner, "");
}

}  // namespace
}  // namespace navvi_rviz::status
