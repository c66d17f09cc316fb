#include "traffic/traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "warehouse.hpp"

namespace navvi_sim::traffic {
namespace {

constexpr double kStep = 0.05;  // s
const Disc kFar{{1e4, 1e4}, 0.35};

Thing thing_with(const std::string& name, ThingClass thing_class, const Eigen::Vector3d& size,
                 const Route& route) {
  Thing thing;
  thing.name = name;
  thing.thing_class = thing_class;
  const Eigen::Vector2d way = route.waypoints[1].at - route.waypoints[0].at;
  thing.pose.translate(
      Eigen::Vector3d(route.waypoints[0].at.x(), route.waypoints[0].at.y(), 0.5 * size.z()));
  thing.pose.rotate(Eigen::AngleAxisd(std::atan2(way.y(), way.x()), Eigen::Vector3d::UnitZ()));
  thing.shapes.push_back({Box{size}, Eigen::Isometry3d::Identity()});
  thing.route = route;
  return thing;
}

/// Runs a world's traffic and looks that nobody meets and nobody stops for good.
class Street {
 public:
  explicit Street(const WorldDescription& world, std::uint64_t seed = 1)
      : world_(world), traffic_(world, {}, seed) {
    for (std::size_t i = 0; i < traffic_.size(); ++i) {
      const Thing& thing = world_.things[traffic_.thing(i)];
      prints_.push_back(footprint_of(thing, tilt_of(thing.pose)));
    }
    moved_at_.assign(traffic_.size(), 0.0);
  }

  /// \param patience  s, that any may stand, if there is any
  void run(double seconds, std::optional<double> patience, const Disc& robot = kFar) {
    const double until = time_ + seconds;
    for (int step = 0; time_ < until; ++step, time_ += kStep) {
      traffic_.step(robot, {}, kStep);
      if (step % 4 == 0) expect_apart();
      if (testing::Test::HasFailure()) return;
      for (std::size_t i = 0; i < traffic_.size(); ++i) {
        if (traffic_.mover(i).has_moved()) moved_at_[i] = time_;
        if (patience && time_ - moved_at_[i] > *patience) {
          FAIL() << name(i) << " stands since " << moved_at_[i] << " s at "
                 << traffic_.mover(i).place().position.transpose();
        }
      }
    }
  }
  /// What stands now may stand for `patience` from now on.
  void forgive() { std::fill(moved_at_.begin(), moved_at_.end(), time_); }

  void expect_apart() const {
    std::vector<Polygon> bodies;
    for (std::size_t i = 0; i < traffic_.size(); ++i) {
      const Pose2& place = traffic_.mover(i).place();
      Polygon body;
      for (const Eigen::Vector2d& corner : prints_[i].hull)
        body.push_back(place.position + Eigen::Rotation2Dd(place.yaw) * corner);
      bodies.push_back(std::move(body));
    }
    for (std::size_t a = 0; a < bodies.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const double reach = prints_[a].radius + prints_[b].radius;
        const Eigen::Vector2d away =
            traffic_.mover(a).place().position - traffic_.mover(b).place().position;
        if (away.squaredNorm() < reach * reach && overlap(bodies[a], bodies[b], 0.0)) {
          FAIL() << name(a) << " in " << name(b) << " at " << time_ << " s, "
                 << traffic_.mover(a).place().position.transpose();
        }
      }
  }

  [[nodiscard]] std::string name(std::size_t i) const {
    return world_.things[traffic_.thing(i)].name;
  }
  [[nodiscard]] double stood_for(std::size_t i) const { return time_ - moved_at_[i]; }
  [[nodiscard]] const Traffic& traffic() const { return traffic_; }
  [[nodiscard]] const Footprint& print(std::size_t i) const { return prints_[i]; }

