// people_bench [TYPE]: published effects of guidance on people, beside what simulated persons
// show, with an interval of 95 % over persons: `./navvi bench people`. A row whose sign differs, or
// whose size is off by more than half where one is published, says so, and so does one whose
// interval leaves the sign open. A disagreement is a finding about the person, not a failure.

#include <ros/package.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <navvi_config/reader.hpp>
#include <navvi_types/angles.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "navvi_people/loop/closed_loop.hpp"
#include "navvi_people/people/listener.hpp"

namespace {

using namespace navvi_people;
using people::SimulatedOperatorConfig;

constexpr double kStep = 0.02;  // s
constexpr double kDegree = navvi_types::radians(1.0);
constexpr int kPeople = 200;
constexpr int kTrials = 40;
constexpr double kLimit = 300.0;  // s

std::string phrases() {
  return ros::package::getPath("navvi_feedback") + "/config/phrases/en.yaml";
}

SimulatedOperatorConfig person(const std::string& type, int seed) {
  SimulatedOperatorConfig config;
  navvi_config::read(config,
                     navvi_config::read_words({"type:=" + type, "seed:=" + std::to_string(seed)}),
                     "bench");
  return config.typed();
}

/// A robot without inertia on an empty floor, and its stick some time late.
class Rig {
 public:
  explicit Rig(const SimulatedOperatorConfig& config, double late = 0.0)
      : person_(config, people::Listener(phrases()), 1),
        hands_(static_cast<std::size_t>(std::lround(late / kStep)) + 1) {}

  void step() {
    time_ += kStep;
    hands_.push_back(person_.update(time_, kStep));
    const people::StickAndButtons hand = hands_.front();
    hands_.pop_front();
    rate_ = 1.2 * shaped(hand.left);
    yaw_ += rate_ * kStep;
  }
  void wait(double seconds) {
    for (const double end = time_ + seconds; time_ < end;) step();
  }
  /// \throws std::invalid_argument for words that are not the voice's: nobody would turn by them
  void say(const std::string& text) {
    static const people::Listener listener(phrases());
    if (listener.understand(text).empty())
      throw std::invalid_argument("\"" + text + "\" is not among the phrases in " + phrases() +
                                  ": change the benchmark's words with them");
    person_.hear(people::Speech{++id_, people::Speech::Moment::begins, text}, time_);
    wait(0.15 + static_cast<double>(text.size()) / 18.0);
    person_.hear(people::Speech{id_, people::Speech::Moment::ends}, time_);
  }
  void sound(navvi_types::Earcon earcon, double left, double right) {
    person_.hear(people::Sound{earcon, left, right}, time_);
  }
  [[nodiscard]] double yaw() const { return yaw_; }
  [[nodiscard]] double rate() const { return rate_; }

 private:
  static double shaped(double stick) {
    const double beyond = std::max(0.0, (std::abs(stick) - 0.12) / 0.88);
    return std::copysign(0.7 * beyond + 0.3 * beyond * beyond * beyond, stick);
  }

  people::SimulatedOperator person_;
  std::deque<people::StickAndButtons> hands_;
  std::uint32_t id_ = 0;
  double time_ = 100.0;
  double yaw_ = 0.0;
  double rate_ = 0.0;
};

/// deg, turned too far to the right by words.
double over_by_words(SimulatedOperatorConfig config, int hour) {
  config.hearing.faults = false;  // those who were measured had heard it
  Rig rig(config);
  rig.wait(2.0);
  rig.say("turn to " + std::to_string(hour) + " o'clock, 1 meter");
  rig.wait(6.0);
  return -rig.yaw() / kDegree - 30.0 * hour;
}

/// How early the sound to stop comes: by an angle, or by a time at the present rate.
struct Stop {
  double angle = 0.0;  ///< rad
  double delay = 0.0;  ///< s
};

/// deg, turned too far to the left by ticks that end in a sound to stop.
double over_by_ticks(const SimulatedOperatorConfig& config, double angle, Stop stop,
                     double late = 0.0) {
  Rig rig(config, late);
  rig.say("drive straight, 9 meters");
  rig.wait(3.0);
  const double target = rig.yaw() + angle;
  bool told = false;
  for (int i = 0; i < 400; ++i) {
    const double left = target - rig.yaw() - stop.angle - rig.rate() * stop.delay;
    if (!told && left <= 0.0) {
      told = true;
      rig.sound(navvi_types::Earcon::turn_stop, 0.3, 0.3);
    }
    // As the guide's: the faster, the less is left.
    const int every = left > 1.0 ? 20 : left > 0.5 ? 12 : 8;
    if (!told && i % every == 0) rig.sound(navvi_types::Earcon::turn, 0.6, 0.0);
    rig.step();
  }
  return (rig.yaw() - target) / kDegree;
}

/// One value a person, each of another seed.
using Sample = std::vector<double>;

Sample each(const std::string& type, const std::function<double(SimulatedOperatorConfig)>& of) {
  Sample all;
  for (int seed = 1; seed <= kPeople; ++seed) all.push_back(of(person(type, seed)));
  return all;
}

double mean(const Sample& all, std::size_t but = std::string::npos) {
  double sum = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) sum += i == but ? 0.0 : all[i];
  return sum / static_cast<double>(but < all.size() ? all.size() - 1 : all.size());
}

