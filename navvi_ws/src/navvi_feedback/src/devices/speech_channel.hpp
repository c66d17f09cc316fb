#pragma once

#include <optional>
#include <vector>

#include "devices/latencies.hpp"
#include "devices/speaker.hpp"
#include "navvi_feedback/cues/voice_order.hpp"

namespace navvi_feedback::devices {

/// The voice, and how long a person waits for it.
class SpeechChannel {
 public:
  /// \param mixer, latencies  outlive this \throws DeviceError as Speaker does
  SpeechChannel(const SpeakerConfig& config, Mixer& mixer, Latencies& latencies)
      : latencies_(latencies), speaker_(config, mixer) {}

  /// \param pressed  a button went down that one of the words answers
  void obey(const cues::VoiceOrder& order, bool pressed = false);
  /// As Speaker::busy().
  [[nodiscard]] bool busy() const { return speaker_.busy(); }
  /// As Speaker::take_played().
  [[nodiscard]] std::vector<sounds::Play> take_played() { return speaker_.take_played(); }
  /// As Speaker::set_rate().
  void set_rate(int rate) { speaker_.set_rate(rate); }
  [[nodiscard]] Speaker::Status status() const { return speaker_.status(); }

 private:
  Latencies& latencies_;
  std::optional<Latencies::Clock::time_point> pressed_;  ///< and not answered yet
  Speaker speaker_;
};

}  // namespace navvi_feedback::devices
