#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "session_judge.hpp"

namespace navvi_feedback::core {
namespace {

using Scene = SessionJudge::Scene;
using State = Guidance::State;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

void lead(Scene& now, double degrees) {
  now.guidance.steer_angle = now.guidance.waypoint_angle = degrees * kDegree;
}

/// A corner ahead, with a turn by so much.
void corner(Scene& now, double metres, double degrees) {
  now.guidance.waypoint_is_goal = false;
  now.guidance.waypoint = {metres, 0.0};
  now.guidance.waypoint_distance = metres;
  now.guidance.turn_angle = degrees * kDegree;
}

/// The path ends where the map does.
void beyond(Scene& now) {
  now.guidance.ends_short = true;
  now.guidance.waypoint_is_goal = false;
}

void become(Scene& now, State state, std::optional<ThingClass> by = std::nullopt) {
  now.guidance.state = state;
  now.guidance.blocked_by = by;
  now.guidance.blocked_distance = 5.0;
}

void reroute(Scene& now, Guidance::Replan why) {
  ++now.guidance.reroutes;
  now.guidance.reroute_reason = why;
  now.guidance.waypoint = {0.0, -8.0};
  lead(now, 90.0);
}

void hit(Scene& now, ThingClass thing, double x, double y) { now.contacts = {{thing, {x, y}, 7}}; }

NearThing thing(ThingClass kind, double gap, double x, double y, bool moves = false) {
  return {kind, 7, gap, {x, y}, moves};
}

void stand(Scene& now) {
  now.velocity = Velocity{};
  now.forward = 0.0;
}

/// Pushed against what is in the way.
void push(Scene& now, const std::vector<NearThing>& nearby) {
  now.velocity = Velocity{};
  now.nearby = nearby;
}

/// What happens to a person who drives straight on, and what they are told of it first.
struct Row {
  const char* situation;
  std::function<void(Scene&)> change;
  const char* words;  ///< the first; "" none
  const char* felt;   ///< a pattern; "" none
  const char* sound;  ///< an earcon; "" any, or none
  const char* deaf = nullptr;  ///< a pattern where nothing is heard; nullptr: `felt`
};

const auto kShelf = ThingClass::shelf;
const auto kBox = ThingClass::box;
const auto kForklift = ThingClass::forklift;
const auto kWorker = ThingClass::worker;
const auto kRobot = ThingClass::pallet_robot;

const std::vector<Row> kTable = {
    // The way.
    {"all is well", [](Scene&) {}, "", "", "on_course"},
    {"the path bends to the right", [](Scene& now) { lead(now, 60); }, "", "", "turn"},
    {"a corner comes", [](Scene& now) { corner(now, 5.5, 90); }, "in 6 meters, turn to 3 o'clock",
     "", ""},
    {"the way is closed", [](Scene& now) { reroute(now, Guidance::Replan::path_carved); },
     "way blocked, new route", "rerouted", "turn", ""},
    {"a better way", [](Scene& now) { reroute(now, Guidance::Replan::period); }, "new route",
     "rerouted", "turn", ""},
    {"beside the path",
     [](Scene& now) {
       now.guidance.path_offset = 0.9;
       lead(now, -10);
     },
     "the path is 1 meter on your left", "", ""},
    {"the wrong way", [](Scene& now) { lead(now, 170); }, "wrong way, turn to 6 o'clock", "",
     "turn"},
    // To wait, and why there is no way.
    {"a worker crosses", [](Scene& now) { become(now, State::blocked, kWorker); },
     "wait, worker in the way", "halt", ""},
    {"a forklift wants to pass",
     [](Scene& now) {
       become(now, State::make_room, kForklift);
       lead(now, 90);
     },
     "move to 3 o'clock, 20 meters, to let a forklift pass", "", "turn"},
    {"no route", [](Scene& now) { become(now, State::no_route); }, "there is no route to the goal",
     "", ""},
    {"off the floor", [](Scene& now) { become(now, State::off_mesh); },
     "no path starts here, back up a little", "", ""},
    {"no map", [](Scene& now) { become(now, State::no_map); }, "there is no map yet", "", ""},
    {"no position", [](Scene& now) { become(now, State::pose_stale); }, "the position is lost", "",
     ""},
    {"an old map", [](Scene& now) { become(now, State::map_stale); }, "the map is out of date", "",
     ""},
    {"a goal in a shelf",
     [](Scene& now) {
       become(now, State::goal_refused);
       now.guidance.refusal = Guidance::Refusal::inside_obstacle;
     },
     "goal refused, the robot cannot stand there", "", ""},
    {"a goal where nothing is known",
     [](Scene& now) {
       become(now, State::goal_refused);
       now.guidance.refusal = Guidance::Refusal::not_seen;
     },
     "goal refused, not all of that place is seen yet, choose it again to go toward it", "", ""},
    {"a goal that is not seen and was asked for again",
     [](Scene& now) {
       now.guidance.goal = {60.0, 0.0};
       beyond(now);
     },
     "not all of that place is seen yet, going toward it", "", ""},
    {"no goal", [](Scene& now) { become(now, State::no_goal); },
     "welcome, the session waits for a goal", "", ""},
    {"there", [](Scene& now) { become(now, State::arrived); }, "you have reached the goal",
     "arrived", "arrived"},
    // What is near, comes, and is hit.
    {"a shelf at the side", [](Scene& now) { now.nearby = {thing(kShelf, 0.8, 0.0, 1.1)}; }, "", "",
     "shelf_near"},
    {"a pallet robot ahead", [](Scene& now) { now.nearby = {thing(kRobot, 0.9, 1.2, 0.1, true)}; },
     "", "", "pallet_robot_near"},
    {"a shelf hit ahead", [](Scene& now) { hit(now, kShelf, 0.35, 0.0); }, "hit a shelf ahead",
     "hit_shelf", "hit_shelf"},
    {"a pallet robot hits the right side", [](Scene& now) { hit(now, kRobot, 0.0, -0.35); },
     "hit a pallet robot on your right", "hit_obstacle", "hit_obstacle"},
    // A stick that moves nothing.
    {"a box ahead, free behind", [](Scene& now) { push(now, {thing(kBox, 0.1, 0.4, 0.0)}); },
     "back away, box ahead", "stuck", ""},
    {"boxes ahead and behind",
     [](Scene& now) {
       push(now, {thing(kBox, 0.1, 0.4, 0.0), thing(kShelf, 0.2, -0.5, 0.0)});
     },
     "stuck, box ahead, try 3 o'clock", "stuck", ""},
    {"a shelf on the left, the nose at its end",
     [](Scene& now) {
       push(now, {thing(kShelf, 0.05, 0.3, 0.26), thing(kBox, 0.3, -0.65, 0.0)});
     },
     "stuck, shelf ahead, try 2 o'clock", "stuck", ""},
    {"boxed in",
     [](Scene& now) {
       push(now, {thing(kBox, 0.1, 0.45, 0.0), thing(kBox, 0.1, 0.0, 0.45),
                  thing(kShelf, 0.1, 0.0, -0.45), thing(kShelf, 0.1, -0.45, 0.0)});
     },
     "stuck, box ahead, shelf right, shelf behind, box left", "stuck", ""},
    {"nothing near", [](Scene& now) { push(now, {}); }, "stuck", "stuck", ""},
    {"the robot was stopped",
     [](Scene& now) {
       now.gate.state = DriveState::State::stopped;
       now.velocity = Velocity{};
     },
     "robot stopped, release the stick", "stopped", ""},
    // What is lost, and the trial.
    {"the pad is pulled out", [](Scene& now) { now.stick = false; }, "controller disconnected", "",
     ""},
    {"no proximity", [](Scene& now) { now.sensed = false; }, "obstacles are not sensed", "", ""},
    {"no odometry", [](Scene& now) { now.velocity.reset(); },
     "the robot does not report its motion", "", ""},
    {"no guidance", [](Scene& now) { now.guided = false; }, "the guidance is lost", "", "",
     "stopped"},
    {"a pad that cannot rumble",
     [](Scene& now) {
       now.notices = {{CueKind::notice, About::no_rumble}};
     },
     "this controller cannot rumble", "", ""},
    {"the next trial waits",
     [](Scene& now) {
       stand(now);
       become(now, State::arrived);
       now.trial = TrialState::State::ready;
     },
     "press start to begin", "ready", ""},
    {"the time is up",
     [](Scene& now) {
       now.notices = {{CueKind::trial_ends, About::time_up}};
     },
     "time is up, the trial is over", "stopped", ""},
    {"the disk is full",
     [](Scene& now) {
       now.notices = {CueKind::trial_disk_full};
     },
     "the disk is full, the trial is over", "stopped", ""},
    {"the next trial waits for a goal",
     [](Scene& now) {
       stand(now);
       become(now, State::arrived);
       now.trial = TrialState::State::choose_goal;
     },
     "choose a goal", "ready", ""},
    // Questions.
    {"asks for the goal", [](Scene& now) { now.asked = drive::Button::goal; },
     "the goal is 20 meters on", "", ""},
    {"asks for a goal that is not seen",
     [](Scene& now) {
       beyond(now);
       now.asked = drive::Button::goal;
     },
     "not all of that place is seen yet, going toward it", "", ""},
    {"asks for the way", [](Scene& now) { now.asked = drive::Button::repeat; },
     "drive straight, 20 meters", "", ""},
};

/// \return whether `one` is there, or none is wanted
bool has(const std::set<std::string>& all, const char* one) {
  return one[0] == '\0' || all.count(one) > 0;
}

struct Told {
  std::string first;  ///< words
  std::set<std::string> played, felt;
};
Told told(const Row& row, bool sounds, bool motors) {
  SessionJudge session;
  session.now.sounds = sounds;
  session.now.audio = sounds ? Link::alive : Link::lost;
  session.now.motors = motors;
  session.get_under_way();
  row.change(session.now);
  session.pass(5.0);
  return {session.words.empty() ? "" : session.words.front(), session.played, session.felt};
}

TEST(Situations, are_each_told_as_the_table_says_and_by_one_sense_where_the_other_is_lost) {
  for (const Row& row : kTable) {
    SCOPED_TRACE(row.situation);
    const Told both = told(row, true, true), deaf = told(row, false, true);
    for (const Told& heard : {both, told(row, true, false)}) {
      EXPECT_EQ(heard.first, row.words);
      EXPECT_TRUE(has(heard.played, row.sound)) << row.sound;
    }
    EXPECT_TRUE(has(both.felt, row.felt)) << row.felt;
    EXPECT_TRUE(row.felt[0] != '\0' || both.felt.empty());
    EXPECT_TRUE(has(deaf.felt, row.deaf != nullptr ? row.deaf : row.felt));
  }
}

TEST(Situations, what_will_hit_is_told_2_s_before_with_its_side) {
  for (const auto& [stands, degrees, words] : std::vector<std::tuple<bool, double, const char*>>{
           {false, 0.0, "stop, forklift ahead"},
           {true, 0.0, "forklift coming, ahead"},
           {true, 90.0, "forklift coming, on your right"},
           {true, 180.0, "forklift coming, behind you"}})
    for (const bool sounds : {true, false}) {
      SessionJudge session;
      session.now.sounds = sounds;
      session.now.audio = sounds ? Link::alive : Link::lost;
      session.get_under_way();
      if (stands) stand(session.now);
      session.pass(6.0);
      session.forget();
      const double speed = 1.2;
      const Eigen::Vector2d side(std::cos(degrees * kDegree), -std::sin(degrees * kDegree));
      double told_before = 0.0;  // s
      for (double gap = 4.0; gap > 0.0; gap -= 0.02 * speed) {
        const Eigen::Vector2d at = (gap + 0.3) * side;
        session.now.nearby = {thing(kForklift, gap, at.x(), at.y(), true)};
        session.pass(0.02);
        if (told_before == 0.0 && !session.words.empty()) told_before = gap / speed;
      }
      ASSERT_FALSE(session.words.empty()) << words;
      EXPECT_EQ(session.words.front(), words);
      EXPECT_GE(told_before, sounds ? 2.0 : 1.25) << words << ": the hand, which leads, lets go";
      EXPECT_TRUE(stands || session.felt.count("halt") > 0) << "felt, too";
    }
}

TEST(Situations, a_pushed_stick_that_moves_nothing_is_never_3_s_without_word_or_touch) {
  for (const bool motors : {true, false}) {
    SessionJudge session;
    session.get_under_way();
    session.now.motors = motors;
    session.now.velocity = Velocity{};
    session.now.nearby = {thing(kShelf, 0.05, 0.4, 0.0)};
    session.pass(40.0);
    EXPECT_EQ(session.complaints, std::set<std::string>{});
    EXPECT_EQ(session.words.size() > 8, !motors) << "what can be felt is not said each time";
  }
}

/// Changes some of the scene, at random: all states of the guidance, links, things and hands.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed), sights_(seed) {}

