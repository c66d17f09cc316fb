#pragma once

#include <optional>

#include "navvi_nav/status.hpp"

namespace navvi_nav {

/// Decides when the guidance is worth a message: at once when it leads elsewhere than the last one
/// that was told, otherwise 10 times a second.
class Telling {
 public:
  /// Call it as often as the guidance may change. If it says so, `status` counts as told.
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] bool due(const Status& status, double time);

 private:
  std::optional<Status> told_;
  double told_at_ = 0.0;  ///< s
};

}  // namespace navvi_nav
