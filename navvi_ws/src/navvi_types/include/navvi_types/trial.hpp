#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "navvi_types/names.hpp"

namespace navvi_types {

/// Whether a trial runs, or what is awaited before one does.
struct TrialState {
  enum class State : std::uint8_t { free, preparing, choose_goal, ready, running };

  enum class Task : std::uint8_t { drive, pick, drop, scan };

  State state = State::free;
  std::int64_t stamp = 0;  ///< ns, ROS time
  std::string place = {};    ///< of a job, that was reached; empty: none
  Task task = Task::drive;   ///< what the person does there before they begin the next trial

  /// The stick does not drive: the person has not begun the trial.
  [[nodiscard]] bool holds() const { return state != State::free && state != State::running; }
};

/// What the person wants of the trial.
struct TrialRequest {
  enum class Kind : std::uint8_t { begin, end };

  Kind kind = Kind::begin;
  std::int64_t stamp = 0;  ///< ns, ROS time, when the button was pressed
};

[[nodiscard]] constexpr std::array<const char*, 5> names(TrialState::State) {
  return {"free", "preparing", "choose_goal", "ready", "running"};
}
[[nodiscard]] constexpr std::array<const char*, 4> names(TrialState::Task) {
  return {"drive", "pick", "drop", "scan"};
}
[[nodiscard]] constexpr std::array<const char*, 2> names(TrialRequest::Kind) {
  return {"begin", "end"};
}

}  // namespace navvi_types