  void change(Scene& now) {
    Guidance& guidance = now.guidance;
    if (one_in(2)) become(now, static_cast<State>(draw(names(State{}).size())));
    guidance.refusal = static_cast<Guidance::Refusal>(draw(7));
    if (guidance.state == State::blocked || guidance.state == State::make_room)
      guidance.blocked_by = mover();
    guidance.blocked_for = number(0.0, 8.0);
    guidance.blocked_distance = number(0.0, 6.0);
    if (one_in(3)) lead(now, number(-180.0, 180.0));
    if (one_in(3)) corner(now, number(0.5, 15.0), number(-150.0, 150.0));
    if (one_in(8)) reroute(now, static_cast<Guidance::Replan>(draw(8)));
    if (sights_() % 6 == 0) guidance.ends_short = !guidance.ends_short;
    if (one_in(20)) guidance.goal = {number(-20.0, 20.0), number(-20.0, 20.0)};
    guidance.path_offset = one_in(10) ? 1.0 : 0.1;
    now.guided = !one_in(25);
    now.sensed = !one_in(25);
    now.stick = !one_in(25);
    now.forward = one_in(3) ? 0.0 : 0.8;
    now.velocity = Velocity{now.forward * (one_in(6) ? 0.0 : 1.0), one_in(4) ? 0.6 : 0.0};
    if (one_in(25)) now.velocity.reset();
    now.gate.state = one_in(12) ? DriveState::State::stopped : DriveState::State::running;
    now.nearby.clear();
    for (int things = static_cast<int>(draw(4)); things > 0; --things) {
      const double gap = number(0.05, 3.0);
      const double at = number(-180.0, 180.0) * kDegree;
      NearThing near = thing(static_cast<ThingClass>(1 + draw(8)), gap, (gap + 0.3) * std::cos(at),
                             (gap + 0.3) * std::sin(at), one_in(2));
      near.id = static_cast<std::uint32_t>(1 + draw(6));
      now.nearby.push_back(near);
    }
    if (one_in(8)) {
      hit(now, static_cast<ThingClass>(1 + draw(8)), number(-0.3, 0.3), number(-0.3, 0.3));
      now.contacts.front().id = static_cast<std::uint32_t>(1 + draw(6));
    }
    if (one_in(12)) now.asked = static_cast<drive::Button>(draw(6));
    now.trial = one_in(40) ? TrialState::State::ready : TrialState::State::free;
  }

