#include "menu/menu.hpp"

namespace navvi_feedback::menu {
namespace {

constexpr double kSameGoal = 0.05;  // m
constexpr double kPatience = 20.0;  // s
constexpr double kTwice = 1.5;      // s, within which a second press of start means the first

Content entry(About of) { return {CueKind::menu, of}; }

}  // namespace

cues::Utterance Menu::Destination::say(const Content& content) const {
  cues::Utterance told{content};
  told.fillings.place = name;
  told.fillings.number = number;
  told.fillings.place_name = called;
  return told;
}

void Menu::take_goal(const Eigen::Vector2d& goal) {
  // One goal may be sent more than once, as until it is taken.
  if (!goals_.empty() && (goals_.back() - goal).norm() < kSameGoal) return;
  goals_.push_back(goal);
  if (goals_.size() > 2) goals_.erase(goals_.begin());
}

std::optional<NamedPlace> Menu::remember(const Eigen::Vector2d& at, const cues::Phrases& phrases) {
  if (places_.size() >= kMostPlaces) return std::nullopt;
  cues::Fillings fillings;
  fillings.place = cues::PlaceName::remembered;
  std::string name;
  const auto taken = [&](const NamedPlace& place) { return sound_alike(place.name, name); };
  do {
    ++fillings.number;
    name = phrases.say(entry(About::menu_place), fillings);
  } while (std::any_of(places_.begin(), places_.end(), taken));
  places_.push_back({name, at});
  return places_.back();
}

std::vector<Menu::Destination> Menu::destinations() const {
  std::vector<Destination> all;
  if (locked_) return all;
  if (scenario_) all.push_back({cues::PlaceName::task, 0, scenario_->goal});
  if (goals_.size() == 2) all.push_back({cues::PlaceName::last, 0, goals_[0]});
  for (const NamedPlace& place : places_)
    all.push_back({cues::PlaceName::room, 0, place.at, place.name});
  if (scenario_)
    for (const navvi_types::Place& place : scenario_->places)
      all.push_back(
          {static_cast<cues::PlaceName>(place.kind), static_cast<int>(place.number), place.at});
  return all;
}

std::vector<Menu::Entry> Menu::entries(const Level& level) const {
  std::vector<Entry> entries;
  switch (level.list) {
    case List::top:
      if (trial_ == TrialState::State::ready)
        entries.push_back({{entry(About::menu_begin)}, {}, {}, TrialRequest::Kind::begin});
      if (!destinations().empty()) entries.push_back({{entry(About::menu_goals)}, List::goals});
      if (!values_.empty()) entries.push_back({{entry(About::menu_settings)}, List::settings});
      if (trial_ != TrialState::State::preparing && trial_ != TrialState::State::running)
        entries.push_back({{entry(About::menu_glossary)}, {}, {}, {}, nullptr, true});
      if (trial_ == TrialState::State::running)
        entries.push_back({{entry(About::menu_end)}, List::end});
      if (!locked_)
        entries.push_back({{entry(About::menu_remember)}, {}, {}, {}, nullptr, false, true});
      if (entries.empty()) entries.push_back({{entry(About::menu_empty)}});
      break;
    case List::goals:
      for (const Destination& place : destinations())
        entries.push_back({place.say(entry(About::menu_place)), {}, place});
      break;
    case List::goal:
      entries.push_back({level.goal->say(entry(About::goal_sure)), {}, level.goal});
      break;
    case List::settings:
      for (const Setting& setting : settings_)
        if (const auto value = values_.find(setting.key); value != values_.end())
          entries.push_back(
              {setting.say(About::setting, value->second), List::setting, {}, {}, &setting});
      break;
    case List::setting:
      entries.push_back({level.setting->say(About::setting_open, values_.at(level.setting->key))});
      break;
    case List::end:
      entries.push_back({{entry(About::menu_end_sure)}, {}, {}, TrialRequest::Kind::end});
      break;
  }
  return entries;
}

std::optional<std::size_t> Menu::place_of_told(const std::vector<Entry>& list) const {
  const std::optional<Entry>& told = path_.back().told;
  if (!told) return std::nullopt;
  const auto same = [&](const Entry& entry) { return entry.same(*told); };
  const auto found = std::find_if(list.begin(), list.end(), same);
  if (found == list.end()) return std::nullopt;
  return static_cast<std::size_t>(found - list.begin());
}

Menu::Step Menu::tell() {
  if (path_.empty()) return {cues::Utterance{{CueKind::menu_closed, About::menu_closed}}};
  const std::vector<Entry> list = entries(path_.back());
  if (list.empty()) return {cues::Utterance{entry(About::menu_empty)}};
  path_.back().told = list[place_of_told(list).value_or(0)];
  return {path_.back().told->label};
}

Menu::Step Menu::choose(const Entry& entry) {
  if (entry.opens) {
    path_.push_back({*entry.opens, {}, entry.setting});
    return tell();
  }
  const bool sure = path_.back().list == List::goal;
  if (entry.goal && trial_ == TrialState::State::running && !sure) {
    path_.push_back({List::goal, {}, nullptr, entry.goal});
    return tell();
  }
  Step step;
  step.request = entry.request;
  step.glossary = entry.glossary;
  step.remember = entry.remember;
  if (entry.goal) {
    step.goal = entry.goal->at;
    step.told = entry.goal->say({CueKind::menu_closed, About::goal_chosen});
  } else if (!entry.request && !entry.glossary && !entry.remember) {
    return tell();
  }
  path_.clear();
  return step;
}

Menu::Step Menu::change(const Setting& setting, bool up) {
  std::string& value = values_.at(setting.key);
  value = setting.step(value, up);
  Step step{setting.say(About::setting_changed, value)};
  step.change = setting.key + (":=" + value);
  if (value == "false") return step;
  step.felt = setting.felt;
  step.heard = setting.heard;
  return step;
}

bool Menu::pass(double dt) {
  idle_ += dt;
  in_state_ += dt;
  if (path_.empty() || idle_ < kPatience) return false;
  path_.clear();
  return true;
}

Menu::Step Menu::press(drive::Button button) {
  idle_ = 0.0;
  return obey(button);
}

Menu::Step Menu::obey(drive::Button button) {
  using drive::Button;
  if (path_.empty() && (button == Button::leave || button == Button::back)) return {};
  if (button == Button::leave) {
    path_.clear();
    return tell();
  }
  const bool ending = !path_.empty() && path_.back().list == List::end;
  if (button == Button::start && trial_ == TrialState::State::ready && path_.empty()) {
    Step step;
    step.request = TrialRequest::Kind::begin;
    return step;
  }
  const bool just_begun = trial_ == TrialState::State::running && in_state_ < kTwice;
  if (button == Button::start && just_begun && path_.empty()) return {};
  const bool ends = button == Button::end && !ending;
  if (ends && trial_ != TrialState::State::running)
    return {cues::Utterance{entry(About::no_trial)}};
  if (ends || button == Button::settings) {
    path_ = {{}, {ends ? List::end : List::settings}};
    return tell();
  }
  if (button == Button::start || button == Button::end) button = Button::choose;
  if (button < Button::next) return {};
  const Setting* const setting = path_.empty() ? nullptr : path_.back().setting;
  if (setting && (button == Button::next || button == Button::previous))
    return change(*setting, button == Button::previous);
  if (button == Button::back || setting) {
    path_.pop_back();
    return tell();
  }
  // What can be chosen may have changed since the last press.
  const std::vector<Entry> list = path_.empty() ? std::vector<Entry>() : entries(path_.back());
  if (list.empty()) {
    path_ = {{}};
    return tell();
  }
  const std::optional<std::size_t> at = place_of_told(list);
  if (at && button == Button::choose) return choose(list[*at]);
  if (at)
    path_.back().told = list[(*at + (button == Button::next ? 1 : list.size() - 1)) % list.size()];
  return tell();
}

}  // namespace navvi_feedback::menu
