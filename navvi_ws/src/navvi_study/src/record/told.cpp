#include "record/told.hpp"

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <map>
#include <navvi_types/angles.hpp>
#include <navvi_types/cue_kind.hpp>

namespace navvi_study::record {
namespace {

using namespace navvi_types;

constexpr double kAnswered = 1.0;   // s, within which a question is answered
constexpr double kSame = 10.0;      // s; the same sentence again within it is a repeat
constexpr double kObey = 2.0;       // s, to hear a word to stop and let go of the stick
constexpr double kJustBefore = 8.0; // s; of two directions, the later one is not news of its own
constexpr double kSamePlace = 1.5;  // m, likewise
constexpr double kContrary = radians(75.0);
constexpr double kReversed = radians(105.0);  // 4 hours, as hours are rounded
constexpr double kSoon = 4.0;                 // s, within which that confuses
constexpr double kHour = radians(30.0);

bool is_spoken(const Row& row) { return row.fields.get("modality") == "speech"; }

std::optional<Content> told_in(const Row& row) {
  return navvi_types::from_word<Content>(row.fields.get("kind"));
}

class Ear {
 public:
  explicit Ear(const Trial& trial) : trial_(trial) {}

  void hear(const Row& row) {
    const double time = time_of(row);
    if (row.type == "CUE_END") {
      if (speaks_since_) speech_.talk += time - *speaks_since_;
      speaks_since_.reset();
      return;
    }
    speaks_since_ = time;
    const std::string text = row.fields.get("text");
    ++speech_.cues;
    speech_.words += 1 + static_cast<int>(std::count(text.begin(), text.end(), ' '));
    const bool asked = was_asked(time);
    const auto last = last_said_.find(text);
    if (!asked && last != last_said_.end() && time - last->second < kSame) ++speech_.repeats;
    last_said_[text] = time;
    judge_ahead(text, told_in(row), time);
    if (!asked) judge_waits(told_in(row), time);
  }
  [[nodiscard]] const Speech& speech() const { return speech_; }

 private:
  [[nodiscard]] bool was_asked(double time) {
    for (; next_ < trial_.track.size() && trial_.track[next_].time <= time; ++next_)
      if (trial_.track[next_].asks != 0) asked_ = trial_.track[next_].time;
    return just_now(asked_, time, kAnswered);
  }
  [[nodiscard]] static bool just_now(std::optional<double> then, double time, double span) {
    constexpr double kRounding = 1e-6;  // s
    return then && time - *then < span - kRounding;
  }
  void judge_ahead(const std::string& text, const std::optional<Content>& told, double time) {
    const bool straight = text.find("straight") != std::string::npos;
    const bool ahead = !straight && told != CueKind::start &&
                       boost::algorithm::ends_with(text, " ahead");
    if ((straight && just_now(ahead_, time, kObey)) || (ahead && just_now(straight_, time, kObey)))
      ++speech_.at_odds;
    if (straight) straight_ = time;
    if (ahead) ahead_ = time;
  }
  void judge_waits(const std::optional<Content>& told, double time) {
    // What is more urgent than to wait may well follow at once.
    const bool urgent = told && traits(told->kind).priority >= navvi_types::Priority::important;
    if (just_now(waited_, time, kObey) && !urgent) ++speech_.hasty;
    waited_.reset();
    if (!told || family_of(told->kind) != navvi_types::CueFamily::halt) return;
    ++speech_.waits;
    waited_ = time;
  }

