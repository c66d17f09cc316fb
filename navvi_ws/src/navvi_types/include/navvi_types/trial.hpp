#pragma once

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

}  // namespace navvi_types
