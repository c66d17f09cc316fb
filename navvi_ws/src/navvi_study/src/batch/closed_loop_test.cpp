#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <navvi_config/reader.hpp>
#include <navvi_people/loop/closed_loop.hpp>
#include <random>
#include <set>

#include "batch/loop_trial.hpp"
#include "record/events.hpp"
#include "recount/recount.hpp"
#include "temp_folder.hpp"

namespace navvi_study::batch {
namespace {

using navvi_people::loop::ClosedLoopConfig;
namespace people = navvi_people::people;

/// A thing of one box, which stands still. \param word  its class; empty: by its name \param at  m,
/// its centre: x y z
std::string box(const std::string& name, const std::string& word, const std::string& size,
                const std::string& at) {
  const std::string of = word.empty() ? "" : "<navvi:class>" + word + "</navvi:class>";
  return "<model name='" + name + "'><static>true</static>" + of + "<pose>" + at +
         " 0 0 0</pose><link name='l'><collision name='c'><geometry><box><size>" + size +
         "</size></box></geometry></collision></link></model>\n";
}

/// A pallet robot on its way to and fro. \param begin, end  m: x y; \param pause  s, at both
std::string pallet_robot(const std::string& begin, const std::string& yaw, const std::string& end,
                         const std::string& delay, const std::string& pause) {
  const std::string waypoint = "<navvi:waypoint speed='0' pause='" + pause + "'>";
  return "<model name='mover'><static>true</static><navvi:class>pallet_robot</navvi:class><pose>" +
         begin + " 0 0 0 " + yaw + "</pose><navvi:route speed='0.5' loop='true' delay='" + delay +
         "' yields='true'>" + waypoint + begin + "</navvi:waypoint>" + waypoint + end +
         "</navvi:waypoint></navvi:route><link name='l'><collision name='c'>"
         "<pose>0 0 0.25 0 0 0</pose><geometry><box><size>0.8 0.6 0.4</size></box></geometry>"
         "</collision></link></model>\n";
}

/// A worker who crosses the room.
const std::string kWorker =
    "<model name='worker'><static>true</static><navvi:class>worker</navvi:class>"
    "<pose>1.5 -2.4 0 0 0 0</pose><navvi:route speed='0.8' loop='true' delay='0' yields='true'>"
    "<navvi:waypoint speed='0' pause='0'>1.5 -2.4</navvi:waypoint>"
    "<navvi:waypoint speed='0' pause='0'>1.5 2.4</navvi:waypoint></navvi:route>"
    "<link name='l'><collision name='c'><pose>0 0 0.725 0 0 0</pose>"
    "<geometry><box><size>0.4 0.4 1.45</size></box></geometry></collision></link></model>\n";

std::string world(const std::string& things) {
  return "<sdf version='1.7' xmlns:navvi='navvi'><world name='w'>\n" + things + "</world></sdf>";
}

const std::string kFloor = box("ground", "floor", "12 6 0.1", "0 0 -0.05");
const std::string kRoom = world(kFloor);
/// A wall right across the room.
const std::string kCut = world(kFloor + box("wall", "wall", "0.2 6 2", "0 0 1"));
/// A wall with a door of 1.2 m, and a pallet robot that has stopped in it for good.
const std::string kDoor = world(kFloor + box("left", "wall", "0.2 2.4 2", "0 1.8 1") +
                                box("right", "wall", "0.2 2.4 2", "0 -1.8 1") +
                                pallet_robot("0.2 0", "0", "1.5 0", "3600", "0"));
/// An aisle of 1.8 m with a niche, and a pallet robot that comes along it.
const std::string kNiche = world(box("ground", "floor", "20 6 0.1", "0 0 -0.05") +
                                 box("south", "wall", "10 2.1 2", "0 -1.95 1") +
                                 box("west", "wall", "3 2.1 2", "-3.5 1.95 1") +
                                 box("east", "wall", "5.5 2.1 2", "2.25 1.95 1") +
                                 pallet_robot("6 0", "3.14159", "-8.5 0", "0", "200"));
/// A worker, and a pedestal too low for the lidar's plane on the straight way.
const std::string kCrossing =
    world(kFloor + box("pedestal", "pedestal", "0.6 0.6 0.1", "-1 0.1 0.05") + kWorker);

/// Judges what a robot's own sensors told of what drove near it.
class Sensing {
 public:
  /// Call it after every step.
  void watch(const ClosedLoop& loop) {
    if (loop.senses() == nullptr || !loop.perceived()) return;
    const navvi_sim::live::Snapshot& now = loop.session().world().now();
    const auto& told = loop.perceived()->things;
    const auto matches = [](const navvi_types::MovingThing& one,
                            const navvi_types::MovingThing& mover) {
      return (one.pose.position - mover.pose.position).norm() < kSame + mover.radius;
    };
    std::map<std::uint32_t, int> rays;
    for (const std::uint32_t mover : loop.senses()->scan().movers) ++rays[mover];
    for (const navvi_sim::MoverState& mover : now.movers) {
      const navvi_types::MovingThing& truth = mover.thing;
      if (rays[truth.id] < kRays || truth.velocity.norm() < kDrives ||
          (truth.pose.position - now.robot.position).norm() > kNear)
        continue;
      Passage& passage = passages_[truth.id];
      if (passage.since == 0.0 || loop.time() - passage.seen > kLost)
        passage = {loop.time(), loop.time()};
      passage.seen = loop.time();
      for (const navvi_types::MovingThing& one : told) {
        if (!matches(one, truth)) continue;
        passage.told = true;
        if (one.velocity.norm() == 0.0 || passage.drives) continue;
        passage.drives = true;
        lag_ += loop.time() - passage.since;
        ++lags_;
      }
      if (passage.judged || loop.time() - passage.since < kTime) continue;
      passage.judged = true;
      ++passed_;
      if (!passage.told) ++missed_;
    }
    for (const navvi_types::MovingThing& one : told)
      if (one.velocity.norm() > 0.0 &&
          std::none_of(now.movers.begin(), now.movers.end(),
                       [&](const navvi_sim::MoverState& mover) { return matches(one, mover.thing); }))
        ghosts_.insert(one.id);
  }
  [[nodiscard]] double lag() const { return lags_ > 0 ? lag_ / static_cast<double>(lags_) : 0.0; }

