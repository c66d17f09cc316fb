#include "navvi_people/people/feeling.hpp"

#include <algorithm>

namespace navvi_people::people {
namespace {

constexpr double kJolt = 0.25;    // of a motor, at once: a pulse begins or ends
constexpr double kRest = 0.3;     // s without a pulse: the row is over
constexpr double kLongest = 0.8;  // s; what lasts longer is no pulse
constexpr double kLong = 0.25;    // s; a pulse is short or long
constexpr double kHard = 0.8;     // of a motor
constexpr double kOneSide = 0.3;

double most(const Felt& felt) { return std::max(felt.left, felt.right); }

}  // namespace

void FeelingConfig::describe(navvi_config::Visitor& visit) {
  visit(faults, "faults", navvi_config::Any{}, "",
        "false: every pattern is recognised, and delays are all alike");
  visit(motors, "motors", navvi_config::Any{}, "", "feels the motors");
}

Felt Feeling::felt_of(const Felt& felt) const {
  const auto of = [&](double force) {
    return force < config_.threshold || !config_.motors ? 0.0 : force;
  };
  return {of(felt.left), of(felt.right)};
}

void Feeling::feel(const Felt& felt, double time) {
  const Felt force = felt_of(felt);
  edge(force, time);
  if (force.left == last_.left && force.right == last_.right) return;
  last_ = force;
  const double late =
      config_.faults ? random_.lognormal(config_.onset, config_.spread) : config_.onset;
  coming_.push_back({std::max(time + late, coming_.empty() ? 0.0 : coming_.back().time), force});
}

/// Jolts are where pulses begin and end; what swells and ebbs has none.
void Feeling::edge(const Felt& felt, double time) {
  const double jolt = most(felt) - most(last_);
  if (jolt >= kJolt && !pulse_) {
    pulse_ = Pulse{time, time, felt};
  } else if (pulse_ && jolt <= -kJolt) {
    pulse_->ends = time;
    row_.push_back(*pulse_);
    pulse_.reset();
  }
}

Meaning Feeling::meaning(const std::vector<Pulse>& row) const {
  const auto length = [&](std::size_t i) { return row[i].ends - row[i].begins; };
  const auto hard = [&](std::size_t i) { return most(row[i].force) >= kHard; };
  const std::size_t last = row.size() - 1;
  if (row.size() >= 4) return hard(0) ? Meaning::stuck : Meaning::none;
  const auto rises = [&](std::size_t i) {
    return std::min(row[i].force.left, row[i].force.right) > most(row[i - 1].force);
  };
  if (row.size() == 3) return rises(1) && rises(2) ? Meaning::arrived : Meaning::none;
  if (row.size() == 1) {
    if (hard(0)) return length(0) > kLong ? Meaning::hit : Meaning::none;
    return Meaning::begun;
  }
  const bool apart = row[0].force.left > row[0].force.right + kOneSide &&
                     row[last].force.right > row[last].force.left + kOneSide;
  if (apart) return Meaning::new_way;
  if (!hard(0)) return Meaning::ready;
  if (length(last) > kLong) return length(0) > kLong ? Meaning::stop : Meaning::halt;
  return Meaning::hit;
}

Feeling::Now Feeling::update(double time) {
  while (!coming_.empty() && coming_.front().time <= time) {
    now_ = coming_.front().force;
    coming_.pop_front();
  }
  if (pulse_ && time - pulse_->begins > kLongest) pulse_.reset();
  if (!row_.empty() && !pulse_ && time - row_.back().ends > kRest) {
    const bool known = random_.chance(config_.recognised) || !config_.faults;
    // It was felt while it came; the reaction counts from its end, not from the end of the rest.
    const double late =
        config_.faults ? random_.lognormal(config_.reading, config_.spread) : config_.reading;
    const Meaning what = meaning(row_);
    if (known && what != Meaning::none) meant_.emplace_back(row_.back().ends + late, what);
    row_.clear();
  }
  Now now{now_, Meaning::none};
  if (!meant_.empty() && meant_.front().first <= time) {
    now.meaning = meant_.front().second;
    meant_.pop_front();
  }
  return now;
}

}  // namespace navvi_people::people
