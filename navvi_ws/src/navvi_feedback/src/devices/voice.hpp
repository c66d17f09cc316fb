#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "process/child.hpp"

namespace navvi_feedback::devices {

/// Mono sound.
struct Sound {
  int rate = 22050;  ///< samples a second
  std::vector<std::int16_t> samples;

  /// s
  [[nodiscard]] double duration() const { return static_cast<double>(samples.size()) / rate; }
};

/// espeak-ng in a process of its own (espeak_voice), which is started anew after it crashed, hung
/// or was killed. For one thread, and no longer than that lives.
class Voice {
 public:
  /// \param name  of an espeak-ng voice; empty for "en" \param pitch  0..99
  /// \throws DeviceError if the library, its data or the voice cannot be loaded
  Voice(const std::string& name, int pitch);

  /// Begins a sentence. Markup in the text is read aloud, not obeyed.
  /// \param rate  words a minute, 80..449
  /// \return the first 0.2 s of its sound or more; no samples if espeak-ng cannot speak the text;
  /// nullopt if its process ended over it, or hung for a second. That is running again then, if it
  /// can.
  [[nodiscard]] std::optional<Sound> begin(const std::string& text, int rate);
  /// What follows that, likewise; no samples if that was all. A new begin() does without it.
  [[nodiscard]] std::optional<Sound> rest();

  /// Between sentences: starts a process anew that was lost.
  void tend();

  [[nodiscard]] bool works() const { return child_ != nullptr; }
  /// How often its process was lost.
  [[nodiscard]] unsigned losses() const { return losses_; }

 private:
  /// \return empty, or a sentence on why there is none
  [[nodiscard]] std::string start();
  void replace();
  /// \return nullopt if the process was lost
  [[nodiscard]] std::optional<Sound> receive();

  std::vector<std::string> arguments_;
  std::unique_ptr<process::Child> child_;  ///< nullptr: it could not be started anew
  bool rest_due_ = false;                  ///< of the last sentence
  unsigned losses_ = 0;
};

}  // namespace navvi_feedback::devices
