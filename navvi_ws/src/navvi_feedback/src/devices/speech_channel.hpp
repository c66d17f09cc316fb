#pragma once

#include <optional>

#include "devices/latencies.hpp"
#include "devices/speaker.hpp"
#include "navvi_feedback/cues/voice_order.hpp"

namespace navvi_feedback::devices {

/// The voice that obeys the guide, and how long a person waits for it.
class SpeechChannel : public Speaker {
 public:
  /// \param mixer, latencies  outlive this \throws DeviceError as Speaker does
  SpeechChannel(const SpeakerConfig& config, Mixer& mixer, Latencies& latencies)
      : Speaker(config, mixer), latencies_(latencies) {}

  /// \param pressed  a button went down that one of the words answers
  void obey(const cues::VoiceOrder& order, bool pressed = false);

 private:
  Latencies& latencies_;
  std::optional<Latencies::Clock::time_point> pressed_;  ///< and not answered yet
};

}  // namespace navvi_feedback::devices
