#include "batch/direction_figures.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_people/people/instruction.hpp>
#include <navvi_types/angles.hpp>

namespace navvi_study::batch {
namespace {

namespace people = navvi_people::people;
using navvi_types::CueKind;
using navvi_types::radians;

constexpr double kJustBefore = 8.0;  // s; of two directions, the later one is not news of its own
constexpr double kSamePlace = 1.5;   // m, likewise
constexpr double kContrary = radians(75.0);
constexpr double kReversed = radians(105.0);  // 4 hours, as hours are rounded
constexpr double kSoon = 4.0;                 // s, within which that confuses
constexpr double kHour = radians(30.0);

bool tells_new_way(CueKind kind) {
  switch (kind) {
    case CueKind::rerouted:
    case CueKind::rerouted_blocked:
    case CueKind::new_route:
    case CueKind::no_route:
    case CueKind::make_room:
      return true;
    default:
      return false;
  }
}

/// How many hours lie between two, the shorter way round.
int hours_between(int a, int b) {
  const int apart = std::abs(a - b) % 12;
  return std::min(apart, 12 - apart);
}

}  // namespace

void DirectionFigures::hear(const navvi_people::loop::ClosedLoop& loop,
                            const navvi_types::CueEvent& cue, double driven) {
  if (!cue.kind()) return;
  const CueKind kind = *cue.kind();
  const auto parts = loop.person().listener().understand(kind, cue.text);
  if (parts.empty()) return;
  const people::Instruction& instruction = parts.back();
  const bool new_way = tells_new_way(kind);
  const bool replaced =
      new_way || kind == CueKind::straight_then || kind == CueKind::turn_cancelled;
  if (replaced || driven > announced_until_) announced_.reset();
  if (kind == CueKind::turn_ahead) {
    announced_ = instruction.hour;
    announced_until_ = driven + instruction.distance.value_or(0.0) + kSamePlace;
    return;
  }
  const bool turn = instruction.asks == people::Ask::turn;
  if (!turn && instruction.asks != people::Ask::go) return;
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  const Said now{instruction.hour, robot.yaw - instruction.hour * kHour, loop.time(),
                 robot.position};
  const bool corner = kind == CueKind::turn_now;
  if (corner && announced_) {
    if (hours_between(*announced_, now.hour) > 1) ++misled_;
    announced_.reset();
  }
  if (said_) compare(now, corner, new_way);
  said_ = now;
}

void DirectionFigures::compare(const Said& now, bool corner, bool new_way) {
  if (said_->hour != now.hour) ++turns_;
  const double apart = std::abs(navvi_types::wrap(now.course - said_->course));
  const double since = now.time - said_->time;
  // Whoever has come to a corner is rightly sent elsewhere.
  if (!corner && since < kJustBefore && (now.place - said_->place).norm() < kSamePlace &&
      apart > kContrary)
    ++flips_;
  if (!corner && !new_way && since < kSoon && apart > kReversed) ++reversed_;
}

void DirectionFigures::add_to(record::Fields& row, double duration) const {
  row.set("turns", duration > 0.0 ? 60.0 * turns_ / duration : 0.0, 1);
  row.set("flips", std::uint64_t{flips_}).set("misled", std::uint64_t{misled_});
  row.set("reversed", std::uint64_t{reversed_});
}

}  // namespace navvi_study::batch
