#include "map/map_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>

#include "map/floor_spread.hpp"
#include "map/height_field.hpp"
#include "map/parallel.hpp"
#include "map/resample.hpp"

namespace navvi_nav::map {
namespace {

constexpr double kFloorTolerance = 0.25;  // m, around SurveyConfig::floor_height
constexpr double kRounding = 1e-6;        // levels
constexpr double kLongestTread = 1.2;     // m, between two steps of a ramp
constexpr double kObstacle = 0.05;        // m, that an obstacle rises at least (R-NAV-12)
constexpr int kNoLevel = -1;

/// Calls `work(band, first, last)` for bands of columns, the last column excluded.
template <typename Work>
void for_bands(const HeightField& field, int bands, const Work& work) {
  const auto all = static_cast<std::int64_t>(field.width()) * field.height();
  in_parallel(bands, bands, [&](int band) {
    work(static_cast<std::size_t>(band), static_cast<std::size_t>(all * band / bands),
         static_cast<std::size_t>(all * (band + 1) / bands));
  });
}

/// For each level, how many voxels end there with room for the robot above.
std::vector<int> count_places(const HeightField& field, int headroom, int threads) {
  std::vector<std::vector<int>> parts(
      static_cast<std::size_t>(threads),
      std::vector<int>(static_cast<std::size_t>(field.levels()) + 1, 0));
  for_bands(field, threads, [&](std::size_t band, std::size_t first, std::size_t last) {
    std::vector<int>& counts = parts[band];
    for (std::size_t column = first; column < last; ++column) {
      int ceiling = std::numeric_limits<int>::max();
      field.downwards(column, [&](Span span) {
        if (ceiling - span.top >= headroom) ++counts[static_cast<std::size_t>(span.top)];
        ceiling = span.bottom;
        return true;
      });
    }
  });
  for (std::size_t part = 1; part < parts.size(); ++part) {
    for (std::size_t level = 0; level < parts[0].size(); ++level)
      parts[0][level] += parts[part][level];
  }
  return parts[0];
}

int lowest_large_level(const std::vector<int>& counts) {
  const int largest = *std::max_element(counts.begin(), counts.end());
  const auto found = std::find_if(counts.begin(), counts.end(), [largest](int count) {
    return count > 0 && 2 * count >= largest;
  });
  return static_cast<int>(found - counts.begin());
}

/// \param wanted  levels, not whole
int largest_level_near(const std::vector<int>& counts, double wanted, double tolerance) {
  int best = kNoLevel;
  for (std::size_t level = 0; level < counts.size(); ++level) {
    if (counts[level] == 0 || std::abs(static_cast<double>(level) - wanted) > tolerance) continue;
    if (best == kNoLevel || counts[level] > counts[static_cast<std::size_t>(best)])
      best = static_cast<int>(level);
  }
  return best;
}

/// What the level `floor_top` alone makes of each column.
std::vector<Ground> on_one_level(const HeightField& field, int floor_top, int headroom,
                                 int threads) {
  std::vector<Ground> ground(
      static_cast<std::size_t>(field.width()) * static_cast<std::size_t>(field.height()),
      Ground::none);
  for_bands(field, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t column = first; column < last; ++column) {
      int ceiling = std::numeric_limits<int>::max();
      field.downwards(column, [&](Span span) {
        if (span.top < floor_top) return false;
        if (span.top == floor_top && ceiling - floor_top >= headroom) {
          ground[column] = Ground::floor;
        } else if (span.bottom < floor_top + headroom) {
          ground[column] = Ground::obstacle;
        }
        ceiling = span.bottom;
        return true;
      });
    }
  });
  return ground;
}

template <typename... Values>
std::string sentence(const char* format, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// The largest levels, such as "z = 0.05 m (12.3 m^2), z = 0.10 m (4.0 m^2)".
std::string largest_levels(const std::vector<int>& counts, int low, double voxel) {
  std::vector<std::pair<int, int>> levels;  // count, level
  for (std::size_t level = 0; level < counts.size(); ++level)
    if (counts[level] > 0) levels.emplace_back(counts[level], static_cast<int>(level));
  std::sort(levels.rbegin(), levels.rend());
  std::string out;
  for (std::size_t i = 0; i < std::min<std::size_t>(levels.size(), 4); ++i)
    out += sentence("%sz = %.2f m (%.1f m^2)", i > 0 ? ", " : "", (low + levels[i].second) * voxel,
                    levels[i].first * voxel * voxel);
  return out;
}

/// levels, of the highest step that is climbed
int highest_step(double climb, double voxel) {
  const int step = static_cast<int>(std::floor(climb / voxel + kRounding));
  return voxel > kObstacle + kRounding ? std::max(step, 1) : step;
}

}  // namespace

MapSurvey survey_map(const Voxels& voxels, const SurveyConfig& config) {
  MapSurvey refused;
  refused.error = voxels.error;
  if (!refused.error.empty()) return refused;
  const double level = voxels.resolution;
  const int threads = std::max(1, config.threads);
  const HeightField field(voxels, threads);
  refused.error = field.error();
  if (!refused.error.empty()) return refused;

  const int headroom =
      std::max(1, static_cast<int>(std::ceil(config.robot_height / level - kRounding)));
  const std::vector<int> counts = count_places(field, headroom, threads);
  const int floor_top =
      config.floor_height == kAnyFloor
          ? lowest_large_level(counts)
          : largest_level_near(counts, config.floor_height / level - field.low_z(),
                               kFloorTolerance / level + kRounding);
  if (floor_top == kNoLevel) {
    refused.error =
        sentence("the map shows no floor within %.2f m of %.2f m (floor_height), but at ",
                 kFloorTolerance, config.floor_height) +
        largest_levels(counts, field.low_z(), level);
    return refused;
  }
  GroundGrid grid{level,
                  {field.low_x() * level, field.low_y() * level},
                  field.width(),
                  field.height(),
                  on_one_level(field, floor_top, headroom, threads)};
  if (config.climb > 0.0)
    spread_floor(grid.ground, field,
                 {floor_top, headroom, highest_step(config.climb, level),
                  static_cast<int>(std::lround(kLongestTread / level))});
  MapSurvey survey = resample(std::move(grid), config);
  survey.levels = largest_levels(counts, field.low_z(), level);
  survey.floor_height = (field.low_z() + floor_top) * level;
  return survey;
}

}  // namespace navvi_nav::map