struct Estimate {
  double value = 0.0;
  double error = 0.0;  ///< standard error
};

/// With the standard error of the jackknife.
/// \param statistic  of all n persons but one; n: of all
Estimate estimate(std::size_t n, const std::function<double(std::size_t but)>& statistic) {
  Sample without;
  for (std::size_t i = 0; i < n; ++i) without.push_back(statistic(i));
  double squares = 0.0;
  for (const double value : without) squares += std::pow(value - mean(without), 2);
  return {statistic(n), std::sqrt(squares * static_cast<double>(n - 1) / static_cast<double>(n))};
}

/// Of the means of the same persons.
Estimate difference(const Sample& a, const Sample& b) {
  return estimate(a.size(), [&](std::size_t but) { return mean(a, but) - mean(b, but); });
}
Estimate ratio(const Sample& a, const Sample& b) {
  return estimate(a.size(), [&](std::size_t but) { return mean(a, but) / mean(b, but); });
}

/// s that the person takes from the sound to the stop, on the mean: what a guide would learn.
double delay_of(const std::string& type) {
  return mean(each(type, [](auto who) { return over_by_ticks(who, 1.5, {}) * kDegree; })) / 1.2;
}

/// What turns on the spot leave of the way to where the guide leads.
class Leavings {
 public:
  void watch(const loop::ClosedLoop& trial) {
    if (trial.told().guidance) course_ = *trial.told().guidance;
    const auto& robot = trial.session().world().now().robot;
    const bool turns = std::abs(robot.turn_rate) > 0.1;
    if (turns && std::abs(robot.forward_speed()) < 0.5 * std::abs(robot.turn_rate)) {
      turned_ += std::abs(robot.turn_rate) * trial.dt();
      still_ = 0.0;
    } else {
      still_ += trial.dt();
    }
    if (turned_ == 0.0 || still_ < 0.3) return;
    if (turned_ > 15.0 * kDegree && course_.state == navvi_msgs::Guidance::FOLLOWING)
      all_.push_back(std::abs(course_.steer_angle) / kDegree);
    turned_ = 0.0;
  }
  /// deg, one a turn
  [[nodiscard]] const std::vector<double>& all() const { return all_; }

 private:
  navvi_msgs::Guidance course_;
  double turned_ = 0.0;  ///< rad
  double still_ = 0.0;   ///< s
  std::vector<double> all_;
};

/// Whole sessions, one value a trial: s, how far from the path on the mean, m, and what each turn
/// left, deg.
struct Ways {
  Sample time;
  Sample offset;
  std::vector<std::vector<double>> left;
};
Ways drive(const std::string& type, const std::vector<std::string>& words) {
  Ways all;
  for (int seed = 1; seed <= kTrials; ++seed) {
    loop::ClosedLoopConfig config;
    std::vector<std::string> set = words;
    set.insert(set.end(), {"sim/world:=easy", "sim/seed:=" + std::to_string(seed),
                           "person/type:=" + type, "person/seed:=" + std::to_string(seed)});
    navvi_config::read(config, navvi_config::read_words(set), "bench");
    loop::ClosedLoop trial(config, loop::Spoken(phrases()));
    Leavings left;
    double offset = 0.0;
    int guidances = 0;
    const auto goal = [&] {
      return (trial.session().world().now().robot.position - trial.scenario().goal).norm();
    };
    while (trial.time() < kLimit && goal() > 1.0 && trial.step()) {
      left.watch(trial);
      if (!trial.told().guidance) continue;
      offset += std::abs(trial.told().guidance->path_offset);
      ++guidances;
    }
    all.time.push_back(trial.time());
    all.offset.push_back(guidances > 0 ? offset / guidances : 0.0);
    all.left.push_back(left.all());
  }
  return all;
}

