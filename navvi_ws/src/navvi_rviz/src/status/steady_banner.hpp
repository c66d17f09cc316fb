#pragma once

#include <optional>

#include "status/status.hpp"

namespace navvi_rviz::status {

/// Keeps each banner, and each while without one, for 0.35 s: what is large and bright must not
/// flash more than three times a second (WCAG 2, 2.3.1).
class SteadyBanner {
 public:
  /// \param time  s, never less than before
  /// \return what is shown, with the banner that holds
  [[nodiscard]] Shown hold(Shown shown, double time);

 private:
  std::optional<Shown> last_;
  double since_ = 0.0;  ///< s, when its banner began
};

}  // namespace navvi_rviz::status
