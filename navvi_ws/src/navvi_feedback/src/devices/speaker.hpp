#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "navvi_config/field.hpp"

namespace navvi_feedback::devices {

struct SpeakerConfig {
  int rate = 220;            ///< words a minute
  double volume = 1.0;       ///< gain of the voice
  std::string voice = "en";  ///< of espeak-ng
  std::string device;        ///< name of the OpenAL device; empty for the default one
  double reopen = 2.0;       ///< s, between attempts to open a lost device, x10 if there was none

  void describe(navvi_config::Visitor& visit);
};

/// Whether there is to be sound.
enum class Audio {
  on,  ///< through a device, as soon and as long as there is one
  off  ///< silent by intent: no device is opened
};

/// The voice: espeak-ng into OpenAL Soft. It owns the device, the library and one thread. Without a
/// device it keeps quiet for as long as speaking would take, so that the times of the cues stay
/// true, and tries again to open one. There is one Speaker in a process at a time.
class Speaker {
 public:
  struct Status {
    enum class Device {
      open,
      missing,  ///< none could be opened at the start
      lost,     ///< it disappeared
      off       ///< Audio::off
    };
    Device device = Device::off;
    std::string name;    ///< of the device, as OpenAL calls it; empty if none is open
    std::string detail;  ///< a sentence on what is wrong; empty if nothing is
    unsigned spoken = 0;
    unsigned failed = 0;  ///< texts that the synthesizer refused
  };

  /// \throws DeviceError with a sentence if the voice cannot be loaded
  Speaker(const SpeakerConfig& config, Audio audio);
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  /// Begins to speak and returns at once; whatever is being spoken is stopped.
  /// \param text  as speakable() of phrases.hpp; anything else is not spoken and counts as failed
  void start(const std::string& text);
  /// Falls silent within 50 ms. Returns at once; busy() is false from here on.
  void stop();
  /// True from start() until the last sample was heard (or would have been).
  [[nodiscard]] bool busy() const;
  [[nodiscard]] Status status() const;

 private:
  class Worker;
  std::unique_ptr<Worker> worker_;
};

}  // namespace navvi_feedback::devices