  std::uint64_t passed_ = 0;         ///< movers that drove within 5 m for 1.5 s, in sight
  std::uint64_t missed_ = 0;         ///< of these, of which nothing was told
  std::set<std::uint32_t> ghosts_;   ///< obstacles that were told to drive where no mover was

 private:
  static constexpr int kRays = 3;         // of the lidar, on a mover that is in sight
  static constexpr double kNear = 5.0;    // m
  static constexpr double kDrives = 0.3;  // m/s
  static constexpr double kLost = 0.5;    // s out of sight; a new passage begins
  static constexpr double kTime = 1.5;    // s
  static constexpr double kSame = 1.0;    // m, between the surfaces of what is told and what is
  struct Passage {
    double since = 0.0;  // s
    double seen = 0.0;   // s, the last time
    bool told = false;   // as an obstacle
    bool drives = false; // as one that drives
    bool judged = false;
  };

  std::map<std::uint32_t, Passage> passages_;  // by thing
  std::uint64_t lags_ = 0;
  double lag_ = 0.0;  // s, the sum
};

trial::TrialNodeConfig limited(double limit) {
  trial::TrialNodeConfig config;
  config.limit = limit;
  return config;
}

class ClosedLoopIn : public testing::Test {
 protected:
  ClosedLoopIn() {
    config_.sim.start = "-4,0.5,0";
    config_.sim.goal = "4,-0.5";
  }

  /// The figures of a trial of at most `limit` s, and `hash`, of the world's last state.
  record::Fields play(const std::string& world, double limit) {
    config_.sim.world = folder_.write("room.world", world);
    ClosedLoop loop(config_, navvi_people::loop::Spoken(phrases_));
    LoopTrial trial(limited(limit), loop, phrases_);
    sensing_ = Sensing();
    while (loop.step() && trial.watch()) sensing_.watch(loop);
    trace_ = record::events_csv(trial.finish());
    record::Fields row;
    for (const record::Figure& figure : record::figures())
      row.set(figure.name, figure.of(trial.finish()));
    return row.set("hash", navvi_types::to_hex(loop.session().world().state_hash()));
  }

