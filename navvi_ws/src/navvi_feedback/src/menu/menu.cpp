#include "menu/menu.hpp"

namespace navvi_feedback::menu {

using navvi_types::TrialRequest;
using navvi_types::TrialState;

cues::Utterance Destination::say(const char* kind) const {
  cues::Utterance told{kind};
  told.fillings.place = name;
  told.fillings.number = number;
  return told;
}

std::vector<Menu::Entry> Menu::entries(List list, const Choices& choices) {
  std::vector<Entry> entries;
  switch (list) {
    case List::top:
      if (choices.trial == TrialState::State::ready)
        entries.push_back({{"menu_begin"}, {}, {}, TrialRequest::Kind::begin});
      if (!choices.destinations.empty()) entries.push_back({{"menu_goals"}, List::goals});
      if (choices.trial == TrialState::State::running) entries.push_back({{"menu_end"}, List::end});
      if (entries.empty()) entries.push_back({{"menu_empty"}});
      break;
    case List::goals:
      for (const Destination& place : choices.destinations)
        entries.push_back({place.say("menu_place"), {}, place});
      break;
    case List::end:
      entries.push_back({{"menu_end_sure"}, {}, {}, TrialRequest::Kind::end});
      break;
  }
  return entries;
}

Menu::Step Menu::tell(const Choices& choices) const {
  if (path_.empty()) return {cues::Utterance{"menu_closed"}};
  const std::vector<Entry> list = entries(path_.back().list, choices);
  return {list.at(path_.back().at).label};
}

Menu::Step Menu::choose(const Entry& entry, const Choices& choices) {
  if (entry.opens) {
    path_.push_back({*entry.opens});
    return tell(choices);
  }
  Step step;
  step.request = entry.request;
  if (entry.goal) {
    step.goal = entry.goal->at;
    step.told = entry.goal->say("goal_chosen");
  } else if (!entry.request) {
    return tell(choices);
  }
  path_.clear();
  return step;
}

Menu::Step Menu::press(drive::Button button, const Choices& choices) {
  using drive::Button;
  const bool ending = !path_.empty() && path_.back().list == List::end;
  if (button == Button::end && !ending) {
    if (choices.trial != TrialState::State::running) return {};
    path_ = {{}, {List::end}};
    return tell(choices);
  }
  if (button == Button::start || button == Button::end) button = Button::choose;
  if (button < Button::next) return {};
  if (button == Button::back) {
    if (!path_.empty()) path_.pop_back();
    return tell(choices);
  }
  if (path_.empty()) {
    path_.push_back({});
    return tell(choices);
  }
  // What can be chosen may have changed since the last press.
  const std::vector<Entry> list = entries(path_.back().list, choices);
  if (list.empty()) {
    path_ = {{}};
    return tell(choices);
  }
  std::size_t& at = path_.back().at;
  if (at >= list.size()) {
    at = 0;
    return tell(choices);
  }
  if (button == Button::choose) return choose(list[at], choices);
  at = (at + (button == Button::next ? 1 : list.size() - 1)) % list.size();
  return tell(choices);
}

}  // namespace navvi_feedback::menu