 private:
  WorldDescription world_;
  Traffic traffic_;
  std::vector<Footprint> prints_;
  std::vector<double> moved_at_;  // s
  double time_ = 0.0;             // s
};

WorldDescription world_of(const std::vector<Thing>& things) {
  WorldDescription world;
  world.name = "street";
  world.things = things;
  return world;
}

std::string refusal(const WorldDescription& world) {
  try {
    static_cast<void>(lay_lanes(world, {}));
  } catch (const WorldError& error) {
    return error.what();
  }
  return "";
}

const Eigen::Vector3d kPallet{1.0, 0.7, 0.5};
const Eigen::Vector3d kForklift{2.5, 1.0, 2.0};

Thing pallet_robot(const std::string& name, const Route& route) {
  return thing_with(name, ThingClass::pallet_robot, kPallet, route);
}

TEST(Traffic, of_nobody_is_quiet) {
  Traffic traffic(world_of({}), {}, 1);
  traffic.step(kFar, {}, kStep);
  EXPECT_EQ(traffic.size(), 0u);
}

TEST(Traffic, of_hundreds_on_a_grid_of_ways_keeps_going_for_half_an_hour) {
  std::vector<Thing> things;
  for (int i = 0; i < 100; ++i) {
    const double at = 4.0 * i;
    const double from = 4.0 * (i * 37 % 88) - 2.0, to = from + 46.0;
    things.push_back(pallet_robot("east " + std::to_string(i),
                                  through({{from, at}, {to, at}}, 0.8 + 0.01 * i, i % 3)));
    things.push_back(pallet_robot("north " + std::to_string(i),
                                  through({{at, from}, {at, to}}, 1.2 - 0.005 * i, i % 2)));
  }
  Street street(world_of(things));
  street.run(1800.0, 300.0);
}

/// Routes drawn at random; what cannot be made safe is refused and left out.
WorldDescription drawn_world(std::uint64_t seed, std::size_t count, double side) {
  std::mt19937_64 random(seed);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  WorldDescription world = world_of({});
  for (std::size_t tries = 0; world.things.size() < count && tries < 2 * count; ++tries) {
    const Eigen::Vector2d at(draw(0, side), draw(0, side));
    const double length = draw(2, 12), width = draw(1, 10);
    const bool there_and_back = draw(0, 1) < 0.4;
    std::vector<Eigen::Vector2d> corners{at, at + Eigen::Vector2d(length, draw(-3, 3))};
    if (!there_and_back) {
      corners.push_back(at + Eigen::Vector2d(length + draw(-1, 1), width + 3));
      corners.push_back(at + Eigen::Vector2d(0, width + 3));
    }
    Route route = through(corners, draw(0.4, 1.8), draw(0, 1) < 0.3 ? draw(0, 5) : 0.0);
    if (draw(0, 1) < 0.1) route.delay = draw(0, 10);
    const int kind = static_cast<int>(random() % 3);
    const std::string name = "mover " + std::to_string(world.things.size());
    world.things.push_back(kind == 0 ? thing_with(name, ThingClass::forklift, kForklift, route)
                           : kind == 1
                               ? pallet_robot(name, route)
                               : thing_with(name, ThingClass::worker, {0.5, 0.5, 1.7}, route));
    if (!refusal(world).empty()) world.things.pop_back();
  }
  return world;
}

TEST(Traffic, drawn_at_random_never_meets_and_never_stops_for_good) {
  std::size_t movers = 0, conflicts = 0;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    const WorldDescription world = drawn_world(seed, 14, 24.0);
    for (const Lane& lane : lay_lanes(world, {}).lanes)
      for (const Segment& segment : lane.segments) conflicts += segment.conflicts.size();
    movers += world.things.size();
    Street street(world, seed);
    street.run(1800.0, 400.0);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(movers, 100u);
  EXPECT_GT(conflicts, movers) << "they must have something to agree upon";
}

TEST(Traffic, goes_on_after_a_robot_that_stood_in_its_way) {
  for (std::uint64_t seed = 21; seed <= 28; ++seed) {
    const WorldDescription world = drawn_world(seed, 14, 24.0);
    Street street(world, seed);
    std::mt19937_64 random(seed);
    for (int visit = 0; visit < 12; ++visit) {
      // Just where somebody is about to go.
      const std::size_t victim = random() % street.traffic().size();
      const Pose2 place = street.traffic().mover(victim).place();
      const Disc robot{place.position + Eigen::Rotation2Dd(place.yaw) * Eigen::Vector2d(2.5, 0.2),
                       0.35};
      street.run(40.0, std::nullopt, robot);
      street.run(20.0, std::nullopt, {place.position, 0.35});
      // Behind whoever backs out.
      const Pose2 now = street.traffic().mover(victim).place();
      const Eigen::Vector2d behind = Eigen::Rotation2Dd(now.yaw) * Eigen::Vector2d(-2.2, 0.0);
      street.run(20.0, std::nullopt, {now.position + behind, 0.35});
    }
    street.forgive();
    street.run(900.0, 400.0);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(Traffic, lets_others_pass_whom_the_robot_does_not_stop) {
  // The robot stops the first at x = 4, before the second's way at x = 10.
  Street street(world_of({pallet_robot("stopped", through({{0, 0}, {20, 0}})),
                          pallet_robot("passing", through({{10, -10}, {10, 10}}))}));
  street.run(300.0, std::nullopt, {{5.5, 0.0}, 0.35});
  EXPECT_GT(street.stood_for(0), 200.0);
  EXPECT_LT(street.stood_for(1), 10.0);
  street.forgive();
  street.run(300.0, 60.0);
}

TEST(Traffic, on_shared_loops_that_cross_goes_on_after_a_robot) {
  std::vector<Thing> things;
  for (int loop = 0; loop < 3; ++loop)
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d at(9.0 * loop, 5.0 * (loop % 2));
      Thing thing =
          pallet_robot("loop " + std::to_string(loop) + " " + std::to_string(i),
                       through({at, at + Eigen::Vector2d(16, 0), at + Eigen::Vector2d(16, 12),
                                at + Eigen::Vector2d(0, 12)}));
      thing.pose.translation() = Eigen::Vector3d(at.x() + 1.0 + 6.0 * (i % 2), at.y(), 0.25);
      if (i >= 2) {
        thing.pose.translation() += Eigen::Vector3d(5.0, 12, 0);
        thing.pose.linear() = Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      }
      things.push_back(thing);
    }
  Street street(world_of(things));
  std::mt19937_64 random(1);
  for (int visit = 0; visit < 60; ++visit) {
    const Pose2 place = street.traffic().mover(random() % things.size()).place();
    const double ahead = 1.0 + 0.1 * static_cast<double>(random() % 20);
    const Eigen::Rotation2Dd turned(place.yaw);
    street.run(25.0, std::nullopt, {place.position + turned * Eigen::Vector2d(ahead, 0.1), 0.35});
    if (visit % 3 != 0) continue;
    street.forgive();
    street.run(240.0, 120.0);
  }
}

TEST(Traffic, gives_way_to_who_has_waited_long) {
  // A stream of eight on a loop, and one that has to cross it twice a round.
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {40, 0}, {40, 12}, {0, 12}};
  std::vector<Thing> things;
  for (int i = 0; i < 8; ++i) {
    Thing thing = pallet_robot("stream " + std::to_string(i), through(corners, 1.0));
    thing.pose.translation().x() = 3.5 * i + 2.0;
    things.push_back(thing);
  }
  things.push_back(pallet_robot("crossing", through({{33, -8}, {33, 6}}, 0.5)));
  Street street(world_of(things));
  street.run(1200.0, 90.0);
}

TEST(Traffic, of_every_preset_keeps_going) {
  for (const generate::Preset& preset : generate::presets())
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      Street street(generate::layout(preset.name, preset.config, seed), seed);
      street.run(900.0, 240.0);
      ASSERT_FALSE(HasFailure()) << preset.name << ", seed " << seed;
    }
}

/// m, from a thing's body to the robot's; less than 0 in contact.
double gap(const Street& street, std::size_t i, const Disc& robot) {
  const Pose2& place = street.traffic().mover(i).place();
  const Eigen::Vector2d at = Eigen::Rotation2Dd(-place.yaw) * (robot.centre - place.position);
  return distance(at, street.print(i).hull) - robot.radius;
}

/// A robot that stands on the floor ahead of a mover.
Disc robot_before(const Street& street, std::size_t i) {
  const Pose2& place = street.traffic().mover(i).place();
  const Eigen::Vector2d ahead(street.print(i).front + 1.5, 0.1);
  return {place.position + Eigen::Rotation2Dd(place.yaw) * ahead, 0.35};
}

TEST(Traffic, of_every_preset_makes_room_for_a_robot_that_stands_in_its_way_and_never_hits_it) {
  std::size_t rounds = 0;
  for (const generate::Preset& preset : generate::presets())
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const WorldDescription world = generate::layout(preset.name, preset.config, seed);
      Street street(world, seed);
      std::mt19937_64 random(seed);
      for (int visit = 0; visit < 12 && street.traffic().size() > 0; ++visit) {
        const std::size_t victim = random() % street.traffic().size();
        const Disc robot = robot_before(street, victim);
        bool has_room = true;
        for (std::size_t i = 0; i < street.traffic().size(); ++i)
          has_room = has_room && gap(street, i, robot) > 1.1;
        if (!has_room) continue;
        const auto stand = [&](int seconds, double until_near) {
          for (int i = 0; i < seconds && gap(street, victim, robot) > until_near; ++i) {
            street.run(1.0, std::nullopt, robot);
            for (std::size_t other = 0; other < street.traffic().size(); ++other)
              EXPECT_GT(gap(street, other, robot), 0.0) << street.name(other);
          }
        };
        stand(60, 0.8);
        const bool met = gap(street, victim, robot) <= 0.8;
        stand(30, 0.0);
        // To and fro in an aisle there is an end; round a row there is none.
        const bool has_no_end =
            world.things[street.traffic().thing(victim)].route->waypoints.size() > 2;
        if (!has_no_end || !met) continue;
        ++rounds;
        EXPECT_GT(gap(street, victim, robot), 3.0)
            << street.name(victim) << " in " << preset.name << " at "
            << street.traffic().mover(victim).place().position.transpose();
      }
      street.forgive();
      street.run(300.0, 200.0);
      ASSERT_FALSE(HasFailure()) << preset.name << ", seed " << seed;
    }
  EXPECT_GT(rounds, 30u);
}

