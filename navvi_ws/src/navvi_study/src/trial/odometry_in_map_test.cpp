#include "trial/odometry_in_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_study::trial {
namespace {

const double kPi = std::acos(-1.0);

TEST(OdometryInMap, is_the_odometry_itself_while_nobody_corrects) {
  OdometryInMap places;
  const auto reports = places.take(Odometry{5, {{1.0, 2.0}}});
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].pose.position.x(), 1.0);
  EXPECT_EQ(reports[0].stamp, 5);
}

TEST(OdometryInMap, turns_and_shifts_as_the_correction_says) {
  OdometryInMap places;
  (void)places.take(Correction{Correction::kForGood, {{10.0, 0.0}, kPi / 2}});
  for (const std::int64_t stamp : {1, 100}) {
    const auto reports = places.take(Odometry{stamp, {{1.0, 2.0}}});
    ASSERT_EQ(reports.size(), 1u);
    EXPECT_NEAR(reports[0].pose.position.x(), 8.0, 1e-12);
    EXPECT_NEAR(reports[0].pose.position.y(), 1.0, 1e-12);
  }
}

TEST(OdometryInMap, gives_the_same_places_in_whatever_order_the_two_come) {
  const auto odometry = [](int i) { return Odometry{10 * i, {{1.0 * i, 0.0}}}; };
  const auto correction = [](int i) { return Correction{10 * i, {{0.0, 0.1 * i}}}; };
  std::vector<std::vector<Odometry>> runs;
  for (const int lead : {0, 1, 3, -2}) {  // how far the corrections run ahead
    OdometryInMap places;
    std::vector<Odometry> run = places.take(correction(0));
    const auto add = [&](const std::vector<Odometry>& reports) {
      run.insert(run.end(), reports.begin(), reports.end());
    };
    int told = 0;
    for (int i = 1; i <= 50; ++i) {
      for (; told < i + lead && told < 50; ++told) add(places.take(correction(told + 1)));
      add(places.take(odometry(i)));
    }
    for (; told < 50; ++told) add(places.take(correction(told + 1)));
    runs.push_back(run);
  }
  for (const auto& run : runs) {
    ASSERT_EQ(run.size(), 50u);
    for (std::size_t i = 0; i < run.size(); ++i) {
      EXPECT_EQ(run[i].stamp, runs[0][i].stamp);
      EXPECT_EQ(run[i].pose.position.y(), 0.1 * static_cast<double>(i + 1));
    }
  }
}

TEST(OdometryInMap, goes_on_with_the_last_correction_when_no_more_come) {
  OdometryInMap places;
  (void)places.take(Correction{0, {{0.0, 3.0}}});
  std::size_t count = 0;
  for (int i = 1; i <= 300; ++i)
    for (const auto& report : places.take(Odometry{i, {}})) {
      EXPECT_EQ(report.pose.position.y(), 3.0);
      ++count;
    }
  EXPECT_GE(count, 200u);
}

TEST(OdometryInMap, T1_what_waits_from_before_a_jump_back_holds_up_nothing_after_it) {
  OdometryInMap places;
  (void)places.take(Correction{100, {{0.0, 2.0}}});
  EXPECT_TRUE(places.take(Odometry{110, {}}).empty()) << "it waits for the next correction";
  (void)places.take(Correction{20, {{0.0, 3.0}}});
  const auto reports = places.take(Odometry{10, {}});
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].stamp, 10);
  EXPECT_EQ(reports[0].pose.position.y(), 3.0);
}

TEST(OdometryInMap, lags_little_behind_where_corrections_are_seconds_apart) {
  constexpr std::int64_t kStep = 50'000'000;  // ns
  OdometryInMap places;
  std::int64_t last = 0;
  for (std::int64_t i = 0; i < 400; ++i) {
    if (i % 80 == 0) (void)places.take(Correction{i * kStep, {{0.0, 3.0}}});
    for (const auto& report : places.take(Odometry{i * kStep, {{0.0, 1.0}}})) {
      EXPECT_EQ(report.pose.position.y(), 4.0);
      last = report.stamp;
    }
    EXPECT_LE(i * kStep - last, 200'000'000);
  }
}

}  // namespace
}  // namespace navvi_study::trial
