#include "core/haptic_display.hpp"

#include <utility>

#include "cues/side.hpp"
#include "cues/structure.hpp"

namespace navvi_feedback::core {
namespace {

haptics::Zone zone_of(const Contact& contact) {
  switch (cues::side_of(contact.seen_from_robot())) {
    case cues::Side::left:
      return haptics::Zone::left;
    case cues::Side::right:
      return haptics::Zone::right;
    case cues::Side::ahead:
    case cues::Side::behind:
      break;
  }
  return haptics::Zone::center;
}

/// What is felt when a cue is said; the cues that are not here are for the ear alone, unless
/// nothing can be heard.
std::optional<haptics::Pattern> pattern_of(const cues::Cue& cue, bool deaf) {
  using haptics::Pattern;
  if (const auto pattern = traits(cue.kind).felt) return pattern;
  const bool alarm =
      cue.kind == CueKind::guidance_lost ||
      (cue.priority == Priority::important && family_of(cue.kind) != cues::Family::hit);
  return deaf && alarm ? std::optional(Pattern::stopped) : std::nullopt;
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
  deaf_ = config_.instead_of_words && audio != Link::alive;
  if (audio == Link::alive) {
    if (std::exchange(alarmed_, false) && playing() == haptics::Pattern::no_sound) patterns_.stop();
    return false;
  }
  const bool begins = motors && !std::exchange(alarmed_, true);
  if (begins) patterns_.begin(haptics::Pattern::no_sound);
  return begins;
}

void HapticDisplay::begin(const std::vector<cues::Cue>& cues, const std::vector<Contact>& contacts,
                          const lessons::Taught& taught) {
  if (!config_.enabled || !config_.patterns) return;
  if (taught.pattern) patterns_.begin(*taught.pattern, taught.side);
  for (const cues::Cue& cue : cues)
    if (const auto pattern = pattern_of(cue, deaf_)) patterns_.begin(*pattern);
  for (const Contact& contact : contacts) {
    patterns_.begin(cues::is_structure(contact.thing_class) ? haptics::Pattern::hit_shelf
                                                            : haptics::Pattern::hit_obstacle,
                    zone_of(contact));
  }
}

bool HapticDisplay::feels_near(const Observation& now) const {
  return now.links.proximity == Link::alive && now.links.simulator != Link::lost &&
         !(now.arrived() && config_.rest_at_goal);
}

haptics::Rumble HapticDisplay::update(const Observation& now, std::optional<double> off,
                                      const lessons::Taught& taught, bool urgent, double dt) {
  if (taught.rumble) return *taught.rumble;
  const haptics::Rumble felt = taught.near.empty()
                                   ? near_.update(now.nearby, feels_near(now), dt, off, deaf_)
                                   : near_.update(taught.near, true, dt);
  if (const auto pattern = patterns_.update(dt))
    return {config_.strength * pattern->left, config_.strength * pattern->right};
  const double share = urgent ? config_.duck : 1.0;
  return {share * felt.left, share * felt.right};
}

}  // namespace navvi_feedback::core