  navvi_test::TempFolder folder_;
  ClosedLoopConfig config_;
  std::string phrases_ = NAVVI_PHRASES;
  std::string trace_;  ///< events of the last trial
  Sensing sensing_;    ///< of the last trial
};

TEST_F(ClosedLoopIn, aMapThatNavigationRejectsEndsTheTrialWithTheReason) {
  navvi_config::read(config_.nav, navvi_config::read_words({"mesh/floor_height:=1.5"}), "test");
  try {
    (void)play(kRoom, 5.0);
    FAIL() << "the trial ended without a sentence";
  } catch (const std::runtime_error& error) {
    const std::string why = error.what();
    EXPECT_EQ(why.rfind("navigation rejects the map of " + config_.sim.world + ": ", 0), 0U) << why;
    EXPECT_NE(why.find("z = 0.00 m"), std::string::npos) << why;
  }
}

TEST_F(ClosedLoopIn, anEmptyRoomReachesItsGoalWithoutDetourOrContact) {
  const record::Fields row = play(kRoom, 60.0);
  EXPECT_EQ(row.get("result"), "reached");
  EXPECT_EQ(row.get("hits"), "-");
  EXPECT_EQ(row.get("reroute_count"), "0");
  EXPECT_EQ(row.get("flips"), "0");
  EXPECT_NEAR(row.number("shortest_path_m").value(), 8.06, 0.1);
  EXPECT_LT(row.number("path_length_m").value(), 1.2 * 8.06);
  EXPECT_GT(row.number("path_length_m").value(), 8.06 - 1.2);
  EXPECT_NE(trace_.find("the goal is 8 meters"), std::string::npos);
}

TEST_F(ClosedLoopIn, aWorldWithASlabOnItsPlaneIsDrivenOnTheSlab) {
  const std::string plane =
      "<model name='ground_plane'><static>1</static><link name='l'><collision name='c'><geometry>"
      "<plane><normal>0 0 1</normal><size>100 100</size></plane></geometry></collision></link>"
      "</model>";
  const std::string boxes = box("b", "", "0.5 0.5 1", "2 2 0.55") +
                            box("c", "", "0.5 0.5 1", "-2 2 0.55");
  config_.sim.start = "-3,-1,0";
  config_.sim.goal = "3,-1";
  for (const std::string& things : {box("asphalt_plane", "", "8 8 0.1", "0 0 0") + boxes,
                                    box("asphalt_plane", "", "20 20 0.1", "0 0 0")}) {
    const record::Fields row = play(world(plane + things), 60.0);
    EXPECT_EQ(row.get("result"), "reached") << trace_;
    EXPECT_EQ(row.get("hits"), "-");
  }
}

TEST_F(ClosedLoopIn, everyLanguageAndWordingLeadsToTheGoalByWordsAlone) {
  config_.sim.goal = "3,-2";
  for (const char* language : {"en.yaml", "es.yaml"})
    for (const char* directions : {"clock", "left_right", "degrees"})
      for (const char* verbosity : {"brief", "normal", "full"}) {
        phrases_ = std::filesystem::path(NAVVI_PHRASES).replace_filename(language);
        const std::string wording = "cues/wording/";
        navvi_config::read(
            config_.feedback,
            navvi_config::read_words(
                {"sounds/enabled:=false", wording + "directions:=" + directions,
                 wording + "verbosity:=" + verbosity,
                 wording + "units:=" + (verbosity == std::string("full") ? "feet" : "meters")}),
            "the test");
        EXPECT_EQ(play(kRoom, 90.0).get("result"), "reached")
            << language << " " << directions << " " << verbosity << "\n"
            << trace_;
      }
}

TEST_F(ClosedLoopIn, everyCombinationOfChannelsRunsAndOfOneThatIsOffNothingIsPlayed) {
  config_.sim.world = folder_.write("room.world", kRoom);
  for (int channels = 0; channels < 8; ++channels) {
    SCOPED_TRACE(channels);
    config_.speech = (channels & 1) != 0;
    const auto shown = [](bool on) { return on ? std::string("true") : std::string("false"); };
    const bool sounds = (channels & 2) != 0;
    navvi_config::read(config_.feedback,
                       navvi_config::read_words({"sounds/enabled:=" + shown(sounds),
                                                 "haptics/enabled:=" + shown((channels & 4) != 0)}),
                       "the test");
    ClosedLoop loop(config_, navvi_people::loop::Spoken(phrases_));
    int spoken = 0, sounded = 0;
    bool moved = false;
    while (loop.time() < 20.0) {
      ASSERT_TRUE(loop.step());
      for (const navvi_msgs::Cue& cue : loop.told().cues)
        if (cue.modality != navvi_msgs::Cue::RUMBLE)
          ++(cue.modality == navvi_msgs::Cue::SPEECH ? spoken : sounded);
      moved |= loop.hand().forward != 0.0;
    }
    EXPECT_EQ(spoken > 0, config_.speech);
    EXPECT_TRUE(sounds || sounded == 0) << sounded;
    EXPECT_TRUE(moved);
  }
}

TEST_F(ClosedLoopIn, theSameSeedGivesTheSameTrialAndAnotherPersonAnotherOneInTheSameWorld) {
  const record::Fields first = play(kRoom, 60.0);
  const std::string trace = trace_;
  EXPECT_EQ(play(kRoom, 60.0), first);
  EXPECT_EQ(trace_, trace);
  config_.person.seed = 6;
  const record::Fields other = play(kRoom, 60.0);
  EXPECT_NE(other.get("hash"), first.get("hash"));
  EXPECT_EQ(other.get("shortest_path_m"), first.get("shortest_path_m"));
}

TEST_F(ClosedLoopIn, aRoomCutInTwoHasItsGoalRefused) {
  const record::Fields row = play(kCut, 60.0);
  EXPECT_EQ(row.get("result"), "refused");
  EXPECT_LT(row.number("elapsed_s").value(), 2.0);
}

TEST_F(ClosedLoopIn, aDoorThatSomethingStandsInIsToldAndNotDrivenInto) {
  const record::Fields row = play(kDoor, 40.0);
  EXPECT_EQ(row.get("result"), "timeout");
  EXPECT_EQ(row.get("hits"), "-");
  EXPECT_GT(row.number("no_route_s").value() + row.number("blocked_s").value(), 30.0);
  EXPECT_GT(row.number("still_s").value(), 28.0);
}

TEST_F(ClosedLoopIn, anAisleWithRoomForOneMakesRoomForWhatComesAndGoesOnOnceItHasPassed) {
  config_.sim.start = "1,0,0";
  config_.sim.goal = "7,1";
  config_.sim.life.movers.patience = 1000.0;  // it does not back out
  const record::Fields row = play(kNiche, 150.0);
  EXPECT_EQ(row.get("result"), "reached");
  EXPECT_EQ(row.get("hits"), "-");
  EXPECT_EQ(row.get("reroute_count"), "0");
  EXPECT_GT(row.number("make_room_s").value(), 10.0);
  EXPECT_GE(row.number("mover_proximity_count").value(), 1.0);
  EXPECT_NE(trace_.find("move to 6 o'clock"), std::string::npos) << trace_;
}

TEST_F(ClosedLoopIn, aRobotsOwnSensorsLeadPastAWorkerAndACameraPastWhatIsTooLowForTheLidar) {
  config_.sim.sensing = "robot";
  const record::Fields row = play(kCrossing, 120.0);
  EXPECT_EQ(row.get("result"), "reached") << trace_;
  EXPECT_EQ(row.get("hits"), "-") << trace_;
  EXPECT_GE(sensing_.passed_, 1u);
  EXPECT_EQ(sensing_.missed_, 0u);
  EXPECT_LE(sensing_.ghosts_.size(), 1u);
  EXPECT_LT(sensing_.lag(), 1.0);
  const std::string trace = trace_;
  EXPECT_EQ(play(kCrossing, 120.0), row);
  EXPECT_EQ(trace_, trace);
  config_.sim.sensing = "lidar";
  EXPECT_NE(play(kCrossing, 30.0).get("hits").find("pedestal"), std::string::npos)
      << "the known limit of a lidar alone";
}

/// Voxels that a robot of 0.35 m must keep from, as a map of sim_node holds them.
class Voxels {
 public:
  explicit Voxels(const navvi_sim::occupancy::OccupancyMap& map) : edge_(map.resolution()) {
    map.for_each_cube([this](const navvi_sim::occupancy::OccupiedCube& cube) {
      if (cube.z + cube.side <= 0 || cube.z * edge_ >= 0.8) return;
      for (int x = cube.x; x < cube.x + cube.side; ++x)
        for (int y = cube.y; y < cube.y + cube.side; ++y) taken_.insert({x, y});
    });
  }
  /// m, from the point to the nearest voxel; 0.5 if that is farther
  [[nodiscard]] double gap(const Eigen::Vector2d& at) const {
    const int reach = static_cast<int>(std::ceil(kFar / edge_));
    const int column = static_cast<int>(std::floor(at.x() / edge_));
    const int row = static_cast<int>(std::floor(at.y() / edge_));
    double least = kFar;
    for (int x = column - reach; x <= column + reach; ++x) {
      for (auto i = taken_.lower_bound({x, row - reach});
           i != taken_.end() && i->first == x && i->second <= row + reach; ++i) {
        const Eigen::Array2d low = Eigen::Array2d(x, i->second) * edge_;
        const Eigen::Array2d off = (low - at.array()).max(at.array() - low - edge_).max(0.0);
        least = std::min(least, off.matrix().norm());
      }
    }
    return least;
  }
  [[nodiscard]] Eigen::AlignedBox2d bounds() const {
    Eigen::AlignedBox2d out;
    for (const auto& [x, y] : taken_) out.extend(Eigen::Vector2d(x, y) * edge_);
    return out;
  }

