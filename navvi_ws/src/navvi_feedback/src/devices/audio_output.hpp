#pragma once

#include <memory>
#include <string>

#include "devices/voice.hpp"

namespace navvi_feedback::devices {

/// One OpenAL Soft device with one source. For one thread.
class AudioOutput {
 public:
  AudioOutput();
  ~AudioOutput();
  AudioOutput(const AudioOutput&) = delete;
  AudioOutput& operator=(const AudioOutput&) = delete;

  /// \param device  OpenAL's name of it; empty for the default one. \return false if there is none
  [[nodiscard]] bool open(const std::string& device, double volume);
  void close();
  [[nodiscard]] bool is_open() const;
  /// False if none is open or the open one was unplugged.
  [[nodiscard]] bool connected() const;
  /// Empty if none is open.
  [[nodiscard]] std::string name() const;

  /// \return false if the device refused it
  [[nodiscard]] bool play(const Sound& sound);
  [[nodiscard]] bool playing() const;
  /// Falls silent with the next period of the device (about 10 ms), without a click.
  void mute();
  /// Frees what was played. Call it some periods after mute().
  void stop();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace navvi_feedback::devices
