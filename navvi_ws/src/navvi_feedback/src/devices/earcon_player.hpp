#pragma once

#include <map>
#include <vector>

#include "devices/mixer.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::devices {

/// Plays earcons through the mixer.
class EarconPlayer {
 public:
  /// \param mixer  outlives this
  explicit EarconPlayer(Mixer& mixer);

  /// \return those that are heard
  [[nodiscard]] std::vector<sounds::Play> play(const std::vector<sounds::Play>& plays);

 private:
  Mixer& mixer_;
  std::map<sounds::Earcon, Sound> sounds_;
};

}  // namespace navvi_feedback::devices
