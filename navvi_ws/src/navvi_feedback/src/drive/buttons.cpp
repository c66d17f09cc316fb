#include "navvi_feedback/drive/buttons.hpp"

#include <string>

namespace navvi_feedback::drive {

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
    down.push_back(config_.index[i] >= 0 &&
                   input.button(static_cast<std::size_t>(config_.index[i])));
    if (down[i] && !(i < last_.size() && last_[i])) pressed.push_back(static_cast<Button>(i));
  }
  last_ = down;
  return pressed;
}

}  // namespace navvi_feedback::drive
