#include "navvi_feedback/drive/buttons.hpp"

#include <string>

namespace navvi_feedback::drive {
namespace {

/// Up, down, left, right of the arrow pad as axes.
bool arrow(const InputState& input, int button) {
  if (input.axes.size() < 8 || button < 11 || button > 14) return false;
  const double axis = input.axes[button < 13 ? 7 : 6];  // up and left are positive
  return (button % 2 == 1 ? axis : -axis) > 0.5;
}

}  // namespace

void ButtonsConfig::describe(navvi_config::Visitor& visit) {
  for (std::size_t i = 0; i < index.size(); ++i) {
    const std::string name = names(Button{})[i];
    visit(index[i], name, navvi_config::Range{-1, 255}, "", "index of the button for it; -1: none");
  }
}

std::vector<Button> Buttons::update(const InputState& input) {
  std::vector<Button> pressed;
  std::vector<bool> down;
  for (std::size_t i = 0; i < config_.index.size(); ++i) {
    const int button = config_.index[i];
    down.push_back(button >= 0 &&
                   (input.button(static_cast<std::size_t>(button)) || arrow(input, button)));
    if (down[i] && !(i < last_.size() && last_[i])) pressed.push_back(static_cast<Button>(i));
  }
  last_ = down;
  return pressed;
}

}  // namespace navvi_feedback::drive
