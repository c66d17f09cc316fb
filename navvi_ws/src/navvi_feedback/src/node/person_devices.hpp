#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "devices/earcons.hpp"
#include "devices/input_source.hpp"
#include "devices/latencies.hpp"
#include "devices/mixer.hpp"
#include "devices/speaker.hpp"
#include "navvi_feedback/core/guide.hpp"
#include "navvi_feedback/senses/devices.hpp"
#include "node/node_config.hpp"

namespace navvi_feedback::node {

/// Pad or keyboard, voice and sounds of this computer, or their stand-ins by topic.
class PersonDevices {
 public:
  /// \throws DeviceError with a sentence if one that was asked for by name cannot be used
  explicit PersonDevices(const NodeConfig& config);

  /// Without the robot's place. \param time  s, of a clock that does not run backwards
  [[nodiscard]] senses::Devices read(double time);
  /// From the next text on. \param volume  of all that is heard, [0, 1]
  void use(int rate, double volume);

  /// The voice obeys, and short sounds begin.
  /// \return sounds that somebody hears, those of a scan among them
  [[nodiscard]] std::vector<sounds::Play> obey(const core::Output& told);
  /// \param called  once the pad's driver was told, if that is another command
  /// \return false: there is no pad of our own
  bool move_motors(const haptics::Rumble& rumble, const std::function<void()>& called);

  [[nodiscard]] devices::InputSource& source() { return source_; }
  [[nodiscard]] devices::Latencies& latencies() { return latencies_; }
  [[nodiscard]] devices::Mixer::Status audio() const { return mixer_.status(); }
  [[nodiscard]] devices::Speaker::Status voice() const { return speech_.status(); }
  /// nullopt unless the stick is a pad of our own.
  [[nodiscard]] std::optional<devices::Gamepad::Status> pad() const;

 private:
  [[nodiscard]] bool by_topic() const { return listener_ == "topic"; }
  [[nodiscard]] bool heard() const;
  [[nodiscard]] std::string ears() const;
  [[nodiscard]] bool felt() const;

  std::string listener_;
  bool speech_wanted_;
  std::string person_;
  devices::Latencies latencies_;  ///< of this trial; before all that times for it
  devices::Mixer mixer_;
  devices::SpeechChannel speech_;
  devices::EarconPlayer earcons_;
  devices::InputSource source_;
};

}  // namespace navvi_feedback::node
