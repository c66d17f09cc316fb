#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floor_spread.hpp"
#include "height_field.hpp"
#include "navvi_floor/resample.hpp"
#include "navvi_floor/survey.hpp"

namespace navvi_floor {

/// Of a map: how many voxels end at each level, from the map's origin, with room for the robot.
using Places = std::map<int, int>;

struct SeenGround;

/// What columns of voxels show of the floor: the rules of survey_map() for one size of voxels.
class FloorRules {
 public:
  /// \param voxel  m
  FloorRules(const SurveyConfig& config, double voxel);

  /// Adds the columns of a field, or takes them away. \param sign  1 or -1
  void count(const HeightField& field, int sign, Places& places) const;
  /// Those by which the floor is told and judged, where its height is about known; nullopt: any.
  [[nodiscard]] std::optional<Levels> levels() const;
  /// The floor's, of those; nullopt: there is none, or any of the map may be the floor's.
  [[nodiscard]] std::optional<int> expected_level(const Places& places) const;
  /// nullopt: there is none, see no_floor()
  [[nodiscard]] std::optional<int> floor_level(const Places& places) const;
  [[nodiscard]] std::string no_floor(const Places& places) const;  ///< a sentence
  /// The largest levels, such as "z = 0.05 m (12.3 m^2), z = 0.10 m (4.0 m^2)".
  [[nodiscard]] std::string largest_levels(const Places& places) const;

  /// Whether columns show the same by these rules as they once did by others.
  [[nodiscard]] bool see_the_same(const SeenGround& seen) const;

  struct Shown {
    GroundGrid grid;
    std::vector<int> climbed;  ///< columns that the floor spread to
  };
  /// The ground of a field if the floor lies at `level`.
  [[nodiscard]] Shown ground_of(const HeightField& field, int level) const;

  [[nodiscard]] double voxel() const { return voxel_; }  ///< m
  [[nodiscard]] int threads() const { return threads_; }
  [[nodiscard]] const SurveyConfig& config() const { return config_; }
  [[nodiscard]] const Climbing& climbing() const { return climbing_; }

 private:
  [[nodiscard]] std::optional<double> expected_height() const;  // m

  SurveyConfig config_;
  double voxel_;
  int threads_;
  Climbing climbing_;  // of a floor at level 0
};

}  // namespace navvi_floor