/// Of what the turns of all trials but one left, deg.
double median(const std::vector<std::vector<double>>& left, std::size_t but) {
  std::vector<double> all;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (i != but) all.insert(all.end(), left[i].begin(), left[i].end());
  if (all.empty()) return 0.0;
  const auto middle = all.begin() + static_cast<long>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

struct Published {
  const char* effect;
  const char* source;
  double size = 0.0;   ///< 0: only its sign is published
  double none = 0.0;   ///< what would be measured without the effect
  bool below = false;  ///< the effect is less than that
};

std::string verdict(const Published& known, const Estimate& here) {
  const double effect = (known.below ? -1.0 : 1.0) * (here.value - known.none);
  if (std::abs(effect) <= 1.96 * here.error) return "sign open";
  if (effect < 0.0) return "DISAGREES in sign";
  if (known.size != 0.0 && std::abs(here.value / known.size - 1.0) > 0.5)
    return "agrees in sign, DISAGREES in size";
  return "agrees";
}

void row(const Published& known, const Estimate& here) {
  char size[32] = "sign";
  if (known.size != 0.0) std::snprintf(size, sizeof size, "%.1f", known.size);
  std::printf("| %s | %s | %s | %.2f [%.2f, %.2f] | %s |\n", known.effect, known.source, size,
              here.value, here.value - 1.96 * here.error, here.value + 1.96 * here.error,
              verdict(known, here).c_str());
  std::fflush(stdout);
}

void turns(const std::string& type) {
  const double delay = delay_of(type);
  const auto error = [](auto who, double angle, Stop stop, double late = 0.0) {
    return std::abs(over_by_ticks(who, angle, stop, late));
  };
  const Stop early{0.0, delay};
  row({"error of turns by words over that by a turn sound, the robot never slowed down",
       "PerCom'19, 28 people", 3.5, 1.0},
      ratio(each(type, [](auto who) { return std::abs(over_by_words(who, 3)); }),
            each(type, [&](auto who) { return error(who, 1.5, early); })));
  row({"slight turns over-rotated more than ample ones, deg", "ASSETS'18, 11 people", 4.0},
      difference(each(type, [](auto who) { return over_by_words(who, 1); }),
                 each(type, [](auto who) { return over_by_words(who, 3); })));
  const auto stopped = [&](Stop stop) {
    return each(type, [=](auto who) {
      double sum = 0.0;
      for (const double angle : {0.5, 1.0, 1.5, 2.5}) sum += error(who, angle, stop);
      return sum / 4.0;
    });
  };
  row({"a stop at a fixed angle errs more than an anticipated one, deg", "TACCESS'19, 11 people"},
      difference(stopped({1.2 * delay, 0.0}), stopped(early)));
  // The guide does not know of the delay.
  const auto delayed = [&](double late) {
    return each(type,
                [=](auto who) { return error(who, 1.5, early, late) - error(who, 1.5, early); });
  };
  const Sample long_delay = delayed(0.5);
  row({"500 ms between stick and robot add to the error of turns, deg",
       "arXiv 2508.18074, 10 people"},
      difference(long_delay, Sample(long_delay.size(), 0.0)));
  row({"100 ms do not, as a share of that", "arXiv 2508.18074, 10 people", 0.0, 0.25, true},
      ratio(delayed(0.1), long_delay));
}

void second_turns(const std::string& type) {
  const auto missed = [&](double speed) {
    return each(type, [=](SimulatedOperatorConfig who) {
      who.driving.cruise = speed;
      Rig rig(who);
      rig.wait(2.0);
      rig.say("3 o'clock");
      rig.say("9 o'clock");
      rig.wait(8.0);
      return rig.yaw() < -45.0 * kDegree ? 1.0 : 0.0;
    });
  };
  row({"the quick miss a second turn soon after the first more often, share",
       "IMWUT'18, 12 people"},
      difference(missed(1.0), missed(0.6)));
}

void ways(const std::string& type) {
  const std::string deaf = "feedback/sounds/enabled:=false";
  const std::string numb = "feedback/haptics/enabled:=false";
  const Ways speech = drive(type, {deaf, numb});
  const Ways spatial = drive(type, {numb});
  const Ways beacon =
      drive(type, {numb, "feedback/lead:=words", "feedback/sounds/beacon/on:=true"});
  const std::vector<std::string> by_hand = {deaf, "speech:=false", "feedback/lead:=hand"};
  const Ways touch = drive(type, by_hand);
  const Ways lasting = drive(type, {numb, "feedback/lead:=flow"});
  const Ways in_noise =
      drive(type, {numb, "feedback/lead:=flow", "person/hearing/noise:=0.5"});
  row({"error of turns by words over that by the guide's turn sound", "PerCom'19, 28 people", 3.5,
       1.0},
      estimate(kTrials, [&](std::size_t but) {
        return median(speech.left, but) / median(spatial.left, but);
      }));
  row({"sounds from the side to turn to are quicker than speech, s", "Loomis 1998, Marston 2006"},
      difference(speech.time, spatial.time));
  row({"a beacon is quicker than speech, s", "Marston 2006, 8 people"},
      difference(speech.time, beacon.time));
  row({"a sound that lasts is quicker than turns on the spot by ticks, s", "CHI'18, 15 people"},
      difference(spatial.time, lasting.time));
  row({"touch is slower than sound in silence, s", "Front. Hum. Neurosci. 2019, 12 people"},
      difference(touch.time, lasting.time));
  row({"and less so in noise, s", "Front. Hum. Neurosci. 2019, 12 people"},
      difference(in_noise.time, lasting.time));
  row({"touch alone is slower than speech, s", "ToH 2015, 10 people"},
      difference(touch.time, speech.time));
  row({"touch alone is closer to the path than speech, m", "ToH 2015, 10 people"},
      difference(speech.offset, touch.offset));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string type = argc > 1 ? argv[1] : "typical";
    std::printf("| effect, %s | published | size | here | |\n|---|---|---|---|---|\n",
                type.c_str());
    turns(type);
    second_turns(type);
    ways(type);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navvi: %s\n", error.what());
    return 2;
  }
}
