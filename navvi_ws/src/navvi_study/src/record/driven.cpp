#include "record/driven.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>
#include <navvi_types/cue_kind.hpp>

namespace navvi_study::record {
namespace {

constexpr double kTurns = 0.15;   // rad/s; slower does not begin a turn
constexpr double kStands = 0.1;   // rad/s
constexpr double kSettled = 0.3;  // s
constexpr double kRadius = 0.5;   // m; a wider one is no turn on the spot
constexpr double kLeast = navvi_types::radians(15.0);
constexpr double kActs = 5.0;     // s; what is done later is not for that cue
constexpr double kRounding = 1e-9;  // s

constexpr double kStay = 0.3;    // m; who does not leave this circle stands still
constexpr double kInVain = 3.0;  // s
constexpr double kPushed = 0.2;  // of the stick
constexpr double kStill = 0.05;  // m/s and rad/s
constexpr float kNearby = 1.5F;  // m; what is farther away does not hold a robot up

bool asks_to_turn(const TrackRow& row) {
  if (row.cue.empty() && row.sounds.empty()) return false;
  const auto told = navvi_types::from_word<navvi_types::Content>(row.cue.text());
  const std::string sounds = " " + row.sounds.text() + " ";
  return (told && traits(told->kind).ask == navvi_types::Ask::turn) ||
         sounds.find(" turn ") != std::string::npos;
}

class Turning {
 public:
  void watch(const TrackRow& row) {
    const double dt = row.time - time_, rate = row.turn_rate;
    time_ = row.time;
    if (asks_to_turn(row) && !turns_ && !asked_) asked_ = time_;
    if (!turns_ && std::abs(rate) > kTurns && std::abs(row.speed) <= kRadius * std::abs(rate))
      begin();
    if (asked_ && time_ - *asked_ >= kActs) asked_.reset();
    if (!turns_) return;
    turned_ += rate * dt;
    if (std::abs(rate) > kStands) still_since_.reset();
    if (std::abs(rate) <= kStands && !still_since_) still_since_ = time_;
    if (!still_since_ || time_ - *still_since_ < kSettled - kRounding) return;
    turns_ = false;
    still_since_.reset();
    if (std::isfinite(row.steer) && std::abs(turned_) > kLeast)
      found_.left.push_back(std::abs(row.steer));
  }
  [[nodiscard]] const Turns& found() const { return found_; }

 private:
  void begin() {
    turns_ = true;
    turned_ = 0.0;
    if (asked_ && time_ - *asked_ < kActs) found_.late.push_back(time_ - *asked_);
    asked_.reset();
  }

  Turns found_;
  double turned_ = 0.0;                // rad, of this turn
  std::optional<double> still_since_;  // s, no faster than a robot that stands
  std::optional<double> asked_;        // s, and not acted upon
  bool turns_ = false;
  double time_ = 0.0;  // s, of the last row
};

/// What is about, for a person who stands. \param spoken  the last sentence
std::string about(const TrackRow& row, const std::string& spoken) {
  std::string text = row.state.text();
  if (const std::string by = row.blocked_by.text(); !by.empty()) text += " by " + by;
  if (row.gap < kNearby)
    text += ", " + row.nearest.text() + " at " + fixed(static_cast<double>(row.gap), 2) + " m";
  return text + ", \"" + spoken + "\"";
}

/// The last sentence of the guide up to that s of ROS time.
std::string spoken_until(const Trial& trial, double time) {
  std::string text;
  for (const Row& row : trial.rows)
    if (row.type == "CUE" && row.fields.get("modality") == "speech" && time_of(row) <= time)
      text = row.fields.get("text");
  return text;
}

}  // namespace

Turns turns_of(const Trial& trial) {
  Turning turning;
  for (const TrackRow& row : trial.track) turning.watch(row);
  return turning.found();
}

Stands stands_of(const Trial& trial) {
  Stands found;
  if (trial.track.empty()) return found;
  std::optional<double> pushed;  // s, since when in vain and in silence
  const TrackRow* stay = &trial.track.front();
  const TrackRow* longest = stay;
  double since = trial.begin();  // s, of this stay
  for (const TrackRow& row : trial.track) {
    const bool pushes = std::max(std::abs(row.stick_forward), std::abs(row.stick_left)) > kPushed;
    const bool still = std::abs(row.speed) < kStill && std::abs(row.turn_rate) < kStill;
    const bool silent = row.cue.empty() && row.sounds.empty();
    if (!pushes || !still || !silent) pushed.reset();
    if (!pushed && pushes && still) pushed = row.time;
    // A person who pushes in vain, and hears nothing, does not know why.
    if (pushed && row.time - *pushed >= kInVain - kRounding) {
      ++found.speechless;
      pushed = row.time;
    }
    if (row.time - since > found.longest) {
      found.longest = row.time - since;
      found.since = since - trial.begin();
      longest = &row;
    }
    if (Eigen::Vector2d(row.x - stay->x, row.y - stay->y).norm() <= kStay) continue;
    stay = &row;
    since = row.time;
  }
  found.about = about(*longest, spoken_until(trial, longest->time));
  return found;
}

}  // namespace navvi_study::record
