#include "devices/earcon_player.hpp"

#include "devices/earcons.hpp"

namespace navvi_feedback::devices {
namespace {

constexpr double kLowest = 0.5;  // times the pitch of full speed: an octave down, at rest

}  // namespace

EarconPlayer::EarconPlayer(Mixer& mixer) : mixer_(mixer) {
  for (std::size_t i = 0; i < names(sounds::Earcon{}).size(); ++i) {
    const auto earcon = static_cast<sounds::Earcon>(i);
    sounds_[earcon] = synthesize(earcon);
  }
}

std::vector<sounds::Play> EarconPlayer::play(const std::vector<sounds::Play>& plays) {
  std::vector<sounds::Play> heard;
  for (const sounds::Play& play : plays)
    if (mixer_.play(sounds_.at(play.earcon), play.volume, play.from)) heard.push_back(play);
  return heard;
}

bool EarconPlayer::hold(const haptics::Rumble& flow, double volume) {
  const double sum = flow.left + flow.right;
  if (sum <= 0.0) return mixer_.hold(sounds_.at(sounds::Earcon::flow), 0.0, 1.0, 0.0);
  return mixer_.hold(sounds_.at(sounds::Earcon::flow), volume, kLowest + (1.0 - kLowest) * sum,
                     (flow.left - flow.right) / sum);
}

}  // namespace navvi_feedback::devices