  const Trial& trial_;
  Speech speech_;
  std::size_t next_ = 0;                 // row of the track
  std::optional<double> asked_;          // s, when the person last asked
  std::optional<double> speaks_since_;   // s
  std::optional<double> waited_;         // s, when the last cue was to wait or to stop
  std::optional<double> straight_, ahead_;  // s, when straight on, or that something is ahead, was said
  std::map<std::string, double> last_said_;  // s, by text
};

bool tells_new_way(const Content& told) {
  return told == CueKind::rerouted || told == CueKind::new_route || told == CueKind::make_room ||
         told == Content(CueKind::no_way, navvi_types::About::no_route);
}

/// How many hours lie between two, the shorter way round.
int hours_between(int a, int b) {
  const int apart = std::abs(a - b) % 12;
  return std::min(apart, 12 - apart);
}

/// A direction that was spoken, and where.
struct Said {
  int hour = 0;         // 0: nothing was said
  double course = 0.0;  // rad, in map
  double time = 0.0;
  double x = 0.0, y = 0.0;
};

class Compass {
 public:
  explicit Compass(const Trial& trial) : trial_(trial) {}

  void hear(const Row& row) {
    const auto told = told_in(row);
    const std::string asks = row.fields.get("asks");
    const TrackRow* at = trial_.at(time_of(row));
    if (!told || asks == "n/a" || at == nullptr) return;
    const int hour = static_cast<int>(row.fields.number("hour").value_or(12.0));
    const bool new_way = tells_new_way(*told);
    const bool replaced = new_way || told == CueKind::turn_cancelled ||
                          told == Content(CueKind::straight, navvi_types::About::then);
    if (replaced || driven(*at) > announced_until_) announced_ = 0;
    if (told == CueKind::turn_ahead) {
      announced_ = hour;
      announced_until_ = driven(*at) + row.fields.number("within").value_or(0.0) + kSamePlace;
      return;
    }
    if (asks != "turn" && asks != "go") return;
    const Said now{hour, at->yaw - hour * kHour, time_of(row), at->x, at->y};
    const bool corner = told == CueKind::turn_now;
    if (corner && announced_ != 0 && hours_between(announced_, hour) > 1) ++found_.misled;
    if (corner) announced_ = 0;
    if (said_.hour != 0) compare(now, corner, new_way);
    said_ = now;
  }
  [[nodiscard]] const Directions& found() const { return found_; }

 private:
  /// m, up to that row
  [[nodiscard]] double driven(const TrackRow& row) {
    for (; next_ < trial_.track.size() && trial_.track[next_].time <= row.time; ++next_) {
      if (next_ == 0) continue;
      const TrackRow &a = trial_.track[next_ - 1], &b = trial_.track[next_];
      driven_ += Eigen::Vector2d(b.x - a.x, b.y - a.y).norm();
    }
    return driven_;
  }
  void compare(const Said& now, bool corner, bool new_way) {
    if (said_.hour != now.hour) ++found_.turns;
    const double apart = std::abs(navvi_types::wrap(now.course - said_.course));
    const double since = now.time - said_.time;
    const bool same_place = Eigen::Vector2d(now.x - said_.x, now.y - said_.y).norm() < kSamePlace;
    // Whoever has come to a corner is rightly sent elsewhere.
    if (!corner && since < kJustBefore && same_place && apart > kContrary) ++found_.flips;
    if (!corner && !new_way && since < kSoon && apart > kReversed) ++found_.reversed;
  }

  const Trial& trial_;
  Directions found_;
  Said said_;
  int announced_ = 0;             // hour of the turn that comes; 0: none
  double announced_until_ = 0.0;  // m driven, where its corner is passed
  double driven_ = 0.0;           // m
  std::size_t next_ = 0;          // row of the track
};

}  // namespace

Speech speech_of(const Trial& trial) {
  Ear ear(trial);
  for (const Row& row : trial.rows)
    if ((row.type == "CUE" || row.type == "CUE_END") && is_spoken(row)) ear.hear(row);
  return ear.speech();
}

std::optional<Directions> directions_of(const Trial& trial) {
  const Row* start = trial.first("TRIAL_START");
  if (start == nullptr || !start->fields.find("phrases") || trial.track.empty()) return std::nullopt;
  Compass compass(trial);
  for (const Row& row : trial.rows)
    if (row.type == "CUE" && is_spoken(row)) compass.hear(row);
  return compass.found();
}

}  // namespace navvi_study::record
