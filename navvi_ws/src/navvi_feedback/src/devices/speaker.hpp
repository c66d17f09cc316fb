#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "devices/latencies.hpp"
#include "devices/mixer.hpp"
#include "devices/voice.hpp"
#include "navvi_config/field.hpp"
#include "navvi_feedback/cues/voice_order.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::devices {

struct SpeakerConfig {
  int rate = 220;       ///< words a minute
  int pitch = 50;       ///< of the voice, 0 to 99
  double volume = 1.0;  ///< gain of the voice
  std::string voice;    ///< of espeak-ng; empty for the language's own

  void describe(navvi_config::Visitor& visit);
};

/// The voice: espeak-ng into the mixer. It owns the voice's process and one thread, which also
/// looks after the mixer's device. Without one it keeps quiet for as long as speaking would take, so
/// that the times of the cues stay true. A sentence over which the process is lost is spoken by the
/// next one; after a second loss a sound says that words are missing.
class Speaker {
 public:
  struct Status {
    unsigned spoken = 0;
    unsigned failed = 0;  ///< texts that were not spoken
    unsigned losses = 0;  ///< of the voice's process
    bool works = true;    ///< there is a process that speaks
    bool heard = true;    ///< the device played the last text to its end
  };

  /// \param mixer  outlives this \throws DeviceError with a sentence if the voice cannot be loaded
  Speaker(const SpeakerConfig& config, Mixer& mixer);
  ~Speaker();

  /// From the next text on. \param rate  words a minute, 80..449
  void set_rate(int rate);

  /// Begins to speak and returns at once; whatever is being spoken is stopped.
  /// \param text  as speakable() of phrases.hpp; anything else is not spoken and counts as failed
  /// \param begun  in the speaker's thread, once the first sample was mixed
  /// \param scan  as Cue::scan; what has no volume is left out
  void start(const std::string& text, std::function<void()> begun = {},
             std::vector<sounds::Play> scan = {});
  /// Falls silent within 50 ms. Returns at once; busy() is false from here on.
  /// \param silent  in the speaker's thread, once what was heard is so no more
  void stop(std::function<void()> silent = {});
  /// True from start() until the last sample was heard (or would have been).
  [[nodiscard]] bool busy() const;
  [[nodiscard]] Status status() const;
  /// Of scans: what has begun since the last call.
  [[nodiscard]] std::vector<sounds::Play> take_played();

 private:
  struct Job {
    std::optional<std::string> text;  ///< nullopt: nothing to say, look after the device
    unsigned long generation = 0;
    int rate = 0;  ///< words a minute
    bool heard = true;  ///< so far
    std::function<void()> begun = {};
    std::function<void()> silent = {};  ///< of what was cut for it
    std::vector<sounds::Play> scan = {};
  };

  void run(std::promise<void> ready);
  /// nullopt at the end.
  [[nodiscard]] std::optional<Job> next();
  [[nodiscard]] bool superseded(unsigned long generation) const;
  /// Returns when the sound has ended, or was superseded and is silent.
  /// \return false if nothing could be spoken
  [[nodiscard]] bool speak(Voice& voice, Job& job);
  /// Likewise, of a part of it.
  [[nodiscard]] bool say(Voice& voice, const std::string& words, Job& job);
  /// \param sound  its beginning \return false if the voice's process was lost over the rest
  [[nodiscard]] bool play(Voice& voice, const Sound& sound, Job& job);
  void play_first(const sounds::Play& play, Job& job);
  /// Waits until it is, unless something is to be said.
  void fall_silent();

  SpeakerConfig config_;
  Mixer& mixer_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::string> request_;
  std::function<void()> begun_, silent_;  ///< not called yet
  std::vector<sounds::Play> scan_, played_;
  unsigned long generation_ = 0;  ///< grows with every start and stop
  bool busy_ = false;
  bool quit_ = false;
  bool fades_ = false;  ///< what was cut is not silent yet; of the thread alone, as the next
  int muted_at_ = 0;    ///< samples of it that had been mixed
  Status status_;
  std::thread thread_;
};

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
