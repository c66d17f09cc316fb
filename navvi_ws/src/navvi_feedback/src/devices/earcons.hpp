#pragma once

#include <map>
#include <vector>

#include "devices/mixer.hpp"
#include "devices/voice.hpp"
#include "navvi_feedback/haptics/rumble.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::devices {

/// An earcon's samples, made of a few notes. It begins and ends without a click.
[[nodiscard]] Sound synthesize(sounds::Earcon earcon);

class EarconPlayer {
 public:
  /// \param mixer  outlives this
  explicit EarconPlayer(Mixer& mixer);

  /// The sound that lasts, from now on. \param flow  shares of both ears, as lead::flow_of()
  /// \param volume  gain \return whether it is heard, or silent as it should be
  [[nodiscard]] bool hold(const haptics::Rumble& flow, double volume);

  /// \return those that are heard
  [[nodiscard]] std::vector<sounds::Play> play(const std::vector<sounds::Play>& plays);

 private:
  Mixer& mixer_;
  std::map<sounds::Earcon, Sound> sounds_;
};

}  // namespace navvi_feedback::devices
