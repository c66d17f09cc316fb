#include "lessons/glossary.hpp"

#include <cmath>
#include <navvi_types/angles.hpp>

namespace navvi_feedback::lessons {
namespace {

using drive::Button;
using haptics::Pattern;
using sounds::Earcon;

constexpr double kDegree = navvi_types::radians(1.0);
/// s, from one beat of what is given several times to the next.
constexpr double kBeat = 0.9;
/// s, of what is felt or counted continuously.
constexpr double kLong = 3.0;
/// s after a signal, when the buttons are told.
constexpr double kRemind = 10.0;
/// m, from which a thing comes near while it is felt.
constexpr double kFrom = 3.0;
/// deg, and deg/s, of the turn that is counted down.
constexpr double kTurn = 90.0;
constexpr double kRate = 35.0;
/// s and rad, of a way that is shown.
constexpr double kSweep = 6.0;
constexpr double kWide = 0.7;
/// Hour, where room is made.
constexpr int kAside = 4;

bool sided(Pattern pattern) {
  return pattern == Pattern::assisted || pattern == Pattern::answer ||
         pattern == Pattern::hit_obstacle || pattern == Pattern::hit_shelf;
}

}  // namespace

std::vector<Glossary::Entry> Glossary::all() {
  std::vector<Entry> entries;
  for (const cues::Side side : {cues::Side::left, cues::Side::right, cues::Side::ahead})
    entries.push_back({std::string("glossary_near_") + navvi_types::to_string(side), {}, {}, side});
  entries.push_back({"glossary_felt_hand"});
  entries.back().by_hand = true;
  for (std::size_t i = 0; i < names(Pattern{}).size(); ++i)
    entries.push_back({std::string("glossary_felt_") + names(Pattern{})[i], Pattern(i)});
  for (std::size_t i = 0; i < names(Earcon{}).size(); ++i)
    entries.push_back({std::string("glossary_sound_") + names(Earcon{})[i], {}, Earcon(i)});
  for (const CueKind kind : {CueKind::obstacle_stop, CueKind::blocked, CueKind::back_away,
                             CueKind::make_room, CueKind::go_on})
    entries.push_back({std::string("glossary_said_") + to_string(kind), {}, {}, {}, kind});
  for (const int hour : {12, 1, 3, 6, 9})
    entries.push_back(
        {"glossary_hour_" + std::to_string(hour), {}, {}, {}, CueKind::turn_now, hour});
  return entries;
}

std::vector<std::string> Glossary::texts() {
  std::vector<std::string> keys = {"glossary_welcome", "glossary_buttons", "glossary_end",
                                   "glossary_no_motors"};
  for (const Entry& entry : all()) keys.push_back(entry.text);
  return keys;
}

Glossary::Glossary(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons,
                   const haptics::HapticsConfig& haptics, const sounds::SoundsConfig& sounds)
    : haptics_(haptics),
      sounds_(sounds),
      clock_(phrases.wording().directions == "clock"),
      entries_(all()),
      teller_(phrases, buttons, texts()) {}

/// What a session does not give is not in its glossary.
bool Glossary::given(const Entry& entry, const Observation& seen) const {
  if (entry.hour > 0) return clock_;
  if (entry.by_hand) return seen.motors && haptics_.enabled;
  if (entry.near) return seen.motors && haptics_.enabled && haptics_.near;
  if (entry.pattern) return seen.motors && haptics_.enabled && haptics_.patterns;
  if (entry.earcon) return seen.audible && sounds_.enabled && sounds_.family_of(*entry.earcon).on;
  return true;
}

void Glossary::go(int steps, const Observation& seen) {
  const int step = steps < 0 ? -1 : 1;
  int at = static_cast<int>(at_);
  const int count = static_cast<int>(entries_.size());
  for (int left = std::abs(steps); left > 0;) {
    at += step;
    if (at < 0) return begin();
    if (at >= count) {
      leaving_ = true;
      return teller_.tell("glossary_end");
    }
    if (given(entries_[static_cast<std::size_t>(at)], seen)) --left;
  }
  at_ = static_cast<std::size_t>(at);
  begin();
}

void Glossary::begin() {
  teller_.tell(entries_[at_].text);
  given_.reset();
  reminded_ = false;
}

Taught Glossary::update(const Observation& seen, double time) {
  Taught taught;
  teller_.hands(seen.devices.keyboard);
  if (!welcomed_) {
    welcomed_ = true;
    teller_.tell("glossary_welcome");
    teller_.then("glossary_buttons");
    if (!seen.motors) teller_.then("glossary_no_motors");
    while (at_ + 1 < entries_.size() && !given(entries_[at_], seen)) ++at_;
    teller_.then(entries_[at_].text);
  }
  for (const Button button : seen.pressed) {
    if (leaving_) break;
    if (button == Button::next || button == Button::choose || button == Button::start) go(1, seen);
    if (button == Button::previous) go(-1, seen);
    if (button == Button::repeat) begin();
    if (button == Button::end || button == Button::back)
      go(static_cast<int>(entries_.size()), seen);
    if (button == Button::help) teller_.tell("glossary_buttons");
  }
  taught.cues = teller_.update(!seen.voice_busy);
  if (!teller_.done() || !taught.cues.empty() || (seen.voice_busy && !given_)) return taught;
  if (leaving_) {
    over_ = true;
    return taught;
  }
  if (!given_) {
    given_ = time;
    beats_ = 0;
  }
  give(entries_[at_], time - *given_, taught);
  if (time - *given_ > kRemind && !reminded_) {
    reminded_ = true;
    teller_.tell("glossary_buttons");
  }
  return taught;
}

/// The signal, `since` s after it began.
void Glossary::give(const Entry& entry, double since, Taught& taught) {
  if (entry.near && since < kLong) {
    const double gap = kFrom * (1.0 - since / kLong);
    navvi_types::NearThing thing;
    const auto felt = haptics_.classes.empty()
                          ? std::nullopt
                          : navvi_types::from_word<navvi_types::ThingClass>(haptics_.classes[0]);
    thing.thing_class = felt.value_or(navvi_types::ThingClass::box);
    thing.gap = gap;
    thing.nearest = (gap + haptics_.center + 0.3) * cues::direction_of(*entry.near);
    taught.near.push_back(thing);
  }
  if (entry.by_hand || entry.earcon == Earcon::flow) {
    // From the left over straight on to the right, ever faster.
    const double share = since / kSweep;
    if (share < 1.0)
      taught.course = Shown{{kWide * (2.0 * share - 1.0), share},
                            entry.by_hand ? Lead::hand : Lead::flow};
    return;
  }
  if (entry.earcon == Earcon::turn) {
    const double off = kTurn - kRate * since;
    taught.off = std::max(0.0, off) * kDegree;
    taught.motion = Velocity{0.0, off > 0.0 ? -kRate * kDegree : 0.0};
    return;
  }
  const int times = entry.words ? 1 : 2;
  const double lasts = entry.pattern == Pattern::answer ? 2.9 : entry.pattern ? 1.8 : 1.0;
  if (!entry.near && beats_ < times && since >= beats_ * kBeat * lasts) {
    beat(entry, taught);
    ++beats_;
  }
}

/// First from the left, then from the right, where it has a side.
void Glossary::beat(const Entry& entry, Taught& taught) {
  if (entry.pattern) {
    taught.pattern = entry.pattern;
    if (sided(*entry.pattern))
      taught.side = beats_ == 0 ? haptics::Zone::left : haptics::Zone::right;
  }
  if (entry.earcon) {
    const bool from_front = *entry.earcon == Earcon::turn_stop ||
                            *entry.earcon == Earcon::on_course || *entry.earcon == Earcon::arrived;
    const Eigen::Vector2d from = cues::direction_of(from_front    ? cues::Side::ahead
                                                    : beats_ == 0 ? cues::Side::left
                                                                  : cues::Side::right);
    taught.plays.push_back({*entry.earcon, from, sounds_.family_of(*entry.earcon).volume});
  }
  if (entry.words) {
    cues::Fillings fillings;
    fillings.thing = *entry.words == CueKind::make_room ? navvi_types::ThingClass::forklift
                                                        : navvi_types::ThingClass::shelf;
    fillings.side = cues::Side::ahead;
    fillings.hour = entry.hour > 0 ? entry.hour : kAside;
    fillings.distance = 2.0;
    teller_.then_phrase(*entry.words, fillings);
  }
}

}  // namespace navvi_feedback::lessons
