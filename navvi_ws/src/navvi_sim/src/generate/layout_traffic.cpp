#include "generate/layout_traffic.hpp"

#include <algorithm>
#include <string>

namespace navvi_sim::generate {

constexpr double kMargin = 0.15;    // m, between what moves and what stands
constexpr double kTwoTracks = 2.6;  // m, an aisle's least width for two
constexpr double kWalk = 3.0;       // m, a worker's least stretch
constexpr double kWalkGap = 1.0;    // m, between two of them
constexpr double kFromEnds = 1.0;   // m, kept off an aisle's ends by walkers
constexpr int kLongestShuttle = 3;  // blocks
constexpr int kWidestLoop = 3;      // rows
constexpr int kLongestLoop = 2;     // blocks

LayoutTraffic::LayoutTraffic(const FloorPlan& plan, const LayoutConfig& config, Random random)
    : plan_(plan), config_(config), random_(random) {
  taken_.assign(
      2 * static_cast<std::size_t>(plan.lanes()) * static_cast<std::size_t>(plan.blocks()), false);
  loops_ = shuffled(plan.rows(), plan.blocks());
  walk_aisles_ = shuffled(plan.lanes(), plan.blocks());
  for (const auto& [lane, unused] : shuffled(plan.lanes(), 1))
    if (plan.docked(lane)) docks_.push_back(lane);
}

LayoutTraffic::Places LayoutTraffic::shuffled(int lanes, int blocks) {
  Places places;
  for (int lane = 0; lane < lanes; ++lane)
    for (int block = 0; block < blocks; ++block) places.emplace_back(lane, block);
  random_.shuffle(places);
  return places;
}

std::vector<Thing> LayoutTraffic::movers() {
  std::vector<Thing> things;
  // Every other forklift serves a dock, as long as there are docks without one.
  int forklifts = 0;
  add(things, "forklifts", config_.forklifts, forklift(), config_.forklift_speed,
      [&](const Vehicle& vehicle) {
        auto first = forklifts++ % 2 == 0 ? shuttle(vehicle) : loop(vehicle);
        if (!first) first = shuttle(vehicle);
        return first ? first : loop(vehicle);
      });
  loops_ = shuffled(plan_.rows(), plan_.blocks());
  add(things, "pallet_robots", config_.pallet_robots, pallet_robot(), config_.pallet_robot_speed,
      [&](const Vehicle& vehicle) {
        auto route = loop(vehicle);
        return route ? route : walk(vehicle);
      });
  walks_.clear();
  walk_aisles_ = shuffled(plan_.lanes(), plan_.blocks());
  add(things, "walking_workers", config_.walking_workers, worker(), config_.worker_speed,
      [&](const Vehicle& vehicle) { return walk(vehicle); });
  return things;
}

template <typename Draw>
void LayoutTraffic::add(std::vector<Thing>& things, const char* key, int count,
                        const Vehicle& vehicle, double speed, const Draw& draw) {
  for (int i = 0; i < count; ++i) {
    std::optional<std::vector<Waypoint>> waypoints = draw(vehicle);
    if (!waypoints)
      throw LayoutError(key, std::string(key) + " is " + std::to_string(count) +
                                 ", and there is room for the routes of " + std::to_string(i) +
                                 "; allowed are 0 to " + std::to_string(i) +
                                 " in this hall, and more in a larger one or with wider aisles");
    Route route;
    route.waypoints = std::move(*waypoints);
    route.speed = speed;
    things.push_back(mover(static_cast<std::size_t>(i) + 1, vehicle, std::move(route)));
  }
}

/// From a dock straight up its aisle to a place at a shelf, and back.
std::optional<std::vector<Waypoint>> LayoutTraffic::shuttle(const Vehicle& vehicle) {
  while (!docks_.empty()) {
    const int lane = docks_.back();
    docks_.pop_back();
    const int most = std::min(kLongestShuttle, plan_.blocks());
    for (int blocks = 1 + static_cast<int>(random_.below(static_cast<std::size_t>(most)));
         blocks > 0; --blocks) {
      if (!all_open(lane, 0, blocks)) continue;
      const auto track = free_track(vehicle, lane, 0, blocks);
      const auto shelf = stop(vehicle, lane, blocks - 1);
      if (!track || !shelf) continue;
      take(*track, lane, 0, blocks);
      const double dock = plan_.hall().min().y() + vehicle.radius + kMargin;
      return {{{{track->x, dock}, config_.pause}, {{track->x, *shelf}, config_.pause}}};
    }
  }
  return std::nullopt;
}

/// Round one row or more, in one block or two, with a stop at a shelf on either side.
std::optional<std::vector<Waypoint>> LayoutTraffic::loop(const Vehicle& vehicle) {
  while (!loops_.empty()) {
    const auto [west, south] = loops_.back();
    loops_.pop_back();
    const int rows = 1 + static_cast<int>(random_.below(kWidestLoop));
    const int blocks = 1 + static_cast<int>(random_.below(kLongestLoop));
    const int east = std::min(west + rows, plan_.rows());
    const int north = std::min(south + blocks, plan_.blocks());
    if (auto route = loop_at(vehicle, west, east, south, north)) return route;
    if (auto route = loop_at(vehicle, west, west + 1, south, south + 1)) return route;
  }
  return std::nullopt;
}

std::optional<std::vector<Waypoint>> LayoutTraffic::loop_at(const Vehicle& vehicle, int west,
                                                            int east, int south, int north) {
  const bool clockwise = random_.chance(0.5);
  const auto top = crossing(vehicle, north, west, east, clockwise);
  const auto bottom = crossing(vehicle, south, west, east, !clockwise);
  if (!top || !bottom || !all_open(west, south, north) || !all_open(east, south, north))
    return std::nullopt;
  const auto left = free_track(vehicle, west, south, north);
  const auto right = free_track(vehicle, east, south, north);
  const auto left_stop = stop(vehicle, west, south);
  const auto right_stop = stop(vehicle, east, north - 1);
  if (!left || !right || !left_stop || !right_stop) return std::nullopt;
  take(*left, west, south, north);
  take(*right, east, south, north);
  std::vector<Waypoint> round{
      {{left->x, *left_stop}, config_.pause},   {{left->x, *top}},     {{right->x, *top}},
      {{right->x, *right_stop}, config_.pause}, {{right->x, *bottom}}, {{left->x, *bottom}}};
  if (!clockwise) std::reverse(round.begin() + 1, round.end());
  return round;
}

/// To and fro in one aisle, or across a cross-aisle into the next block's.
std::optional<std::vector<Waypoint>> LayoutTraffic::walk(const Vehicle& vehicle) {
  while (walks_.empty() && !walk_aisles_.empty()) {
    const auto [lane, block] = walk_aisles_.back();
    const bool crosses =
        random_.chance(0.3) && block + 1 < plan_.blocks() && all_open(lane, block, block + 2);
    const int end = block + (crosses ? 2 : 1);
    const auto track = free_track(vehicle, lane, block, end);
    if (!track) {
      // An aisle whose one track is taken may have another; one that crosses may fit without.
      if (!crosses) walk_aisles_.pop_back();
      continue;
    }
    const double from_ends = kFromEnds + std::max(0.0, vehicle.radius - worker().radius);
    const double south = plan_.aisle(lane, block).min().y() + from_ends;
    const double north = plan_.aisle(lane, end - 1).max().y() - from_ends;
    if (north - south < 1.0) {
      walk_aisles_.pop_back();
      continue;
    }
    take(*track, lane, block, end);
    const double gap = kWalkGap + 2.0 * vehicle.radius;
    const int most =
        crosses ? 1 : std::max(1, static_cast<int>((north - south + gap) / (kWalk + gap)));
    const int count = 1 + static_cast<int>(random_.below(static_cast<std::size_t>(most)));
    const double length = (north - south + gap) / count - gap;
    for (int i = 0; i < count; ++i) {
      const double start = south + i * (length + gap);
      Waypoint one{{track->x, start + random_.uniform(0.0, 0.2) * length}, config_.pause};
      Waypoint other{{track->x, start + random_.uniform(0.8, 1.0) * length}, config_.pause};
      if (random_.chance(0.5)) std::swap(one, other);
      walks_.push_back({one, other});
    }
  }
  if (walks_.empty()) return std::nullopt;
  std::vector<Waypoint> walk = std::move(walks_.back());
  walks_.pop_back();
  return walk;
}

std::optional<LayoutTraffic::Track> LayoutTraffic::free_track(const Vehicle& vehicle, int lane,
                                                              int from, int to) {
  const Area area = plan_.lane(lane);
  const double width = area.sizes().x();
  const double need = vehicle.radius + kMargin;
  if (width >= kTwoTracks && width / 4.0 >= need) {
    const int first = static_cast<int>(random_.below(2));
    for (const int side : {first, 1 - first})
      if (is_free(side, lane, from, to))
        return Track{area.min().x() + (side == 0 ? 0.25 : 0.75) * width, side};
    return std::nullopt;
  }
  if (width / 2.0 < need || !is_free(0, lane, from, to) || !is_free(1, lane, from, to))
    return std::nullopt;
  // At one side, so that the robot finds the most room on the other.
  return Track{random_.chance(0.5) ? area.min().x() + need : area.max().x() - need, kBoth};
}

bool LayoutTraffic::is_free(int side, int lane, int from, int to) const {
  for (int block = from; block < to; ++block)
    if (taken_[2 * static_cast<std::size_t>(lane * plan_.blocks() + block) +
               static_cast<std::size_t>(side)])
      return false;
  return true;
}

void LayoutTraffic::take(const Track& track, int lane, int from, int to) {
  for (int block = from; block < to; ++block)
    for (const int side : {0, 1})
      if (track.side == side || track.side == kBoth)
        taken_[2 * static_cast<std::size_t>(lane * plan_.blocks() + block) +
               static_cast<std::size_t>(side)] = true;
}

bool LayoutTraffic::quiet(int lane, int block) const {
  return is_free(0, lane, block, block + 1) && is_free(1, lane, block, block + 1);
}

bool LayoutTraffic::all_open(int lane, int from, int to) const {
  for (int block = from; block < to; ++block)
    if (!plan_.aisle_open(lane, block)) return false;
  return true;
}

std::optional<double> LayoutTraffic::crossing(const Vehicle& vehicle, int crossing, int west,
                                              int east, bool eastward) const {
  const Area area = plan_.cross_aisle(crossing);
  const double width = area.sizes().y();
  double door = width;
  for (int row = west; row < east; ++row) {
    if (!plan_.passage_open(row, crossing)) return std::nullopt;
    if (plan_.walled(row)) door = plan_.door();
  }
  // On the right, where there is room for two.
  const double need = vehicle.radius + kMargin;
  const double right = eastward ? -width / 4.0 : width / 4.0;
  const double room = door / 2.0 - vehicle.half_width - kMargin;
  if (width / 4.0 >= need && width / 4.0 <= room) return area.center().y() + right;
  if (width / 2.0 >= need && room >= 0.0) return area.center().y();
  return std::nullopt;
}

std::optional<double> LayoutTraffic::stop(const Vehicle& vehicle, int lane, int block) {
  const Area area = plan_.aisle(lane, block);
  const double reach = vehicle.radius + 2.0 * kMargin;
  const double room = area.sizes().y() - 2.0 * reach;
  if (room < 0.0) return std::nullopt;
  return area.min().y() + reach + random_.uniform(0.0, room);
}

}  // namespace navvi_sim::generate
