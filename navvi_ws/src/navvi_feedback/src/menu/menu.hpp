#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cues/phrases.hpp"
#include "drive/buttons.hpp"
#include "navvi_feedback/menu/places_file.hpp"
#include "menu/setting.hpp"
#include "types.hpp"

namespace navvi_feedback::menu {

/// A spoken menu for one hand and no eyes: next, previous, choose, back, each a short press. The
/// first press of next, previous, choose or start opens it. Nothing has to be held. It closes when
/// none of its buttons was pressed for 20 s. It offers to begin and end the trial, goals by name,
/// which are asked for twice while a trial runs, settings, the glossary while no trial runs, and to
/// remember the place where the robot is.
class Menu {
 public:
  struct Step {
    std::optional<cues::Utterance> told = {};
    std::optional<Eigen::Vector2d> goal = {};  ///< m, in map, chosen now
    std::optional<TrialRequest::Kind> request = {};
    std::string change = {};                   ///< such as "speaker/rate:=240"; empty: none
    bool felt = false;                         ///< an example of it is to be felt
    std::optional<sounds::Earcon> heard = {};  ///< or heard
    bool glossary = false;                     ///< is to be given
    bool remember = false;                     ///< where the robot is
  };

  /// A study has set what could be changed: neither goals nor settings are offered.
  void lock(bool locked) { locked_ = locked; }
  void take(std::vector<NamedPlace> places) { places_ = std::move(places); }
  /// Gives a place the first free name, such as "place 1", and offers it as goal from now on.
  /// \param at  m, in map \return nullopt if there are too many
  [[nodiscard]] std::optional<NamedPlace> remember(const Eigen::Vector2d& at,
                                                   const cues::Phrases& phrases);
  [[nodiscard]] bool locked() const { return locked_; }
  void take(const Scenario& scenario) { scenario_ = scenario; }
  void take(const TrialState& trial) {
    if (trial_ != trial.state) in_state_ = 0.0;
    trial_ = trial.state;
  }
  /// From any source. \param goal  m, in map
  void take_goal(const Eigen::Vector2d& goal);
  /// What can be set. \param values  by the key of each setting, as parameters have them
  void take_settings(std::map<std::string, std::string> values) {
    if (!locked_) values_ = std::move(values);
  }

  /// \param value  of a setting that is not to be offered, but `instead`; empty: nothing is
  void withdraw(const std::string& value, const std::string& instead = "") {
    for (Setting& setting : settings_) {
      auto& values = setting.values;
      std::replace(values.begin(), values.end(), value, instead);
      values.erase(std::remove(values.begin(), values.end(), ""), values.end());
    }
  }

  /// Other buttons than its own are ignored.
  [[nodiscard]] Step press(drive::Button button);
  /// \param dt  s since the last call \return true if the menu has closed by itself
  [[nodiscard]] bool pass(double dt);
  [[nodiscard]] bool open() const { return !path_.empty(); }

 private:
  struct Destination {
    cues::PlaceName name = cues::PlaceName::task;
    int number = 0;                                ///< 0: there is one of that name
    Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, in map
    std::string called = {};                       ///< instead of name and number; empty: by these

    [[nodiscard]] cues::Utterance say(const Content& content) const;
    [[nodiscard]] bool operator==(const Destination& other) const {
      return name == other.name && number == other.number && at == other.at &&
             called == other.called;
    }
  };
  enum class List { top, goals, goal, settings, setting, end };
  struct Entry {
    cues::Utterance label;
    std::optional<List> opens = std::nullopt;
    std::optional<Destination> goal = std::nullopt;
    std::optional<TrialRequest::Kind> request = std::nullopt;
    const Setting* setting = nullptr;
    bool glossary = false;
    bool remember = false;

    /// It does the same, whatever value a setting has.
    [[nodiscard]] bool same(const Entry& other) const {
      return label.about == other.label.about && goal == other.goal && setting == other.setting;
    }
  };
  /// A list, and what was last spoken of it: that is what a press means, even if the list has
  /// changed since.
  struct Level {
    List list = List::top;
    std::optional<Entry> told = std::nullopt;
    const Setting* setting = nullptr;                ///< that is being changed
    std::optional<Destination> goal = std::nullopt;  ///< that is asked for once more
  };

  [[nodiscard]] std::vector<Destination> destinations() const;
  [[nodiscard]] std::vector<Entry> entries(const Level& level) const;
  [[nodiscard]] std::optional<std::size_t> place_of_told(const std::vector<Entry>& list) const;
  [[nodiscard]] Step choose(const Entry& entry);
  [[nodiscard]] Step obey(drive::Button button);
  [[nodiscard]] Step change(const Setting& setting, bool up);
  /// Again what was told of the list, or its first entry.
  [[nodiscard]] Step tell();

  bool locked_ = false;
  std::optional<Scenario> scenario_;
  std::vector<NamedPlace> places_;
  std::vector<Eigen::Vector2d> goals_;  ///< m, in map: the last two that were set
  TrialState::State trial_ = TrialState::State::free;
  std::vector<Setting> settings_ = settings();
  std::map<std::string, std::string> values_;
  std::vector<Level> path_;  ///< from the top; empty while closed
  double idle_ = 0.0;        ///< s, since the last press
  double in_state_ = 0.0;    ///< s, that the trial has been in its state
};

}  // namespace navvi_feedback::menu
