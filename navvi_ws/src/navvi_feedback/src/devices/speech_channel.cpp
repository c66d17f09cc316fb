#include "devices/speech_channel.hpp"

#include <utility>

namespace navvi_feedback::devices {

void SpeechChannel::obey(const cues::VoiceOrder& order, bool pressed) {
  const auto now = Latencies::Clock::now();
  if (pressed) pressed_ = now;
  const auto timed = [&](Chain chain, Latencies::Clock::time_point cause) {
    return [this, chain, cause] { latencies_.add(chain, cause); };
  };
  if (order.stop) speaker_.stop(timed(Chain::silence, now));
  if (order.start && order.asked)
    speaker_.start(*order.start, timed(Chain::answer, std::exchange(pressed_, {}).value_or(now)),
                   order.scan);
  else if (order.start)
    speaker_.start(*order.start, timed(Chain::words, now));
}

}  // namespace navvi_feedback::devices
