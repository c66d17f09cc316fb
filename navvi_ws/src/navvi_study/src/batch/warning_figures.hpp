#pragma once

#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Proximity.h>

#include <cstdint>
#include <map>
#include <navvi_types/cue_event.hpp>
#include <string>
#include <vector>

namespace navvi_study::batch {

/// Judges how early a person was warned of what moves before it touched the robot.
class WarningFigures {
 public:
  /// \param time  s, as in all of these
  void feel(const navvi_msgs::Proximity& near, double time);
  /// A sentence or a sound begins.
  void hear(const navvi_types::CueEvent& cue, double time);
  void touch(const navvi_msgs::Contact& contact, double time);

  /// Of the contacts with what moves, how many were felt < 3 s or told < 2 s before.
  [[nodiscard]] unsigned late() const { return late_; }
  /// A word a contact: s since when it was felt, and since when told; "-" where there was none.
  [[nodiscard]] std::string warned() const { return warned_.empty() ? "-" : warned_; }

 private:
  std::map<std::uint32_t, double> felt_;              ///< s, since when, by thing
  std::map<std::string, std::vector<double>> named_;  ///< s, each time, by class
  unsigned late_ = 0;
  std::string warned_;
};

}  // namespace navvi_study::batch
