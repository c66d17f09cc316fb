#include "scenario/floor_ways.hpp"

#include <array>
#include <navvi_floor/map_survey.hpp>
#include <navvi_floor/pieces.hpp>
#include <utility>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr double kFineCells = 2e6;

navvi_floor::Point point_of(const Eigen::Vector2d& place) { return {place.x(), place.y()}; }

}  // namespace

navvi_floor::SurveyConfig level_survey(double floor, double headroom) {
  navvi_floor::SurveyConfig how;
  how.robot_height = headroom;
  how.climb = 0.0;
  how.floor_height = floor;
  how.threads = 1;
  return how;
}

navvi_floor::Floor floor_of(const navvi_floor::Voxels& voxels, double floor, double headroom,
                            double reach) {
  navvi_floor::SurveyConfig how = level_survey(floor, headroom);
  how.cell_size = voxels.resolution;
  how.most_cells = kFineCells;
  navvi_floor::MapSurvey survey = navvi_floor::survey_map(voxels, how);
  if (!survey.error.empty())
    throw WorldError("navigation rejects the OctoMap of this world: " + survey.error);
  return {{survey.low, survey.cell_size, survey.floor_height, std::move(survey.ground)},
          {reach + survey.cell_size, 0.0}};
}

FloorWays::FloorWays(navvi_floor::Floor floor)
    : floor_(std::move(floor)), width_(static_cast<std::size_t>(floor_.columns()) + 2) {
  gap2_.assign(width_ * (static_cast<std::size_t>(floor_.rows()) + 2), 0);
  for (int y = 0; y < floor_.rows(); ++y) {
    const std::uint16_t* gap2 = floor_.gap2_row(floor_.origin().y + y);
    const navvi_floor::Ground* ground = floor_.all_ground().row(y);
    std::uint16_t* const row = &gap2_[number(0, y)];
    for (int x = 0, end = floor_.columns(); x < end; ++x)
      row[x] = static_cast<std::uint16_t>(
          ground[x] == navvi_floor::Ground::floor ? gap2[x] + 1 : 0);
  }
}

std::vector<std::uint8_t> FloorWays::blocked() const {
  std::vector<std::uint8_t> out(size(), 0);
  for (int y = 0; y < floor_.rows(); ++y) {
    const navvi_floor::Ground* const ground = floor_.all_ground().row(y);
    std::uint8_t* const row = &out[number(0, y)];
    for (int x = 0, end = floor_.columns(); x < end; ++x)
      row[x] = ground[x] == navvi_floor::Ground::obstacle ? 1 : 0;
  }
  return out;
}

Eigen::Vector2d FloorWays::centre(std::size_t cell) const {
  const navvi_floor::Cell low = floor_.origin();
  const int number = static_cast<int>(cell), width = static_cast<int>(width_);
  return floor_.cell_size() *
         Eigen::Vector2d(low.x + number % width - 0.5, low.y + number / width - 0.5);
}

std::size_t FloorWays::cell_at(const Eigen::Vector2d& point) const {
  const navvi_floor::Cell cell = floor_.cell_at(point_of(point)), low = floor_.origin();
  return floor_.area().contains(cell) ? number(cell.x - low.x, cell.y - low.y) : kNone;
}

int FloorWays::gap2_of(double least) const {
  const double cells = std::max(0.0, least / floor_.cell_size() - 0.5);
  return 1 + static_cast<int>(std::ceil(cells * cells - 1e-6));
}

FloorWays::Cells FloorWays::cells_clear_by(double least) const {
  const int gap2 = gap2_of(least);
  Cells cells;
  for (std::uint32_t cell = 0; cell < size(); ++cell)
    if (gap2_[cell] >= gap2) cells.push_back(cell);
  return cells;
}

template <typename Visit>
void FloorWays::for_each_neighbour(std::size_t cell, Visit visit) const {
  const auto straight = static_cast<float>(floor_.cell_size());
  const float diagonal = straight * std::sqrt(2.0F);
  visit(cell - width_ - 1, diagonal);
  visit(cell - width_, straight);
  visit(cell - width_ + 1, diagonal);
  visit(cell - 1, straight);
  visit(cell + 1, straight);
  visit(cell + width_ - 1, diagonal);
  visit(cell + width_, straight);
  visit(cell + width_ + 1, diagonal);
}

/// Dijkstra's search with buckets (Dial, 1969): within a length of one step the order is of no
/// matter.
FloorWays::Ways FloorWays::ways_from(std::size_t start, double least) const {
  constexpr float kEver = std::numeric_limits<float>::infinity();
  const int gap2 = gap2_of(least);
  const auto steps_a_metre = static_cast<float>(1.0 / floor_.cell_size());
  Ways ways{std::vector<float>(size())};
  for (std::size_t cell = 0; cell < size(); ++cell)
    ways.length[cell] = gap2_[cell] >= gap2 ? kEver : -kEver;  // nothing is shorter than that
  struct Entry {
    float length;
    std::uint32_t cell;
  };
  std::array<std::vector<Entry>, 4> open;  // by steps: those of now, and up to three more
  ways.length[start] = 0.0F;
  open[0].push_back({0.0F, static_cast<std::uint32_t>(start)});
  for (std::size_t now = 0, empty = 0; empty < open.size(); ++now) {
    std::vector<Entry>& bucket = open[now % open.size()];
    empty = bucket.empty() ? empty + 1 : 0;
    for (std::size_t i = 0; i < bucket.size(); ++i) {  // it may grow meanwhile
      const auto [length, cell] = bucket[i];
      if (length > ways.length[cell]) continue;
      for_each_neighbour(cell, [&, length = length](std::size_t next, float step) {
        const float longer = length + step;
        if (longer >= ways.length[next]) return;
        ways.length[next] = longer;
        const auto steps = static_cast<unsigned>(longer * steps_a_metre);
        open[steps % open.size()].push_back({longer, static_cast<std::uint32_t>(next)});
      });
    }
    bucket.clear();
  }
  return ways;
}

std::size_t FloorWays::before(const Ways& ways, std::size_t cell) const {
  std::size_t best = kNone;
  for_each_neighbour(cell, [&](std::size_t from, float step) {
    if (ways.length[from] + step == ways.length[cell] &&
        (best == kNone || ways.length[from] < ways.length[best]))
      best = from;
  });
  return best;
}

std::vector<std::uint32_t> FloorWays::parts(double least) const {
  const int gap2 = gap2_of(least);
  return navvi_floor::pieces_of(width_, size() / width_, 1,
                                [&](std::size_t cell) { return gap2_[cell] >= gap2; });
}

}  // namespace navvi_sim::scenario
