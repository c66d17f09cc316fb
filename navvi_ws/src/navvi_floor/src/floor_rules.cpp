#include "floor_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "navvi_floor/parallel.hpp"
#include "part_survey.hpp"

namespace navvi_floor {
namespace {

constexpr double kFloorTolerance = 0.25;  // m, around where the robot stands
constexpr double kFloorShare = 0.25;      // of the places of the largest level there
constexpr double kRounding = 1e-6;        // levels
constexpr double kLongestTread = 1.2;     // m, between two steps of a ramp
constexpr double kObstacle = 0.05;        // m, that an obstacle rises at least (R-NAV-12)

/// Calls `visit(band, column, downwards)` for all columns, in bands of rows: HeightField::for_row.
template <typename Visit>
void for_bands(const HeightField& field, int bands, const Visit& visit) {
  const auto row = [&](int band) {
    return static_cast<int>(static_cast<std::int64_t>(field.height()) * band / bands);
  };
  in_parallel(bands, bands, [&](int band) {
    for (int y = row(band); y < row(band + 1); ++y)
      field.for_row(y, [&](std::size_t column, const auto& downwards) {
        visit(static_cast<std::size_t>(band), column, downwards);
      });
  });
}

/// For each level, how many voxels end there with room for the robot above.
std::vector<int> count_places(const HeightField& field, int headroom, int threads) {
  std::vector<std::vector<int>> parts(
      static_cast<std::size_t>(threads),
      std::vector<int>(static_cast<std::size_t>(field.levels()) + 1, 0));
  for_bands(field, threads, [&](std::size_t band, std::size_t, const auto& downwards) {
    int ceiling = std::numeric_limits<int>::max();
    downwards([&](Span span) {
      if (ceiling - span.top >= headroom) ++parts[band][static_cast<std::size_t>(span.top)];
      ceiling = span.bottom;
      return true;
    });
  });
  for (std::size_t part = 1; part < parts.size(); ++part) {
    for (std::size_t level = 0; level < parts[0].size(); ++level)
      parts[0][level] += parts[part][level];
  }
  return parts[0];
}

std::optional<int> lowest_large_level(const Places& places) {
  int largest = 0;
  for (const auto& [level, count] : places) largest = std::max(largest, count);
  for (const auto& [level, count] : places)
    if (2 * count >= largest) return level;
  return std::nullopt;
}

/// Of the levels within the tolerance, the nearest that is not small beside the largest.
/// \param wanted  levels, not whole
std::optional<int> level_near(const Places& places, double wanted, double tolerance) {
  const auto off = [&](int level) { return std::abs(static_cast<double>(level) - wanted); };
  int largest = 0;
  for (const auto& [level, count] : places)
    if (off(level) <= tolerance) largest = std::max(largest, count);
  std::optional<int> best;
  for (const auto& [level, count] : places)
    if (off(level) <= tolerance && count >= kFloorShare * largest &&
        (!best || off(level) < off(*best) - kRounding))
      best = level;
  return best;
}

/// What the level `floor_top` alone makes of each column.
std::vector<Ground> on_one_level(const HeightField& field, int floor_top, int headroom,
                                 int threads) {
  std::vector<Ground> ground(
      static_cast<std::size_t>(field.width()) * static_cast<std::size_t>(field.height()),
      Ground::none);
  for_bands(field, threads, [&](std::size_t, std::size_t column, const auto& downwards) {
    int ceiling = std::numeric_limits<int>::max();
    downwards([&](Span span) {
      if (span.top < floor_top) return false;
      if (span.top == floor_top && ceiling - floor_top >= headroom) {
        ground[column] = Ground::floor;
      } else if (span.bottom < floor_top + headroom) {
        ground[column] = Ground::obstacle;
      }
      ceiling = span.bottom;
      return true;
    });
  });
  return ground;
}

template <typename... Values>
std::string sentence(const char* format, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// levels, of the highest step that is climbed
int highest_step(double climb, double voxel) {
  const int step = static_cast<int>(std::floor(climb / voxel + kRounding));
  return voxel > kObstacle + kRounding ? std::max(step, 1) : step;
}

}  // namespace

FloorRules::FloorRules(const SurveyConfig& config, double voxel)
    : config_(config),
      voxel_(voxel),
      threads_(std::max(1, config.threads)),
      climbing_{
          0, std::max(1, static_cast<int>(std::ceil(config.robot_height / voxel - kRounding))),
          highest_step(config.climb, voxel), static_cast<int>(std::lround(kLongestTread / voxel))} {
}

void FloorRules::count(const HeightField& field, int sign, Places& places) const {
  const std::vector<int> counts = count_places(field, climbing_.headroom, threads_);
  for (std::size_t level = 0; level < counts.size(); ++level) {
    if (counts[level] == 0) continue;
    const auto place = places.emplace(field.low_z() + static_cast<int>(level), 0).first;
    place->second += sign * counts[level];
    if (place->second == 0) places.erase(place);
  }
}

std::optional<double> FloorRules::expected_height() const {
  return config_.floor_height != kAnyFloor ? config_.floor_height : config_.stands_at;
}

std::optional<Levels> FloorRules::levels() const {
  const std::optional<double> height = expected_height();
  if (!height || config_.climb > 0.0) return std::nullopt;
  const double tolerance = kFloorTolerance / voxel_ + 1.0;
  return Levels{static_cast<int>(std::floor(*height / voxel_ - tolerance)),
                static_cast<int>(std::ceil(*height / voxel_ + tolerance)) + climbing_.headroom};
}

std::optional<int> FloorRules::expected_level(const Places& places) const {
  const std::optional<double> height = expected_height();
  if (!height) return std::nullopt;
  return level_near(places, *height / voxel_, kFloorTolerance / voxel_ + kRounding);
}

std::optional<int> FloorRules::floor_level(const Places& places) const {
  const std::optional<int> expected = expected_level(places);
  if (expected || config_.floor_height != kAnyFloor) return expected;
  return lowest_large_level(places);
}

bool FloorRules::see_the_same(const SeenGround& seen) const {
  const FloorRules before(seen.how, voxel_);
  return seen.error.empty() && before.expected_height() == expected_height() &&
         before.climbing_.headroom == climbing_.headroom && seen.how.climb == config_.climb &&
         floor_level(seen.record.places) == seen.record.floor_level;
}

std::string FloorRules::no_floor(const Places& places) const {
  return sentence("the map shows no floor within %.2f m of %.2f m (floor_height), but at ",
                  kFloorTolerance, config_.floor_height) +
         largest_levels(places);
}

std::string FloorRules::largest_levels(const Places& places) const {
  std::vector<std::pair<int, int>> levels;  // count, level
  for (const auto& [level, count] : places) levels.emplace_back(count, level);
  std::sort(levels.rbegin(), levels.rend());
  std::string out;
  for (std::size_t i = 0; i < std::min<std::size_t>(levels.size(), 4); ++i)
    out += sentence("%sz = %.2f m (%.1f m^2)", i > 0 ? ", " : "", levels[i].second * voxel_,
                    levels[i].first * voxel_ * voxel_);
  return out;
}

FloorRules::Shown FloorRules::ground_of(const HeightField& field, int level) const {
  Climbing climbing = climbing_;
  climbing.floor_top = level - field.low_z();
  const Cell low = field.columns().low;
  Shown out{{voxel_,
             {low.x * voxel_, low.y * voxel_},
             field.width(),
             field.height(),
             on_one_level(field, climbing.floor_top, climbing.headroom, threads_)},
            {}};
  if (config_.climb > 0.0) out.climbed = spread_floor(out.grid.ground, field, climbing);
  return out;
}

}  // namespace navvi_floor