TEST(Traffic, lets_a_robot_out_of_an_aisle_too_narrow_for_both) {
  // A loop whose southern side is an aisle of a mover's width, with the robot in the middle of it.
  Street street(world_of({pallet_robot("loop", through({{0, 0}, {16, 0}, {16, 8}, {0, 8}}))}));
  Disc robot{{9.0, 0.0}, 0.35};
  double time = 0.0;
  const auto run = [&](double seconds) {
    street.run(seconds, std::nullopt, robot);
    time += seconds;
    ASSERT_GT(gap(street, 0, robot), 0.0) << time << " s";
  };
  // It drives west, through the mover's way, as soon as it has 2 m of room, and off it at the end.
  while (robot.centre.x() > -3.0 && time < 180.0) {
    run(0.1);
    const bool goes = gap(street, 0, robot) > 2.0;
    robot.velocity = {goes ? -0.5 : 0.0, 0.0};
    robot.centre += 0.1 * robot.velocity;
  }
  EXPECT_LT(robot.centre.x(), -2.9) << "after " << time << " s";
  robot.velocity.setZero();
  street.forgive();
  street.run(120.0, 30.0, robot);
}

TEST(Lanes, refuse_who_would_drive_through_what_stands) {
  Thing shelf;
  shelf.name = "shelf";
  shelf.thing_class = ThingClass::shelf;
  shelf.pose.translation() = Eigen::Vector3d(5.0, 0.8, 1.0);
  shelf.shapes.push_back({Box{{2, 1, 2}}, Eigen::Isometry3d::Identity()});
  const Thing low = pallet_robot("mover", through({{0, 0}, {10, 0}}));
  const std::string sentence = refusal(world_of({shelf, low}));
  EXPECT_NE(sentence.find("'mover'"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("'shelf'"), std::string::npos) << sentence;
  shelf.pose.translation().y() = 0.9;
  EXPECT_EQ(refusal(world_of({shelf, low})), "");
  shelf.pose.translation() = Eigen::Vector3d(5.0, 0.0, 2.0);
  EXPECT_EQ(refusal(world_of({shelf, low})), "") << "it passes beneath";
}

TEST(Lanes, round_a_corner_less_where_there_is_less_room) {
  Thing post;
  post.name = "post";
  post.thing_class = ThingClass::other;
  post.shapes.push_back({Box{{0.2, 0.2, 2}}, Eigen::Isometry3d::Identity()});
  const auto radius = [&](const Eigen::Vector2d& at) {
    post.pose.translation() = Eigen::Vector3d(at.x(), at.y(), 1.0);
    const Thing mover = thing_with("mover", ThingClass::forklift, {1.6, 1.0, 2.0},
                                   through({{0, 0}, {10, 0}, {10, 8}, {0, 8}}));
    const Lanes lanes = lay_lanes(world_of({post, mover}), {});
    for (const Track::Element& element : lanes.lanes.at(0).track.elements())
      if (element.corner == 1 && element.curvature != 0.0) return 1.0 / element.curvature;
    return 0.0;
  };
  EXPECT_NEAR(radius({-50, 0}), 1.2, 1e-9);
  const double tight = radius({9.15, 0.85});
  EXPECT_LT(tight, 1.0);
}

TEST(Lanes, refuse_who_has_nowhere_to_wait) {
  const std::string head_on = refusal(world_of({pallet_robot("one", through({{0, 0}, {9, 0}})),
                                                pallet_robot("two", through({{9, 0}, {0, 0}}))}));
  EXPECT_NE(head_on.find("'one'"), std::string::npos) << head_on;
  EXPECT_EQ(refusal(world_of({pallet_robot("one", through({{0, 0}, {9, 0}})),
                              pallet_robot("two", through({{12, 0}, {3, 0}}))})),
            "");
}

TEST(Lanes, refuse_more_on_one_loop_than_it_has_places) {
  std::vector<Thing> things;
  for (int i = 0; i < 12; ++i) {
    Thing thing =
        pallet_robot("mover " + std::to_string(i), through({{0, 0}, {16, 0}, {16, 4}, {0, 4}}));
    thing.pose.translation().x() = 1.25 * i;
    things.push_back(thing);
  }
  EXPECT_NE(refusal(world_of(things)), "");
}

TEST(Lanes, refuse_an_end_in_the_way_and_a_start_off_the_route) {
  Route ends = through({{0, 0}, {10, 0}});
  ends.loop = false;
  const Thing crossing = pallet_robot("crossing", through({{10, -8}, {10, 8}}));
  EXPECT_NE(refusal(world_of({pallet_robot("ending", ends), crossing})).find("'ending'"),
            std::string::npos);
  Thing off = pallet_robot("off", through({{0, 0}, {10, 0}}));
  off.pose.translation().y() = 3.0;
  EXPECT_NE(refusal(world_of({off})).find("off its route"), std::string::npos);
}

TEST(Lanes, let_two_start_on_shared_ground_only_if_one_can_leave_first) {
  Thing one = pallet_robot("one", through({{-8, 0}, {8, 0}}));
  Thing two = pallet_robot("two", through({{0.9, -8}, {0.9, 8}}));
  one.pose.translation().x() = -0.4;
  EXPECT_EQ(refusal(world_of({one, two})), "");
  one.pose.translation().x() = 0.0;
  two.pose.translation().y() = -1.0;
  const std::string sentence = refusal(world_of({one, two}));
  EXPECT_NE(sentence.find("each other's way"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace navvi_sim::traffic
