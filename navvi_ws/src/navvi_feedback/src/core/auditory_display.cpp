#include "core/auditory_display.hpp"

#include <algorithm>
#include <cmath>

#include "cues/surroundings.hpp"

namespace navvi_feedback::core {

using sounds::Earcon;

namespace {

/// s, between two pulses of what is at hand, and of what is `kFar` off (m) or more.
constexpr double kFast = 0.13;
constexpr double kSlow = 1.1;
constexpr double kFar = 10.0;

bool due(std::optional<double>& last, double distance, double time) {
  const double share = std::clamp(distance / kFar, 0.0, 1.0);
  if (last && time - *last < kFast + (kSlow - kFast) * share) return false;
  last = time;
  return true;
}

/// m, in base_link: where to go next.
std::optional<Eigen::Vector2d> waypoint(const Observation& now,
                                        const AuditoryDisplay::Steering& lead) {
  if (!lead.off || !now.guidance || now.guidance->waypoint_distance <= 0.0) return std::nullopt;
  const double angle = now.guidance->waypoint_angle + now.turned;
  return now.guidance->waypoint_distance * Eigen::Vector2d(std::cos(angle), -std::sin(angle));
}

}  // namespace

void AuditoryDisplay::use(const sounds::SoundsConfig& config) {
  config_ = config;
  turn_.use(config.turn);
}

std::optional<sounds::Learnt> AuditoryDisplay::learnt() const {
  return config_.enabled ? std::optional(turn_.learnt()) : std::nullopt;
}

sounds::Play AuditoryDisplay::sample(Earcon earcon) const {
  return {earcon, Eigen::Vector2d::UnitX(), config_.family_of(earcon).volume};
}

std::vector<sounds::Play> AuditoryDisplay::update(std::vector<cues::Cue>& cues,
                                                  const Observation& now, const Steering& lead,
                                                  const lessons::Taught& taught, double time) {
  std::vector<sounds::Play> plays;
  for (cues::Cue& cue : cues)
    for (sounds::Play& play : cue.scan) {
      const sounds::FamilyConfig& family = config_.family_of(play.earcon);
      play.volume = now.audible && family.on ? family.volume : 0.0;
    }
  if (!now.audible) return plays;
  const auto add = [&](Earcon earcon, const Eigen::Vector2d& from) {
    const sounds::FamilyConfig& family = config_.family_of(earcon);
    if (family.on) plays.push_back({earcon, from, family.volume});
  };
  for (const cues::Cue& cue : cues) {
    if (cue.sound) add(cue.sound->earcon, cue.sound->from);
    if (cue.kind == CueKind::arrived) add(Earcon::arrived, Eigen::Vector2d::UnitX());
    if (cue.kind != CueKind::collision) continue;
    for (const Contact& contact : now.contacts)
      add(cues::is_structure(contact.thing_class) ? Earcon::hit_shelf : Earcon::hit_obstacle,
          contact.seen_from_robot());
  }
  cues.erase(std::remove_if(cues.begin(), cues.end(),
                            [](const cues::Cue& cue) { return cue.sound.has_value(); }),
             cues.end());
  plays.insert(plays.end(), taught.plays.begin(), taught.plays.end());
  add_recurring(now, lead, time, plays);
  // Words win, and yet a turn is counted down. What was hit is as loud as ever.
  for (sounds::Play& play : plays) {
    if (!now.voice_busy || &config_.family_of(play.earcon) == &config_.hit) continue;
    if (play.earcon == Earcon::turn) play.earcon = Earcon::turn_click;
    play.volume *= config_.kUnderWords;
  }
  return plays;
}

void AuditoryDisplay::add_recurring(const Observation& now, const Steering& lead, double time,
                                    std::vector<sounds::Play>& plays) {
  const auto turn = turn_.update(now.lead == Lead::ticks ? lead.off : std::nullopt, lead.fine,
                                 lead.motion, time);
  if (turn) plays.push_back(*turn);
  const bool lasts = now.lead == Lead::flow && lead.off;
  if (const auto tick = notice_.update(now, lasts, config_.turn.volume, time))
    plays.push_back(*tick);
  const auto next = waypoint(now, lead);
  if (config_.beacon.on && next && next->norm() > config_.kCaptureRadius &&
      due(beacon_, next->norm(), time))
    plays.push_back({Earcon::beacon, *next, config_.beacon.volume});
}

}  // namespace navvi_feedback::core
