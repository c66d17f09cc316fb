#include <gtest/gtest.h>

#include <cmath>

#include "description/validate.hpp"
#include "sdf_folder.hpp"
#include "traffic/lanes.hpp"

namespace navvi_sim::read {
namespace {

struct At {
  double time;
  double x;
  double y;
};

std::string trajectory(int id, const std::vector<At>& points) {
  std::string text = "<trajectory id='" + std::to_string(id) + "' type='walking'>";
  for (const At& point : points)
    text += "<waypoint><time>" + std::to_string(point.time) + "</time><pose>" +
            std::to_string(point.x) + " " + std::to_string(point.y) +
            " 1.0 0 0 0</pose></waypoint>";
  return text + "</trajectory>";
}

class SdfMotionTest : public SdfFolder {
 protected:
  LoadedWorld with_actor(const std::string& script, const std::string& more = "") const {
    return load(
        "<model name='ground'><pose>0 0 0.5 0 0 0</pose><link name='l'><collision "
        "name='c'><geometry><box><size>40 40 0.2</size></box></geometry></collision>"
        "</link></model>\n<actor name='ann'><skin><filename>walk.dae</filename></skin>"
        "<animation name='walking'><filename>walk.dae</filename></animation>" +
        (script.empty() ? "" : "<script>" + script + "</script>") + more + "</actor>");
  }
  static Thing ann(const LoadedWorld& loaded) {
    const Thing* thing = thing_named(loaded.world, "ann");
    return thing == nullptr ? Thing{} : *thing;
  }
};

TEST_F(SdfMotionTest, of_an_actor_that_gazebo_saved_is_that_of_a_person) {
  const LoadedWorld loaded =
      with_actor("",
                 "<link name='hip'><collision name='c'><geometry><sphere><radius>0.02</radius>"
                 "</sphere></geometry></collision></link>");
  EXPECT_NEAR(bounds(ann(loaded)).max().z() - loaded.world.floor_height, 1.75, 0.01);
  EXPECT_TRUE(has_note(loaded, {"bones of 'ann'"}));
}

TEST_F(SdfMotionTest, of_an_actor_is_a_worker_who_walks_its_way_points_in_its_times) {
  const LoadedWorld loaded =
      with_actor("<loop>true</loop><delay_start>2.5</delay_start>" +
                 trajectory(0, {{0, 1, 2}, {2, 5, 2}, {5, 5, 2}, {9, 5, 4}, {13, 1, 2}}));
  const Thing worker = ann(loaded);
  EXPECT_EQ(worker.thing_class, ThingClass::worker);
  ASSERT_TRUE(worker.route.has_value());
  const Route& route = *worker.route;
  EXPECT_TRUE(route.loop);
  EXPECT_EQ(route.delay, 2.5);
  ASSERT_EQ(route.waypoints.size(), 3U) << "the last is the first";
  EXPECT_NEAR(route.waypoints[1].speed, 2.0, 1e-9);
  EXPECT_NEAR(route.waypoints[1].pause, 3.0, 1e-9);
  EXPECT_NEAR(route.waypoints[2].speed, 0.5, 1e-9);
  EXPECT_NEAR(route.waypoints[0].speed, std::hypot(4.0, 2.0) / 4.0, 1e-9);
  EXPECT_EQ(route.waypoints[0].pause, 0.0);
  EXPECT_LT((worker.pose.translation() - Eigen::Vector3d(1, 2, 0.6)).norm(), 1e-9)
      << "it stands on the floor";
  EXPECT_NEAR(bounds(worker).max().z(), 0.6 + 1.75, 1e-9);
  EXPECT_TRUE(has_note(loaded, {"<skin>", "<animation>", "line 2"}));
  EXPECT_NO_THROW(validate(loaded.world));
}

TEST_F(SdfMotionTest, of_an_actor_without_loop_ends_at_its_last_way_point) {
  const Thing worker =
      ann(with_actor("<loop>false</loop>" + trajectory(0, {{0, 0, 0}, {4, 4, 0}, {6, 4, 1}})));
  ASSERT_TRUE(worker.route.has_value());
  EXPECT_FALSE(worker.route->loop);
  EXPECT_EQ(worker.route->waypoints.size(), 3U);
}

TEST_F(SdfMotionTest, of_an_actor_that_gazebo_lets_jump_is_told) {
  const LoadedWorld loaded = with_actor(trajectory(0, {{0, 0, 0}, {4, 4, 0}}));
  EXPECT_EQ(ann(loaded).route.value().waypoints.size(), 2U);
  EXPECT_TRUE(has_note(loaded, {"ann", "line 2", "jumps back"}));
}

TEST_F(SdfMotionTest, takes_trajectories_in_the_order_of_their_ids) {
  const LoadedWorld loaded =
      with_actor("<loop>false</loop>" + trajectory(1, {{0, 4, 0}, {2, 4, 4}}) +
                 trajectory(0, {{3, 0, 0}, {4, 4, 0}}));
  const Route route = ann(loaded).route.value();
  ASSERT_EQ(route.waypoints.size(), 3U);
  EXPECT_LT(route.waypoints[0].at.norm(), 1e-9);
  EXPECT_NEAR(route.waypoints[1].speed, 1.0, 1e-9) << "the first way-point counts from 0 s";
  EXPECT_NEAR(route.waypoints[2].speed, 2.0, 1e-9);
}

TEST_F(SdfMotionTest, of_an_actor_that_waits_or_has_no_way_is_none) {
  const LoadedWorld waits =
      with_actor("<auto_start>false</auto_start>" + trajectory(0, {{0, 3, 0}, {4, 4, 0}}));
  EXPECT_FALSE(ann(waits).route.has_value());
  EXPECT_NEAR(ann(waits).pose.translation().x(), 3.0, 1e-9);
  EXPECT_TRUE(has_note(waits, {"ann", "waits"}));
  for (const std::string& script :
       {std::string(), std::string("<loop>1</loop>"), trajectory(0, {}), trajectory(0, {{0, 2, 0}}),
        trajectory(0, {{0, 2, 0}, {5, 2, 0}})}) {
    const LoadedWorld loaded = with_actor(script, "<pose>2 0 1 0 0 0</pose>");
    EXPECT_FALSE(ann(loaded).route.has_value()) << script;
    EXPECT_NEAR(ann(loaded).pose.translation().x(), 2.0, 1e-9) << script;
  }
}

TEST_F(SdfMotionTest, is_never_faster_than_the_simulator_lets_it_be) {
  const LoadedWorld loaded =
      with_actor("<loop>false</loop>" + trajectory(0, {{0, 0, 0}, {1, 10, 0}}));
  EXPECT_EQ(ann(loaded).route.value().waypoints[1].speed, WorldLimits::speed);
  EXPECT_TRUE(has_note(loaded, {"ann", "faster than 5 m/s"}));
}

TEST_F(SdfMotionTest, of_an_actor_with_bodies_and_no_skin_keeps_them) {
  const LoadedWorld loaded =
      load(ground_ + "<actor name='ann'><script>" + trajectory(0, {{0, 0, 0}, {4, 4, 0}}) +
           "</script><link name='body'><collision name='c'><geometry><box><size>1 1 1</size></box>"
           "</geometry></collision></link></actor>");
  ASSERT_EQ(ann(loaded).shapes.size(), 1U);
  EXPECT_NEAR(bounds(ann(loaded)).center().z(), 1.0, 1e-9) << "at the height of its trajectory";
}

TEST_F(SdfMotionTest, through_what_stands_is_none_and_is_told) {
  const auto walker = [](const std::string& name, const std::string& y) {
    return "\n<actor name='" + name +
           "'><script><trajectory id='0' type='w'><waypoint><time>0</time>"
           "<pose>-5 " +
           y + " 1 0 0 0</pose></waypoint><waypoint><time>10</time><pose>5 " + y +
           " 1 0 0 0</pose></waypoint></trajectory></script></actor>";
  };
  const LoadedWorld loaded =
      load(ground_ + model("crate", "<box><size>1 1 1</size></box>", "0 0 0.5 0 0 0") +
           walker("ghost", "0") + walker("ann", "3") + walker("bob", "-3"));
  const Thing* ghost = thing_named(loaded.world, "ghost");
  EXPECT_FALSE(ghost->route.has_value());
  EXPECT_NEAR(ghost->pose.translation().x(), -5.0, 1e-9);
  EXPECT_TRUE(has_note(loaded, {"line 2", "ghost", "crate"}));
  EXPECT_TRUE(thing_named(loaded.world, "ann")->route.has_value());
  EXPECT_TRUE(thing_named(loaded.world, "bob")->route.has_value());
  EXPECT_NO_THROW(static_cast<void>(traffic::lay_lanes(loaded.world, {})));
}

TEST_F(SdfMotionTest, with_odd_numbers_is_refused) {
  const std::vector<std::string> scripts{
      trajectory(0, {{-1, 0, 0}, {4, 4, 0}}),
      trajectory(0, {{0, 0, 0}, {1e9, 4, 0}}),
      trajectory(0, {{0, 0, 0}, {4, 5000, 0}}),
      trajectory(0, {{0, 0, 0}, {1, 0, 0}, {7000, 0, 0}, {7001, 1, 0}}),
      "<loop>perhaps</loop>" + trajectory(0, {{0, 0, 0}, {4, 4, 0}}),
      "<delay_start>-1</delay_start>" + trajectory(0, {{0, 0, 0}, {4, 4, 0}}),
      "<delay_start>nan</delay_start>" + trajectory(0, {{0, 0, 0}, {4, 4, 0}}),
      "<trajectory id='x' type='w'/><trajectory id='1' type='w'/>",
      "<trajectory id='0' type='w'><waypoint><pose>0 0 0 0 0 0</pose></waypoint></trajectory>",
      "<trajectory id='0' type='w'><waypoint><time>0</time></waypoint></trajectory>",
  };
  for (const std::string& script : scripts) {
    const std::string sentence = sentence_of(
        write_world(ground_ + "\n<actor name='ann'><script>" + script + "</script></actor>"));
    EXPECT_NE(sentence.find("a.world, line 2"), std::string::npos) << script << ": " << sentence;
  }
  std::vector<At> many;
  for (int i = 0; i < 2000; ++i) many.push_back({1.0 * i, 1.0 * (i % 7), 0.0});
  EXPECT_NE(sentence_of(write_world(ground_ + "<actor name='ann'><script>" + trajectory(0, many) +
                                    "</script></actor>")),
            "");
}

}  // namespace
}  // namespace navvi_sim::read
