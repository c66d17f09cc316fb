#include "cues/answers.hpp"

#include <utility>

#include "cues/link_cues.hpp"
#include "cues/near_words.hpp"
#include "cues/surroundings.hpp"
#include "cues/way_words.hpp"

namespace navvi_feedback::cues {
namespace {

/// s after the start, when a path may still be on its way.
constexpr double kFirstPath = 5.0;
/// s in which the way is told twice at most.
constexpr double kInsists = 6.0;

/// All of it from the robot's nose, and as the crow flies.
Utterance where_am_i(const Observation& now, Rounding rounding) {
  Utterance told{{CueKind::answer, About::where_place}};
  if (now.place) {
    told.fillings.place = static_cast<PlaceName>(now.place->kind);
    told.fillings.number = static_cast<int>(now.place->number);
  }
  if (now.goal_angle && now.guidance && now.guidance->leads()) {
    told.kind = CueKind::where;
    told.about = now.place ? About::none : About::goal;
    told.fillings.distance = now.goal_straight;
    told.fillings.hour = clock_hour(*now.goal_angle, rounding).value_or(12);
  }
  return told;
}

/// What needs no path, or one that leads to the goal.
std::optional<Utterance> about(Button question, const Tick& tick, Rounding rounding) {
  const Observation& now = tick.now;
  const bool to_goal = tick.follows && now.guidance->state == Guidance::State::following;
  if (question == Button::around) {
    if (tick.links.proximity != Link::alive) return Utterance{CueKind::proximity_lost};
    const bool far = now.connection.foresight > 0.0 && !stands(now);
    const auto stops = far ? stops_before(now.nearby, now.stops_in) : std::nullopt;
    return stops ? stops : around(now.nearby);
  }
  if (question == Button::where && (now.place || (to_goal && now.goal_angle)))
    return where_am_i(now, rounding);
  const bool ends = to_goal && now.guidance->ends_short && now.guidance->turn_angle == 0.0;
  if (question == Button::turn && to_goal && !now.guidance->waypoint_is_goal && !ends)
    return next_turn(*now.guidance, rounding);
  if (question == Button::goal && to_goal) return goal_words(CueKind::goal_info, now, rounding);
  return std::nullopt;
}

/// The way, or why there is none. \return nullopt: it may be on its way
std::optional<Utterance> about_the_way(const Tick& tick, RouteCues& route, const Halt& halt,
                                       const StateCues& state, const HeldStick& held) {
  if (tick.links.simulator == Link::lost) return Utterance{lost_robot(tick.now)};
  if (held.needed()) return Utterance{*held.needed()};
  if (tick.follows && halt.halted()) return halt.words();
  if (auto way = tick.follows ? route.ask(*tick.now.guidance, tick.time) : std::nullopt) {
    way->goes_on = halt.owes();
    return way;
  }
  const Content problem = state.problem().value_or(CueKind::welcome);
  if (problem != CueKind::welcome) return problem_words(problem, tick.now);
  if (tick.age < kFirstPath) return std::nullopt;
  return problem_words({CueKind::answer, About::no_goal}, tick.now);
}

}  // namespace

bool Answers::tells_way(double time) {
  if (time - way_at_.front() < kInsists) return false;
  way_at_ = {way_at_.back(), time};
  return true;
}

Utterances Answers::update(const Tick& tick, RouteCues& route, const Halt& halt,
                           const StateCues& state, const HeldStick& held) {
  if (tick.asked.menu) {
    Utterance label = *tick.asked.menu;
    label.asked = true;
    return {label};
  }
  const bool pressed = tick.asked.question && (tick.asked.question != Button::repeat ||
                                               halt.halted() || tells_way(tick.time));
  const auto question = pressed ? tick.asked.question : std::exchange(question_, std::nullopt);
  for_go_on_ = false;
  if (!question) return {};
  asked_ = question;
  std::optional<Utterance> answer = about(*question, tick, route.rounding());
  // What stopped the person is gone; to say it again would only put off "go on".
  if (!answer && tick.follows && halt.ends_soon() && !held.needed()) {
    question_ = question;
    for_go_on_ = true;
    return {};
  }
  if (!answer) answer = about_the_way(tick, route, halt, state, held);
  if (!answer) return {};
  // An answer is wanted at once, whatever was said just before.
  answer->priority = Priority::message;
  answer->asked = true;
  answered_ = *answer;
  return {*answer};
}

void Answers::yield(Utterances& answer) {
  if (std::exchange(for_go_on_, false)) question_.reset();
  if (answer.empty() || family_of(answer.front().kind) != Family::halt) return;
  answer.clear();
  answered_.reset();
}

void Answers::heard(const Content& content) {
  if (answered_ == content) answered_.reset();
}

void Answers::lost(const Content& content) {
  if (answered_ == content) question_ = asked_;
}

}  // namespace navvi_feedback::cues
