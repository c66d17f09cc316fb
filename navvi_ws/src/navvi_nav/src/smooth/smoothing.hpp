#pragma once

#include <memory>

#include "smooth/guide_cost.hpp"

namespace navvi_nav::smooth {

struct SmoothingConfig {
  bool enabled = true;
  /// how often OMPL tries to leave out each corner, on the mean, in each of three rounds
  int attempts = 2;
  /// metres of legs that may be measured for each metre of the shortest path; a node that a search
  /// expands counts as 1.2 m, those for the shortest path as four fifths of all at most
  double effort = 95.0;
  static constexpr double kMaxStretch = 1.25;  ///< longest guide path, times the shortest
  static constexpr double kMaxDetour = 2.0;    ///< m, or so much longer than the shortest
  /// m, a new path must cost so much less than one that keeps the corners of the path so far
  static constexpr double kKeep = 6.0;
  GuideCostConfig cost;

  void describe(navvi_config::Visitor& visit);
};

/// Makes a path for a person (R-NAV-13) of one whose corners touch obstacles: its corners are moved
/// off them; then they are moved and others added while that pays, and OMPL's PathSimplifier leaves
/// out those that do not, all under the same cost. The ends stay, and no leg leaves the mesh. When
/// all that `cost` allows has been measured, what is best by then stands.
class Smoother {
 public:
  /// \param attempts  as in SmoothingConfig
  explicit Smoother(int attempts);
  Smoother(Smoother&&) noexcept;
  ~Smoother();

  /// \param path  on the mesh
  [[nodiscard]] Path sketch(const Path& path, const GuideCost& cost) const;
  /// The same again in smaller steps, for the best of the sketches.
  [[nodiscard]] Path refine(const Path& path, const GuideCost& cost) const;

 private:
  class Simplifier;
  template <typename Steps>
  [[nodiscard]] Path settled(Path path, const Steps& steps, const GuideCost& cost) const;

  int attempts_;
  std::unique_ptr<Simplifier> simplifier_;  ///< its setup takes longer than its use
};

}  // namespace navvi_nav::smooth
