#include "generate/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/disjoint_sets.hpp>
#include <string>

#include "description/sentence.hpp"
#include "generate/furniture.hpp"

namespace navvi_sim::generate {
namespace {

constexpr double kStagingShare = 0.16;  // of the width, as far as it need not be more or less
constexpr double kStagingMin = 3.0;     // m
constexpr double kStagingMax = 9.0;     // m
constexpr int kUsualBays = 5;

/// How many of `size` there is room for.
int fitting(double room, double size) {
  return static_cast<int>(std::floor(std::max(0.0, room) / size + 1e-9));
}

/// Number i of `count` places spread evenly over `range`.
std::size_t spread(int i, int count, int range) {
  return static_cast<std::size_t>((2 * i + 1) * range / (2 * count));
}

}  // namespace

FloorPlan::FloorPlan(const LayoutConfig& config, Random& random)
    : aisle_(config.aisle), cross_aisle_(config.cross_aisle), door_(config.door) {
  const Eigen::Vector2d half(config.length / 2.0, config.width / 2.0);
  hall_ = Area(-half, half);
  divide_length(config);
  divide_width(config);
  place_walls_and_docks(config);
  close_ways(config.dead_ends, random);
}

void FloorPlan::divide_length(const LayoutConfig& config) {
  const int most = fitting(config.length - aisle_, kRowDepth + aisle_);
  if (most == 0)
    throw LayoutError("aisle", "aisle is " + text(aisle_) + " m, and no shelf row, " +
                                   text(kRowDepth) +
                                   " m deep with an aisle on either side, fits "
                                   "into a hall " +
                                   text(config.length) + " m long; allowed are 1.4 to " +
                                   text((config.length - kRowDepth) / 2.0) + " m");
  if (config.rows > most)
    throw LayoutError("rows", "rows is " + std::to_string(config.rows) + "; allowed are 1 to " +
                                  std::to_string(most) + " in a hall " + text(config.length) +
                                  " m long with aisles of " + text(aisle_) +
                                  " m, or 0 for as many as fit");
  rows_ = config.rows > 0 ? config.rows : most;
  first_row_ = -(rows_ * kRowDepth + (rows_ - 1) * aisle_) / 2.0;
}

void FloorPlan::divide_width(const LayoutConfig& config) {
  double staging = 0.0;
  if (config.docks > 0)
    staging = std::clamp(kStagingShare * config.width, kStagingMin, kStagingMax);
  const double room = config.width - staging - cross_aisle_;  // each block brings a cross-aisle
  const auto depth = [&](int bays) { return bays * kBay + cross_aisle_; };
  blocks_ = config.blocks;
  bays_ = config.bays;
  if (blocks_ == 0) blocks_ = std::max(1, fitting(room, depth(bays_ > 0 ? bays_ : kUsualBays)));
  if (bays_ == 0) bays_ = fitting(room / blocks_ - cross_aisle_, kBay);
  if (bays_ == 0 || blocks_ * depth(bays_) > room + 1e-9) {
    const std::string key = config.blocks > 0 ? "blocks" : config.bays > 0 ? "bays" : "cross_aisle";
    const int most = fitting(room, depth(std::max(1, config.bays)));
    throw LayoutError(key, "blocks of racks of " + std::to_string(std::max(1, config.bays)) +
                               " bays or more do not fit " +
                               std::to_string(std::max(1, config.blocks)) + " times into a hall " +
                               text(config.width) + " m wide with cross-aisles of " +
                               text(cross_aisle_) + " m" +
                               (staging > 0.0 ? " and " + text(staging) + " m at the docks" : "") +
                               (most > 0 ? "; allowed are 1 to " + std::to_string(most) + " blocks"
                                         : "; allowed are smaller ones"));
  }
  const double rest = room - blocks_ * depth(bays_);
  staging_ = Area(hall_.min(), hall_.min());
  if (staging > 0.0) staging += rest;
  staging_ = area_of(hall_.min().x(), hall_.min().y(), hall_.max().x(), hall_.min().y() + staging);
  first_block_ = hall_.max().y() - blocks_ * depth(bays_);
}

void FloorPlan::place_walls_and_docks(const LayoutConfig& config) {
  if (config.walls > rows_)
    throw LayoutError("walls", "walls is " + std::to_string(config.walls) + "; allowed are 0 to " +
                                   std::to_string(rows_) + ", one in each shelf row of this hall");
  if (config.docks > lanes())
    throw LayoutError("docks", "docks is " + std::to_string(config.docks) + "; allowed are 0 to " +
                                   std::to_string(lanes()) + ", one for each aisle of this hall");
  if (config.walls > 0 && door_ > cross_aisle_)
    throw LayoutError("door", "door is " + text(door_) +
                                  " m, wider than the cross-aisles; allowed are 1.4 to " +
                                  text(cross_aisle_) + " m");
  walled_.assign(static_cast<std::size_t>(rows_), false);
  docked_.assign(static_cast<std::size_t>(lanes()), false);
  for (int i = 0; i < config.walls; ++i) walled_[spread(i, config.walls, rows_)] = true;
  for (int i = 0; i < config.docks; ++i) docked_[spread(i, config.docks, lanes())] = true;
}

/// A spanning tree drawn at random (Kruskal, 1956) stays open, so that nothing is cut off, and so
/// does the way along the docks; of the rest, a share is closed.
void FloorPlan::close_ways(double share, Random& random) {
  struct Way {
    bool is_aisle;
    int along, across;
  };
  std::vector<Way> ways;
  for (int row = 0; row < rows_; ++row)
    for (int crossing = 1; crossing < crossings(); ++crossing)
      ways.push_back({false, row, crossing});
  for (int lane = 0; lane < lanes(); ++lane)
    for (int block = 0; block < blocks_; ++block) ways.push_back({true, lane, block});
  random.shuffle(ways);

  aisles_.assign(static_cast<std::size_t>(lanes()) * static_cast<std::size_t>(blocks_), true);
  passages_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(crossings()), true);
  const auto place = [&](int lane, int crossing) {
    return static_cast<std::size_t>(lane) * static_cast<std::size_t>(crossings()) +
           static_cast<std::size_t>(crossing);
  };
  navvi_types::DisjointSets<std::size_t> connected(static_cast<std::size_t>(lanes()) *
                                                   static_cast<std::size_t>(crossings()));
  for (int row = 0; row < rows_; ++row) connected.unite(place(row, 0), place(row + 1, 0));
  for (const Way& way : ways) {
    const bool is_new = connected.unite(
        place(way.along, way.across),
        way.is_aisle ? place(way.along, way.across + 1) : place(way.along + 1, way.across));
    if (!random.chance(share) || is_new) continue;
    if (way.is_aisle)
      aisles_[index(way.along, way.across)] = false;
    else
      passages_[passage_index(way.along, way.across)] = false;
  }
}

