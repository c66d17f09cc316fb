#pragma once

#include <map>
#include <string>
#include <vector>

#include "trial/trial_node_config.hpp"
#include "trial/trial_monitor.hpp"

namespace navvi_study::trial {

/// Whether everything is there that a trial needs. Times are s on any monotonic clock.
class Readiness {
 public:
  /// \param modalities  of the condition: speech, rumble. Without them no trial begins.
  /// \param names  of topics and frames, as sentences have them
  explicit Readiness(std::vector<std::string> modalities, SourceNames names = {})
      : modalities_(std::move(modalities)), names_(std::move(names)) {}

  void saw_odometry(double time) { odometry_ = time; }
  void saw(const Guidance& guidance, double time);
  void saw(const LinkState&, double) { linked_ = true; }
  void saw(const DeviceReport& device, double time) {
    devices_[device.device] = device;
    feedback_ = time;
  }
  template <typename Other>
  void saw(const Other&, double) {}

  /// What is not there, in words; empty when a trial can begin.
  [[nodiscard]] std::vector<std::string> missing(double time, bool clock_runs) const;
  /// For the record: "works", "missing", "off", or "unknown" before its first report.
  /// \param device  pad, audio or speech
  [[nodiscard]] std::string state_of(const std::string& device) const;
  /// For the record, what a device says of itself, such as its name; "unknown" if it does not.
  [[nodiscard]] std::string trait(const std::string& device, const std::string& name) const;
  [[nodiscard]] bool saw_any_odometry() const { return odometry_ > kNever; }
  /// s since the last odometry
  [[nodiscard]] double silence(double time) const { return time - odometry_; }
  /// s since the last report of a device, of which feedback_node makes four a second; 0 before the
  /// first
  [[nodiscard]] double feedback_silence(double time) const {
    return feedback_ > kNever ? time - feedback_ : 0.0;
  }
  /// s since the last guidance.
  [[nodiscard]] double guidance_silence(double time) const { return time - guidance_; }

 private:
  std::vector<std::string> modalities_;
  SourceNames names_;
  static constexpr double kNever = -1e9;

  double odometry_ = kNever;
  double guidance_ = kNever;
  double feedback_ = kNever;
  bool linked_ = false;
  Guidance::State state_ = Guidance::State::no_map;
  std::map<std::string, DeviceReport> devices_;
};

}  // namespace navvi_study::trial