  /// Whatever there was to stop or wait for has gone.
  void calm(Scene& now) {
    become(now, State::following);
    now.guided = now.sensed = now.stick = true;
    now.velocity = Velocity{now.forward, 0.0};
    now.gate.state = DriveState::State::running;
    now.trial = TrialState::State::free;
    if (one_in(4))
      stand(now);
    else
      now.nearby.clear();
  }

  [[nodiscard]] double number(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  [[nodiscard]] bool one_in(unsigned n) { return draw(n) == 0; }

 private:
  [[nodiscard]] std::size_t draw(std::size_t n) { return random_() % n; }
  [[nodiscard]] ThingClass mover() {
    return static_cast<ThingClass>(static_cast<std::size_t>(kWorker) + draw(3));
  }

  std::mt19937 random_;
  std::mt19937 sights_;  ///< whether the goal is seen
};

Verdict judge(int situations, const GuideConfig& config = {}) {
  constexpr int kOfASession = 250;
  Verdict verdict;
  for (int done = 0; done < situations; done += kOfASession) {
    SessionJudge session(config);
    Chance chance(static_cast<unsigned>(done));
    session.now.sounds = chance.one_in(2);
    session.get_under_way();
    for (int i = 0; i < kOfASession; ++i) {
      chance.change(session.now);
      session.pass(chance.number(0.1, 3.0));
      if (i % 5 != 4) continue;
      chance.calm(session.now);
      session.pass(chance.one_in(8) ? 15.0 : 7.0);
    }
    verdict.add(session);
  }
  return verdict;
}

/// Nor is anybody left waiting: after "stop" or "wait" comes "go on" with its direction, within 12
/// s once the cause has gone, 8 s where nothing moves near, and no other word of the way before it;
/// and again within 12 s, until the wheels have moved.
TEST(Situations, thirty_thousand_at_random_leave_nothing_that_matters_unsaid_overlapped_or_stale) {
#ifdef __SANITIZE_ADDRESS__
  constexpr int kShare = 10;  // it would take half an hour
#else
  constexpr int kShare = 1;
#endif
  const Verdict verdict = judge(30000 / kShare);
  EXPECT_EQ(verdict.complaints, std::set<std::string>{});
  EXPECT_GT(verdict.waits, 300 / kShare);
  EXPECT_GT(verdict.orders_of_way, 10000 / kShare);
  EXPECT_LT(verdict.longest_wait, 12.0);
  EXPECT_LT(verdict.longest_wait_alone, 8.0);
  EXPECT_LT(verdict.longest_owed, 12.0);
  EXPECT_GT(verdict.owed_again, 100 / kShare);
}

TEST(Situations, the_judge_sees_a_broken_rule) {
  GuideConfig late;
  late->link.delay = 3.0;
  EXPECT_EQ(judge(500, late).complaints.count("unsaid: no_route"), 1U);
  GuideConfig again;
  again->cues.same_text = 0.0;
  EXPECT_EQ(judge(500, again).complaints.count("the same again: direction"), 1U);
  GuideConfig patient;
  patient->cues.stuck_time = 10.0;
  SessionJudge session(patient);
  session.get_under_way();
  session.now.velocity = Velocity{};
  session.pass(6.0);
  EXPECT_EQ(session.complaints.count("pushed for 3 s in silence"), 1U);
}

}  // namespace
}  // namespace navvi_feedback::core
