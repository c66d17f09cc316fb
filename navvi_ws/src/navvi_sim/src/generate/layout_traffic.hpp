#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "generate/floor_plan.hpp"
#include "generate/furniture.hpp"

namespace navvi_sim::generate {

/// Lays routes over a floor plan. An aisle has one track, or two side by side where it is wide
/// enough for what drives there, and each stretch of a track belongs to one route only: there its
/// mover can wait. Cross-aisles belong to all.
class LayoutTraffic {
 public:
  LayoutTraffic(const FloorPlan& plan, const LayoutConfig& config, Random random);

  /// Everything that moves.
  /// \throws LayoutError if there is no room for so many
  [[nodiscard]] std::vector<Thing> movers();
  /// Whether no route leads through the aisle.
  [[nodiscard]] bool quiet(int lane, int block) const;

 private:
  /// A stretch of a lane, blocks `from` to `to`, by one of its tracks.
  struct Track {
    double x;  ///< m
    int side;  ///< 0 west, 1 east, kBoth
  };
  using Places = std::vector<std::pair<int, int>>;
  static constexpr int kBoth = 2;

  template <typename Draw>
  void add(std::vector<Thing>& things, const char* key, int count, const Vehicle& vehicle,
           double speed, const Draw& draw);
  [[nodiscard]] std::optional<std::vector<Waypoint>> shuttle(const Vehicle& vehicle);
  [[nodiscard]] std::optional<std::vector<Waypoint>> loop(const Vehicle& vehicle);
  [[nodiscard]] std::optional<std::vector<Waypoint>> loop_at(const Vehicle& vehicle, int west,
                                                             int east, int south, int north);
  [[nodiscard]] std::optional<std::vector<Waypoint>> walk(const Vehicle& vehicle);

  [[nodiscard]] std::optional<Track> free_track(const Vehicle& vehicle, int lane, int from, int to);
  void take(const Track& track, int lane, int from, int to);
  [[nodiscard]] bool is_free(int side, int lane, int from, int to) const;
  [[nodiscard]] bool all_open(int lane, int from, int to) const;
  /// y of the way from lane `west` to lane `east`; nullopt where the vehicle cannot pass.
  [[nodiscard]] std::optional<double> crossing(const Vehicle& vehicle, int crossing, int west,
                                               int east, bool eastward) const;
  /// Somewhere in the aisle where the vehicle is clear of both ends; nullopt if it is too short.
  [[nodiscard]] std::optional<double> stop(const Vehicle& vehicle, int lane, int block);
  [[nodiscard]] Places shuffled(int lanes, int blocks);

  const FloorPlan& plan_;
  const LayoutConfig& config_;
  Random random_;
  std::vector<bool> taken_;                   ///< by lane, block and side
  std::vector<std::vector<Waypoint>> walks_;  ///< laid out and not yet walked
  std::vector<int> docks_;                    ///< lanes whose dock has no shuttle yet
  Places loops_, walk_aisles_;                ///< not yet tried
};

}  // namespace navvi_sim::generate
