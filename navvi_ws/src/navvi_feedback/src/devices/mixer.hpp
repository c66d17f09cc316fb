#pragma once

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "devices/voice.hpp"
#include "navvi_config/field.hpp"

namespace navvi_feedback::devices {

struct MixerConfig {
  std::string device;         ///< name of the OpenAL device; empty for the default one
  /// s, between attempts to open a lost device; ten times that if there never was one
  double reopen = 2.0;
  std::string hrtf = "auto";  ///< sound for two ears: auto, on, off
  double volume = 1.0;        ///< of all that is heard, [0.1, 1]

  void describe(navvi_config::Visitor& visit);
};

enum class Audio {
  on,  ///< through a device, as soon and as long as there is one
  off  ///< silent by intent: no device is opened
};

/// The one owner of the sound device (OpenAL Soft): the voice in front, and short sounds from where
/// they belong, all at once. For any threads.
class Mixer {
 public:
  struct Status {
    enum class Device {
      open,
      missing,  ///< none could be opened at the start
      lost,     ///< it disappeared, or hangs
      off       ///< Audio::off
    };
    Device device = Device::off;
    std::string name;       ///< of the device, as OpenAL calls it; empty if none is open
    std::string detail;     ///< a sentence on what is wrong; empty if nothing is
    bool two_ears = false;  ///< sounds by HRTF, as for headphones
  };

  Mixer(const MixerConfig& config, Audio audio);
  ~Mixer();

  /// Notices the loss of the device, and tries to open one again. It may take a second.
  /// \return false if it was lost
  bool tend();
  /// As the voice finds: a device that hangs counts as lost until it plays again.
  void plays(bool does);
  [[nodiscard]] Status status() const;

  /// From now on. \param volume  as MixerConfig::volume
  void set_volume(double volume) { volume_ = volume; }

  /// Instead of what the voice says. \return false if nothing is heard
  [[nodiscard]] bool speak(const Sound& sound, double gain);
  /// After that, once. \return false if it is not heard
  [[nodiscard]] bool speak_on(const Sound& sound);
  /// False also if the device was lost.
  [[nodiscard]] bool speaking() const;
  /// Samples of what the voice says that have been mixed, for the device to play next.
  [[nodiscard]] int mixed() const;
  /// The voice falls silent with the next period of the device (about 10 ms), without a click.
  void mute();
  /// Frees what the voice said. Call it some periods after mute().
  void stop();

  /// What lasts besides all else, from now on: repeated, its ends joined without a jump.
  /// \param pitch  times that of the sound \param leftness  where it is, -1 right to 1 left
  /// \param gain  0: silent \return false if nothing is heard
  [[nodiscard]] bool hold(const Sound& sound, double gain, double pitch, double leftness);

  /// Besides all else. It does not wait for a device that is being opened.
  /// \param from  m, in base_link: where it comes from; how far off does not matter
  /// \return false if nothing is heard
  [[nodiscard]] bool play(const Sound& sound, double gain, const Eigen::Vector2d& from);

 private:
  struct Handles;

  void open(Status::Device otherwise);
  void close();
  [[nodiscard]] bool connected() const;
  void report(Status::Device device, const std::string& detail);

  const MixerConfig config_;
  const Audio audio_;
  std::atomic<double> volume_;
  mutable std::timed_mutex device_mutex_;  ///< of all that OpenAL owns
  std::unique_ptr<Handles> handles_;
  std::chrono::steady_clock::time_point next_attempt_;
  mutable std::mutex status_mutex_;
  Status status_;
};

}  // namespace navvi_feedback::devices
