#include "devices/earcon_player.hpp"

#include "devices/earcons.hpp"

namespace navvi_feedback::devices {

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

}  // namespace navvi_feedback::devices
