#include "physics/physics.hpp"

#include <gtest/gtest.h>

namespace navvi_sim::physics {
namespace {

using navvi_types::ThingClass;

const Eigen::Vector3d kPoint = Eigen::Vector3d::Zero();

class Contacts : public testing::Test {
 protected:
  /// Holds thing 1 at `distance` for `seconds`; returns how many contacts began.
  std::size_t hold(double distance, double seconds) {
    std::size_t begun = 0;
    for (int i = 0; i < static_cast<int>(seconds / 0.01 + 0.5); ++i)
      begun += counter_.update({{1, distance, kPoint}}, things_, 0.5, 0.01).size();
    return begun;
  }
  std::vector<ThingClass> things_{ThingClass::other, ThingClass::shelf, ThingClass::worker};
  ContactCounter counter_;
};

TEST_F(Contacts, nothing_near_is_no_contact) {
  EXPECT_TRUE(counter_.update({}, things_, 1.0, 0.01).empty());
  EXPECT_EQ(hold(0.01, 1.0), 0u);
}

TEST_F(Contacts, trembling_at_the_surface_counts_once) {
  EXPECT_EQ(hold(0.0, 1.0), 1u);
  EXPECT_EQ(hold(0.015, 1.0), 0u);
  EXPECT_EQ(hold(-0.001, 1.0), 0u);
}

TEST_F(Contacts, counts_again_only_after_being_apart_long_enough) {
  EXPECT_EQ(hold(0.0, 0.1), 1u);
  EXPECT_EQ(hold(0.03, 0.1), 0u);
  EXPECT_EQ(hold(0.0, 0.1), 0u) << "0.1 s apart are too short";
  EXPECT_EQ(hold(0.03, 0.25), 0u);
  EXPECT_EQ(hold(0.0, 0.1), 1u);
}

TEST_F(Contacts, are_counted_by_class_and_numbered_without_gaps) {
  const auto both = counter_.update({{1, 0.0, kPoint}, {2, 0.0, kPoint}}, things_, 0.7, 0.01);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].seq, 1u);
  EXPECT_EQ(both[1].seq, 2u);
  EXPECT_EQ(both[0].counts.size(), 1u);
  EXPECT_EQ(both[1].counts.at(ThingClass::shelf), 1u);
  EXPECT_EQ(both[1].counts.at(ThingClass::worker), 1u);
  EXPECT_EQ(both[1].speed, 0.7);
}

}  // namespace
}  // namespace navvi_sim::physics
