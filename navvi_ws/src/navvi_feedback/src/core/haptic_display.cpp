#include "core/haptic_display.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cues/side.hpp"
#include "cues/surroundings.hpp"

namespace navvi_feedback::core {
namespace {

/// s, without pulses of the way before and after a pattern.
constexpr double kApart = 0.4;
constexpr double kAhead = 0.79;      // rad
constexpr double kMetresATap = 5.0;  // m
constexpr double kMostTaps = 8.0;
constexpr int kTaughtTaps = 3;

bool is_hit(haptics::Pattern pattern) {
  return pattern == haptics::Pattern::hit_obstacle || pattern == haptics::Pattern::hit_shelf;
}

haptics::Zone zone_of(const Contact& contact) {
  const cues::Side side = cues::side_of(contact.seen_from_robot());
  return side == cues::Side::left    ? haptics::Zone::left
         : side == cues::Side::right ? haptics::Zone::right
                                     : haptics::Zone::center;
}

/// What is felt when a cue is said; the cues that are not here are for the ear alone, unless
/// nothing can be heard.
std::optional<haptics::Pattern> pattern_of(const cues::Cue& cue, bool deaf) {
  using haptics::Pattern;
  if (const auto pattern = traits(cue.kind).felt) return pattern;
  const bool alarm = cue.kind == CueKind::guidance_lost ||
                     (cue.priority == Priority::important && cue.kind != CueKind::collision);
  return deaf && alarm ? std::optional(Pattern::stopped) : std::nullopt;
}

haptics::Zone side_of(haptics::Pattern pattern, DriveState::Assistance assistance) {
  using Assistance = DriveState::Assistance;
  if (pattern != haptics::Pattern::assisted) return haptics::Zone::center;
  return assistance == Assistance::steers_left    ? haptics::Zone::left
         : assistance == Assistance::steers_right ? haptics::Zone::right
                                                  : haptics::Zone::center;
}

}  // namespace

void HapticDisplay::use(const haptics::HapticsConfig& config) {
  config_ = config;
  near_.use(config);
}

void HapticDisplay::use_pad(const std::string& pad) {
  if (std::exchange(pad_, pad) != pad) near_.use_pad(pad);
}

bool HapticDisplay::report(Link audio, bool motors) {
  deaf_ = config_.enabled && config_.instead_of_words && audio != Link::alive;
  if (audio == Link::alive) {
    if (std::exchange(alarmed_, false) && playing() == haptics::Pattern::no_sound) patterns_.stop();
    return false;
  }
  const bool begins = motors && !std::exchange(alarmed_, true);
  if (begins) patterns_.begin(haptics::Pattern::no_sound);
  return begins;
}

void HapticDisplay::begin(const std::vector<cues::Cue>& cues, const Observation& now,
                          const lessons::Taught& taught) {
  if (!config_.enabled || !config_.patterns) return;
  const int taps = taught.pattern == haptics::Pattern::answer ? kTaughtTaps : 0;
  if (taught.pattern) patterns_.begin(*taught.pattern, taught.side, taps);
  // The pulses of the way tell of a new route.
  for (const cues::Cue& cue : cues)
    if (const auto pattern = pattern_of(cue, deaf_);
        pattern && !(now.lead == Lead::hand && pattern == haptics::Pattern::rerouted))
      patterns_.begin(*pattern, side_of(*pattern, now.assistance));
  for (const Contact& contact : now.contacts)
    patterns_.begin(cues::is_structure(contact.thing_class) ? haptics::Pattern::hit_shelf
                                                            : haptics::Pattern::hit_obstacle,
                    zone_of(contact));
}

bool HapticDisplay::feels_near(const Observation& now) const {
  return now.links.proximity == Link::alive && now.links.simulator != Link::lost &&
         !(now.arrived() && config_.rest_at_goal);
}

void HapticDisplay::answer(double angle, double distance) {
  const haptics::Zone side = std::abs(angle) < kAhead ? haptics::Zone::center
                             : angle > 0.0            ? haptics::Zone::right
                                                      : haptics::Zone::left;
  const double taps = std::clamp(std::ceil(distance / kMetresATap), 1.0, kMostTaps);
  patterns_.begin(haptics::Pattern::answer, side, static_cast<int>(taps));
}

/// A pattern stands apart from the pulses, but for a hit, which is felt at once.
haptics::Rumble HapticDisplay::lead_by_hand(const std::optional<lead::Course>& course, double dt) {
  apart_ += dt;
  if (course && patterns_.playing() == haptics::Pattern::halt) patterns_.stop();
  const auto wanted = patterns_.playing();
  const bool begins = wanted && (felt_pattern_ || apart_ >= kApart || is_hit(*wanted));
  const auto pattern = begins ? patterns_.update(dt) : std::nullopt;
  if (felt_pattern_ != pattern.has_value()) apart_ = 0.0;
  felt_pattern_ = pattern.has_value();
  const bool rests = wanted || (apart_ < kApart && !pulsed_);
  const haptics::Rumble pulse =
      pulses_.update(rests || !config_.enabled ? std::nullopt : course, dt);
  if (pulse.left + pulse.right > 0.0) apart_ = 0.0;
  pulsed_ = !rests;
  const haptics::Rumble felt = pattern.value_or(pulse);
  return {config_.strength * felt.left, config_.strength * felt.right, true};
}

haptics::Rumble HapticDisplay::update(const Observation& now,
                                      const std::optional<lead::Course>& course,
                                      const lessons::Taught& taught, bool urgent, double dt) {
  if (taught.rumble) return *taught.rumble;
  if (now.lead == Lead::hand && taught.near.empty()) return lead_by_hand(course, dt);
  const haptics::Rumble felt = taught.near.empty()
                                   ? near_.update(now.nearby, feels_near(now), dt)
                                   : near_.update(taught.near, true, dt);
  if (const auto pattern = patterns_.update(dt))
    return {config_.strength * pattern->left, config_.strength * pattern->right};
  const double share = urgent ? config_.duck : 1.0;
  return {share * felt.left, share * felt.right};
}

}  // namespace navvi_feedback::core
