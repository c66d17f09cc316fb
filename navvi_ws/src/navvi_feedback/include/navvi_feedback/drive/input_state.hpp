#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace navvi_feedback::drive {

/// The one stick (R-CTL-1), as joy_node's axes 0 and 1.
struct Stick {
  double x = 0.0;  ///< [-1, 1], left positive
  double y = 0.0;  ///< [-1, 1], forward positive
};

/// The input of the person's hands, from any device, as in sensor_msgs/Joy.
struct InputState {
  bool live = false;          ///< the device is there and was read within the last 250 ms
  /// It comes so late that the robot is to be slow; while not live: that it stands, but no person
  /// needs to be told that it is lost.
  bool late = false;
  std::int64_t stamp = 0;     ///< ns, ROS time, as a driver of another computer has it; 0: none
  unsigned session = 0;       ///< another number whenever the device was opened anew or came back
  std::vector<double> axes;   ///< [-1, 1]; 0: left stick, left positive; 1: forward positive
  std::vector<bool> buttons;  ///< what each does: ButtonsConfig
  /// How often each button went down so far, where that is counted: a short press may begin and end
  /// between two reads.
  std::vector<unsigned> presses;

  /// The left stick, or the right one. Neutral where there is none.
  [[nodiscard]] Stick stick(bool right = false) const {
    // Drivers that give the arrow pad as axes have a trigger between the sticks.
    const std::size_t x = !right ? 0 : axes.size() < 8 ? 2 : 3;
    return axes.size() < x + 2 ? Stick{} : Stick{axes[x], axes[x + 1]};
  }
  [[nodiscard]] bool button(std::size_t index) const {
    return index < buttons.size() && buttons[index];
  }
};

}  // namespace navvi_feedback::drive
