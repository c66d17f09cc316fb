#pragma once

#include <array>
#include <optional>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_feedback/drive/button.hpp"
#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::drive {

/// Which button of the device does what: indices as in Gamepad::input(); -1: none does. Where
/// joy_node gives the arrow pad as axes 6 and 7, these stand for the buttons 11 to 14, too.
struct ButtonsConfig {
  std::array<int, kButtons> index = {0, 1, 2, 3, 10, 5, 6, 4, 12, 11, 14, 13, -1, 15};

  void describe(navvi_config::Visitor& visit);
};

/// Tells buttons that went down from those that are held. What is down when the device comes, or
/// comes back, did not go down.
class Buttons {
 public:
  explicit Buttons(const ButtonsConfig& config) : config_(config) {}

  /// \return what went down since the last call, as often as it did
  [[nodiscard]] std::vector<Button> update(const InputState& input);

 private:
  ButtonsConfig config_;
  std::optional<InputState> last_;
};

}  // namespace navvi_feedback::drive
