#pragma once

#include <Eigen/Core>
#include <navvi_types/trial.hpp>
#include <optional>
#include <vector>

#include "cues/phrases.hpp"
#include "navvi_feedback/drive/buttons.hpp"

namespace navvi_feedback::menu {

/// A place that a person can choose as goal.
struct Destination {
  cues::PlaceName name = cues::PlaceName::task;
  int number = 0;                                ///< 0: there is one of that name
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< m, in map

  [[nodiscard]] cues::Utterance say(const char* kind) const;
};

/// What can be chosen now.
struct Choices {
  std::vector<Destination> destinations;
  navvi_types::TrialState::State trial = navvi_types::TrialState::State::free;
};

/// A spoken menu for one hand and no eyes: next, previous, choose, back, each a short press. The
/// first press of next, previous, choose or start opens it. Nothing has to be held, and nothing
/// runs out.
class Menu {
 public:
  struct Step {
    std::optional<cues::Utterance> told = {};
    std::optional<Eigen::Vector2d> goal = {};  ///< m, in map, chosen now
    std::optional<navvi_types::TrialRequest::Kind> request = {};
  };

  /// Other buttons are ignored.
  [[nodiscard]] Step press(drive::Button button, const Choices& choices);
  [[nodiscard]] bool open() const { return !path_.empty(); }

 private:
  enum class List { top, goals, end };
  struct Entry {
    cues::Utterance label;
    std::optional<List> opens = std::nullopt;
    std::optional<Destination> goal = std::nullopt;
    std::optional<navvi_types::TrialRequest::Kind> request = std::nullopt;
  };
  /// A list, and what was last spoken of it.
  struct Level {
    List list = List::top;
    std::size_t at = 0;
  };

  [[nodiscard]] static std::vector<Entry> entries(List list, const Choices& choices);
  [[nodiscard]] Step choose(const Entry& entry, const Choices& choices);
  [[nodiscard]] Step tell(const Choices& choices) const;

  std::vector<Level> path_;  ///< from the top; empty while closed
};

}  // namespace navvi_feedback::menu