 private:
  static constexpr double kFar = 0.5;
  double edge_;  // m
  std::set<std::pair<int, int>> taken_;
};

/// Whether a sentence says what to do, and not only what there is.
bool instructs(const navvi_msgs::Cue& cue, const people::Listener& listener) {
  const auto told = navvi_types::from_word<navvi_types::Content>(cue.kind);
  if (!told || *told == navvi_types::CueKind::obstacle_stop) return told.has_value();
  const auto parts = listener.understand(told->kind, cue.text);
  return std::any_of(parts.begin(), parts.end(), [](const people::Instruction& part) {
    return part.asks != people::Ask::nothing && part.asks != people::Ask::ready &&
           part.asks != people::Ask::beware;
  });
}

/// "Stop" and "wait" hold until "go on", whatever comes between; nobody asks for anything.
TEST(APersonWhoObeysWhatIsTaught,
     reaches_the_goal_and_never_stands_12_s_without_a_word_what_to_do) {
  ClosedLoopConfig config;
  config.sim.world = "warehouse";
  config.sim.seed = 7;
  config.person.attention.patience = config.person.attention.idle_patience = 60.0;
  ClosedLoop loop(config, navvi_people::loop::Spoken(NAVVI_PHRASES));
  LoopTrial trial(limited(400.0), loop, NAVVI_PHRASES);
  double told = 0.0, longest = 0.0;  // s
  bool goes_on = true;
  while (goes_on && loop.step()) {
    goes_on = trial.watch();
    const bool stands = std::abs(loop.session().world().now().robot.forward_speed()) < 0.05;
    if (!stands || !loop.begun()) told = loop.time();
    for (const navvi_msgs::Cue& cue : loop.told().cues)
      if (cue.modality == navvi_msgs::Cue::SPEECH && cue.stage == navvi_msgs::Cue::STARTED &&
          instructs(cue, loop.person().listener()))
        told = loop.time();
    longest = std::max(longest, loop.time() - told);
  }
  const std::string text = record::events_csv(trial.finish());
  EXPECT_TRUE(trial.finish().last("GOAL_REACHED")) << text;
  EXPECT_LE(longest, 12.0) << text;
}

/// The judge knows the voxels that the simulator sends and the discs, not how paths are made.
TEST(BuiltInWorlds, areLedThroughAtTheRobotsRadiusFromAllOnTenThousandPaths) {
  constexpr double kRadius = 0.35, kTolerance = 0.01;  // m
  constexpr int kPaths = 1700;                         // a world
  for (const char* name : {"training", "easy", "warehouse", "busy", "narrow", "maze"}) {
    SCOPED_TRACE(name);
    navvi_sim::setup::SimNodeConfig sim;
    sim.world = name;
    const auto loaded = navvi_sim::setup::load_world(sim);
    const navvi_sim::occupancy::OccupancyMap map = navvi_sim::setup::map_of(sim, loaded.world);
    const Voxels voxels(map);
    navvi_nav::lockstep::Navigation navigation(ClosedLoopConfig().nav);
    navigation.set_map(map.stream(), "OcTree", map.resolution());
    std::mt19937 random(1);
    const auto share = [&random] { return static_cast<double>(random() % 10000) / 10000.0; };
    const Eigen::AlignedBox2d bounds = voxels.bounds();
    navvi_types::Obstacles obstacles;
    const auto gap = [&](const Eigen::Vector2d& at) {
      double least = voxels.gap(at);
      for (const navvi_types::MovingThing& disc : obstacles.things)
        least = std::min(least, (disc.pose.position - at).norm() - disc.radius);
      return least;
    };
    const auto somewhere = [&] {
      Eigen::Vector2d at;
      do {
        at = bounds.min() + Eigen::Vector2d(share(), share()).cwiseProduct(bounds.sizes());
      } while (gap(at) < kRadius + 0.05);
      return at;
    };
    int paths = 0;
    double nearest = 1.0, longest = 0.0;  // m; times the bound
    for (int i = 0; paths < kPaths && i < 4 * kPaths; ++i) {
      const double time = 10.0 * i;
      obstacles.things.clear();
      for (std::uint32_t id = 0; id < random() % 20; ++id)
        obstacles.things.push_back({id,
                                    navvi_types::ThingClass::other,
                                    {somewhere(), 0.0},
                                    Eigen::Vector2d::Zero(),
                                    0.3,
                                    1.0});
      const Eigen::Vector2d start = somewhere();
      navigation.set_pose({start, 0.0}, 0.0, time);
      navigation.set_obstacles(obstacles, time);
      navigation.set_goal(somewhere());
      std::optional<navvi_types::Guidance> guidance = navigation.update(time);
      while (navigation.plan_waits()) guidance = navigation.update(time);
      const std::vector<Eigen::Vector2d> path = navigation.path();
      if (path.size() < 2 || !guidance ||
          guidance->state != navvi_types::Guidance::State::following || guidance->blocked_by ||
          !guidance->detail.empty())
        continue;
      ++paths;
      double length = 0.0;
      for (std::size_t k = 1; k < path.size(); ++k) {
        const Eigen::Vector2d leg = path[k] - path[k - 1];
        length += leg.norm();
        const int parts = 1 + static_cast<int>(leg.norm() / 0.1);
        for (int part = 0; part <= parts; ++part)
          nearest = std::min(nearest, gap(path[k - 1] + (1.0 * part / parts) * leg));
      }
      longest = std::max(longest, length / std::max(1.25 * guidance->shortest_length,
                                                    guidance->shortest_length + 2.0));
    }
    EXPECT_EQ(paths, kPaths);
    EXPECT_GE(nearest, kRadius - kTolerance);
    EXPECT_LE(longest, 1.0 + 1e-9);
  }
}

TEST(BagOfALoop, isCountedAgainAsItsJournalAlsoWhereTheRobotSlowsByItself) {
  ClosedLoopConfig config;
  const auto words = {"sim/world:=training", "sim/seed:=2", "person/type:=struggling",
                      "sim/gate/assistance:=steer"};
  navvi_config::read(config, navvi_config::read_words({words.begin(), words.end()}), "test");
  navvi_people::loop::ClosedLoop loop(config, navvi_people::loop::Spoken(NAVVI_PHRASES));
  trial::TrialNodeConfig about;
  about.limit = 60.0;
  LoopTrial trial(about, loop, NAVVI_PHRASES);
  const navvi_test::TempFolder folder;
  trial.keep(folder / "trial-1", 0);
  while (loop.step() && trial.watch()) continue;
  const record::Summary summary = record::summarize(trial.finish());
  EXPECT_NE(record::cell_of(summary, "assisted_s"), "0.000");
  const auto bag = recount::trial_from_bag(folder / "trial-1" / "trial.bag",
                                           std::filesystem::path(NAVVI_PHRASES).parent_path());
  EXPECT_EQ(record::differences(summary, record::summarize(bag.trial)), std::vector<std::string>());
}

TEST(ClosedLoopConfig, namesEachPartAndRefusesAnUnknownOne) {
  ClosedLoopConfig config;
  navvi_config::read(config, navvi_config::read_words({"nav/replan/period:=3", "sim/seed:=4"}),
                     "test");
  const auto nav = navvi_config::table_of([&](auto& visit) { config.nav.describe(visit); });
  EXPECT_TRUE(std::any_of(nav.begin(), nav.end(), [](const navvi_config::Row& row) {
    return row.key == "replan/period" && std::stod(row.default_value) == 3.0;
  }));
  EXPECT_EQ(config.sim.seed, 4);
  EXPECT_THROW(navvi_config::read(config, navvi_config::read_words({"eyes/open:=1"}), "test"),
               navvi_config::ConfigError);
}

}  // namespace
}  // namespace navvi_study::batch
