#include "devices/speech_channel.hpp"

#include <utility>

namespace navvi_feedback::devices {

void SpeechChannel::obey(const cues::VoiceOrder& order, bool pressed) {
  const auto now = Latencies::Clock::now();
  if (pressed) pressed_ = now;
  const auto timed = [&](Chain chain, Latencies::Clock::time_point cause) {
    return [&latencies = latencies_, chain, cause] { latencies.add(chain, cause); };
  };
  if (order.stop) stop(timed(Chain::silence, now));
  if (order.start && order.asked)
    start(*order.start, timed(Chain::answer, std::exchange(pressed_, {}).value_or(now)),
                   order.scan);
  else if (order.start)
    start(*order.start, timed(Chain::words, now));
}

}  // namespace navvi_feedback::devices