double FloorPlan::row_start(int row) const { return first_row_ + row * (kRowDepth + aisle_); }

double FloorPlan::block_start(int block) const {
  return first_block_ + block * (bays_ * kBay + cross_aisle_);
}

Area FloorPlan::lane(int lane) const {
  const double west = lane == 0 ? hall_.min().x() : row_start(lane - 1) + kRowDepth;
  const double east = lane == rows_ ? hall_.max().x() : row_start(lane);
  return area_of(west, staging_.max().y(), east, hall_.max().y());
}

Area FloorPlan::cross_aisle(int crossing) const {
  const double south =
      crossing == 0 ? staging_.max().y() : block_start(crossing - 1) + bays_ * kBay;
  const double north = crossing == blocks_ ? hall_.max().y() : block_start(crossing);
  return area_of(hall_.min().x(), south, hall_.max().x(), north);
}

Area FloorPlan::aisle(int lane, int block) const {
  const Area whole = this->lane(lane);
  const double south = block_start(block);
  return area_of(whole.min().x(), south, whole.max().x(), south + bays_ * kBay);
}

Area FloorPlan::row(int row, int block) const {
  const Eigen::Vector2d corner(row_start(row), block_start(block));
  return {corner, corner + Eigen::Vector2d(kRowDepth, bays_ * kBay)};
}

Area FloorPlan::passage(int row, int crossing) const {
  const Area whole = cross_aisle(crossing);
  return area_of(row_start(row), whole.min().y(), row_start(row) + kRowDepth, whole.max().y());
}

std::vector<navvi_types::Place> FloorPlan::places() const {
  using navvi_types::Place;
  std::vector<Place> places;
  std::uint32_t number = 0;
  const auto add = [&](Place::Kind kind, const Area& area) {
    places.push_back({kind, ++number, area.center(), area});
  };
  for (int i = 0; i < lanes(); ++i)
    if (docked(i))
      add(Place::Kind::dock,
          area_of(lane(i).min().x(), staging_.min().y(), lane(i).max().x(), staging_.max().y()));
  number = 0;
  for (int block = 0; block < blocks_; ++block)
    for (int i = 0; i < lanes(); ++i)
      if (aisle_open(i, block)) add(Place::Kind::aisle, aisle(i, block));
  number = 0;
  for (int crossing = 0; crossing < crossings(); ++crossing)
    add(Place::Kind::cross_aisle, cross_aisle(crossing));
  number = 0;
  Area room = hall_;
  for (int i = 0; i < rows_; ++i) {
    if (!walled(i)) continue;
    room.max().x() = row(i, 0).center().x();
    add(Place::Kind::room, room);
    room.min().x() = room.max().x();
  }
  room.max().x() = hall_.max().x();
  if (number > 0) add(Place::Kind::room, room);
  return places;
}

}  // namespace navvi_sim::generate
