#include "drive/buttons.hpp"

#include <string>

namespace navvi_feedback::drive {
namespace {

/// Up, down, left, right of the arrow pad as axes.
bool arrow(const InputState& input, int button) {
  if (input.axes.size() < 8 || button < 11 || button > 14) return false;
  const double axis = input.axes[button < 13 ? 7 : 6];  // up and left are positive
  return (button % 2 == 1 ? axis : -axis) > 0.5;
}

/// How often the button went down from one state to the next.
unsigned presses(const InputState& last, const InputState& now, int button) {
  const auto index = static_cast<std::size_t>(button);
  const bool counted = index < now.presses.size();
  const auto down = [&](const InputState& input) {
    return input.live && (arrow(input, button) || (!counted && input.button(index)));
  };
  const unsigned count = !counted                      ? 0
                         : index < last.presses.size() ? now.presses[index] - last.presses[index]
                                                       : now.presses[index];
  return count + (last.live && down(now) && !down(last) ? 1 : 0);
}

}  // namespace

void ButtonsConfig::describe(navvi_config::Visitor& visit) {
  for (std::size_t i = 0; i < index.size(); ++i) {
    const std::string name = navvi_types::names(Button{})[i];
    visit(index[i], name, navvi_config::Range{-1, 255}, "", "index of the button for it; -1: none");
  }
}

std::vector<Button> Buttons::update(const InputState& input) {
  std::vector<Button> pressed;
  if (last_ && last_->session == input.session)
    for (std::size_t i = 0; i < config_.index.size(); ++i)
      if (const int button = config_.index[i]; button >= 0)
        pressed.insert(pressed.end(), presses(*last_, input, button), static_cast<Button>(i));
  last_ = input;
  return pressed;
}

}  // namespace navvi_feedback::drive
