#pragma once

#include <vector>

#include "devices/latencies.hpp"
#include "devices/speaker.hpp"
#include "navvi_feedback/cues/cue_queue.hpp"

namespace navvi_feedback::devices {

/// The queue and the voice together.
class SpeechChannel {
 public:
  /// \param latencies  outlives this \throws DeviceError as Speaker does
  SpeechChannel(const SpeakerConfig& config, Mixer& mixer, Latencies& latencies)
      : latencies_(latencies), speaker_(config, mixer) {}

  /// Call it at 50 Hz. Returns what happened to which cue, in order; each event is to be published.
  /// \param time  s, of a clock that does not run backwards
  /// \param pressed  a button went down that one of the cues answers
  [[nodiscard]] std::vector<CueEvent> tick(const std::vector<cues::Cue>& new_cues, double time,
                                           bool pressed = false);

  /// As Speaker::take_played().
  [[nodiscard]] std::vector<sounds::Play> take_played() { return speaker_.take_played(); }

  /// Falls silent and gives every open cue its end, for the shut-down.
  [[nodiscard]] std::vector<CueEvent> finish();

  /// As Speaker::set_rate().
  void set_rate(int rate) { speaker_.set_rate(rate); }
  [[nodiscard]] Speaker::Status status() const { return speaker_.status(); }
  /// Nothing is spoken and nothing waits.
  [[nodiscard]] bool idle() const { return queue_.empty(); }

 private:
  std::vector<CueEvent> apply(cues::CueQueue::Step step);

  Latencies& latencies_;
  std::optional<Latencies::Clock::time_point> pressed_;  ///< and not answered yet
  cues::CueQueue queue_;
  Speaker speaker_;
};

}  // namespace navvi_feedback::devices
