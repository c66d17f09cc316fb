#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace navvi_feedback::devices {

/// Mono sound.
struct Sound {
  int rate = 22050;  ///< samples a second
  std::vector<std::int16_t> samples;

  /// s
  [[nodiscard]] double duration() const { return static_cast<double>(samples.size()) / rate; }
};

/// espeak-ng, which is one for the whole process and bears one user at a time: construct and
/// use it in one thread.
class Voice {
 public:
  /// \param name  of an espeak-ng voice; empty for "en" \param rate  words a minute, 80..449
  /// \param pitch  0..99
  /// \throws DeviceError if the library, its data or the voice cannot be loaded, or if another
  /// Voice lives
  Voice(const std::string& name, int rate, int pitch);
  ~Voice();
  Voice(const Voice&) = delete;
  Voice& operator=(const Voice&) = delete;

  /// \param rate  words a minute, 80..449
  void set_rate(int rate);

  /// Markup in the text is read aloud, not obeyed.
  /// \param cancelled  asked often; once true, synthesis ends
  /// \return no samples if it failed or was cancelled
  [[nodiscard]] Sound synthesize(const std::string& text, const std::function<bool()>& cancelled);

 private:
  int sample_rate_ = 0;
};

}  // namespace navvi_feedback::devices
