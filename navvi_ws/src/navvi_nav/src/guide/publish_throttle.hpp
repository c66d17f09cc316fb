#pragma once

#include <navvi_types/guidance.hpp>
#include <optional>

namespace navvi_nav::guide {

using navvi_types::Guidance;

/// Decides when the guidance is published: at once when it leads elsewhere than the last message,
/// otherwise 10 times a second.
class PublishThrottle {
 public:
  /// Call it as often as the guidance may change. If it returns true, `guidance` counts as
  /// published. \param time  s, of a clock that does not run backwards
  [[nodiscard]] bool due(const Guidance& guidance, double time);

 private:
  std::optional<Guidance> last_;
  double last_time_ = 0.0;  ///< s
};

/// Decides when a picture of the mesh is published: a large mesh waits longer.
class MeshThrottle {
 public:
  /// \param period  s, least time between two pictures
  explicit MeshThrottle(double period) : period_(period) {}

  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] bool due(double time) const;
  void published(std::size_t polygons, double time);

 private:
  double period_;
  std::optional<double> last_time_;  ///< s
  std::size_t polygons_ = 0;
};

}  // namespace navvi_nav::guide
