#include "trial/readiness.hpp"

namespace navvi_study::trial {

void Readiness::saw(const Guidance& guidance, double time) {
  guidance_ = time;
  state_ = guidance.state;
}

std::vector<std::string> Readiness::missing(double time, bool clock_runs) const {
  constexpr double kFresh = 1.0;  // s, age of a message that still flows
  std::vector<std::string> words;
  if (!clock_runs) words.push_back("the clock (/clock)");
  if (time - odometry_ > kFresh) words.push_back("odometry (" + names_.odometry + ")");
  if (time - guidance_ > kFresh)
    words.push_back("guidance of nav_node (" + names_.guidance + ")");
  else if (state_ == Guidance::State::no_map || state_ == Guidance::State::map_stale)
    words.push_back("a map (" + names_.octomap + " or " + names_.grid + ")");
  else if (state_ == Guidance::State::pose_stale)
    words.push_back("a pose (transforms from " + names_.map_frame + " to " + names_.base_frame +
                    ")");
  if (!names_.link.empty() && !linked_)
    words.push_back("the state of the connection to the robot (" + names_.link + ")");
  if (feedback_ <= kNever) words.push_back("a report of feedback_node (/diagnostics)");
  for (const auto& modality : modalities_) {
    const std::vector<std::string> needed = modality == "rumble"
                                                ? std::vector<std::string>{"pad"}
                                                : std::vector<std::string>{"audio", "speech"};
    for (const auto& device : needed)
      if (state_of(device) != navvi_types::to_string(DeviceState::works))
        words.push_back("a working " + device + " device");
  }
  return words;
}

std::string Readiness::state_of(const std::string& device) const {
  const auto known = devices_.find(device);
  if (known == devices_.end()) return "unknown";
  return navvi_types::to_string(known->second.state);
}

std::string Readiness::trait(const std::string& device, const std::string& name) const {
  const auto known = devices_.find(device);
  if (known == devices_.end()) return "unknown";
  const auto trait = known->second.traits.find(name);
  return trait == known->second.traits.end() ? "unknown" : trait->second;
}

}  // namespace navvi_study::trial
