#include "core/auditory_display.hpp"

#include <algorithm>

#include "cues/structure.hpp"

namespace navvi_feedback::core {

using sounds::Earcon;

void AuditoryDisplay::use(const sounds::SoundsConfig& config) {
  config_ = config;
  soundscape_.use(config);
}

sounds::Play AuditoryDisplay::sample(Earcon earcon) const {
  return {earcon, Eigen::Vector2d::UnitX(), config_.family_of(earcon).volume};
}

std::vector<sounds::Play> AuditoryDisplay::update(std::vector<cues::Cue>& cues,
                                                  const Observation& now,
                                                  const sounds::Soundscape::Steering& lead,
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
  const std::vector<sounds::Play> recurring = soundscape_.update(now, lead, time);
  plays.insert(plays.end(), recurring.begin(), recurring.end());
  // Words win, and yet a turn is counted down. What was hit is as loud as ever.
  for (sounds::Play& play : plays) {
    if (!now.voice_busy || &config_.family_of(play.earcon) == &config_.hit) continue;
    if (play.earcon == Earcon::turn) play.earcon = Earcon::turn_click;
    play.volume *= config_.kUnderWords;
  }
  return plays;
}

}  // namespace navvi_feedback::core
