#include "generate/layout_goods.hpp"

#include <algorithm>
#include <cmath>

#include "description/sentence.hpp"

namespace navvi_sim::generate {

constexpr int kBaysPerRack = 6;          // at most; longer rows are made of several racks
constexpr double kPalletHeight = 0.144;  // m, of a EUR-pallet
constexpr double kDockWalk = 1.3;        // m, left free along the dock wall
constexpr double kStagingDepth = 8.0;    // m, of staged pallets at most
constexpr double kStagingGap = 0.4;      // m, between the staged pallets and the first cross-aisle
constexpr double kPlace = 2.6;           // m, along an aisle, for one thing that was left there
constexpr double kPalletRoom = 0.95;     // m, that a pallet set down askew takes of an aisle
constexpr double kPedestalRoom = 0.85;   // m, likewise
constexpr double kBoxRoom = 0.75;        // m, likewise, boxes
constexpr double kStandRoom = 0.6;       // m, likewise, a worker

LayoutGoods::LayoutGoods(const FloorPlan& plan, const LayoutConfig& config)
    : plan_(plan), config_(config) {
  if (config.pedestal_min > config.pedestal_max)
    throw LayoutError("pedestal_min", "pedestal_min is " + text(config.pedestal_min) +
                                          " m, more than pedestal_max; allowed are 0.05 to " +
                                          text(config.pedestal_max) + " m");
  const double places = config.pallets + config.pedestals + config.clutter;
  if (places > 1.0)
    throw LayoutError("clutter", "pallets, pedestals and clutter are " + text(places) +
                                     " together; they share the same places, and allowed is 1");
  const auto fits = [&](const char* key, double share, double room) {
    if (share > 0.0 && config.aisle < kPassage + room)
      throw LayoutError(key, std::string(key) + " is " + text(share) + ", but aisles of " +
                                 text(config.aisle) +
                                 " m leave no way past them; allowed are 0, or "
                                 "aisles of " +
                                 text(kPassage + room) + " m or more");
  };
  fits("pallets", config.pallets, kPalletRoom);
  fits("pedestals", config.pedestals, kPedestalRoom);
  fits("clutter", config.clutter, kBoxRoom);
}

std::vector<Thing> LayoutGoods::racks(Random random) const {
  Things things;
  std::size_t number = 0;
  const int racks = (plan_.bays() + kBaysPerRack - 1) / kBaysPerRack;
  for (int row = 0; row < plan_.rows(); ++row)
    for (int block = 0; block < plan_.blocks(); ++block) {
      const Area area = plan_.row(row, block);
      for (const double side : {-1.0, 1.0}) {
        const double x = area.center().x() + side * (kFlue + kRackDepth) / 2.0;
        for (int rack = 0; rack < racks; ++rack) {
          const int from = plan_.bays() * rack / racks;
          const int to = plan_.bays() * (rack + 1) / racks;
          add(things, numbered("shelf", ++number), ThingClass::shelf,
              at(x, area.min().y() + kBay * (from + to) / 2.0, 0.0, -side * kPi / 2.0),
              loaded_rack(random, to - from, config_.fill));
        }
      }
    }
  return things;
}

/// A pallet along y, with goods on it or without.
void LayoutGoods::add_pallet(Things& things, Random& random, const Eigen::Vector2d& spot,
                             double yaw, bool loaded) {
  const std::string name = numbered("pallet", ++pallets_);
  add(things, name, ThingClass::pedestal, at(spot.x(), spot.y(), 0.0, yaw + kPi / 2.0),
      {box_on(0.0, 0.0, 0.0, kPalletLength, kPalletWidth, kPalletHeight)});
  const double height = random.uniform(0.4, 1.4);
  if (loaded)
    add(things, name + "_load", ThingClass::box,
        at(spot.x(), spot.y(), kPalletHeight, yaw + kPi / 2.0),
        {box_on(0.0, 0.0, 0.0, kPalletLength - 0.08, kPalletWidth - 0.08, height)});
}

/// Loaded pallets in two files before each row, so that the ways to the docks stay free.
std::vector<Thing> LayoutGoods::staged(Random random) {
  Things things;
  const double south = plan_.staging().min().y() + kDockWalk;
  const double pitch = kPalletLength + 0.2;
  const double room = std::min(kStagingDepth, plan_.staging().max().y() - kStagingGap - south);
  const int files = static_cast<int>(std::floor((room + 0.2) / pitch));
  for (int row = 0; row < plan_.rows(); ++row)
    for (int file = 0; file < files; ++file)
      for (const double side : {-0.6, 0.6}) {
        const bool there = random.chance(config_.staged);
        const double askew = random.uniform(-0.03, 0.03);
        if (there)
          add_pallet(things, random,
                     {plan_.passage(row, 0).center().x() + side, south + (file + 0.5) * pitch},
                     askew, true);
      }
  return things;
}

double LayoutGoods::Place::x(double room) const {
  return (side < 0.0 ? aisle.min().x() : aisle.max().x()) - side * room / 2.0;
}

std::vector<LayoutGoods::Place> LayoutGoods::quiet_places(Random& random,
                                                          const LayoutTraffic& traffic) const {
  std::vector<Place> places;
  for (int lane = 0; lane < plan_.lanes(); ++lane)
    for (int block = 0; block < plan_.blocks(); ++block) {
      const Area aisle = plan_.aisle(lane, block);
      const double margin = plan_.aisle_open(lane, block) ? 0.2 : 0.5;
      const double length = aisle.sizes().y() - 2.0 * margin;
      const int count = std::max(1, static_cast<int>(length / kPlace));
      for (int i = 0; i < count; ++i) {
        const double side = random.chance(0.5) ? -1.0 : 1.0;
        if (traffic.quiet(lane, block))
          places.push_back({aisle, aisle.min().y() + margin + length * (i + 0.5) / count, side});
      }
    }
  random.shuffle(places);
  return places;
}

std::vector<Thing> LayoutGoods::left_behind(Random random, const LayoutTraffic& traffic) {
  Things things;
  std::vector<Place> places = quiet_places(random, traffic);
  add_standing_workers(things, random, places);
  for (const Place& place : places) {
    const double kind = random.uniform(0.0, 1.0);
    if (kind < config_.pallets) {
      // Drawn one after the other: compilers differ in the order of arguments.
      const bool loaded = random.chance(0.6);
      const double askew = random.uniform(-0.06, 0.06);
      add_pallet(things, random, {place.x(kPalletRoom), place.y}, askew, loaded);
    } else if (kind < config_.pallets + config_.pedestals)
      add_pedestal(things, random, place);
    else if (kind < config_.pallets + config_.pedestals + config_.clutter)
      add_boxes(things, random, place);
  }
  return things;
}

/// In quiet aisles, and, where those are too few or too narrow, along the dock wall.
void LayoutGoods::add_standing_workers(Things& things, Random& random,
                                       std::vector<Place>& places) const {
  std::vector<Eigen::Vector2d> spots;
  if (plan_.staging().sizes().y() > 0.0)
    for (int row = 0; row < plan_.rows(); ++row)
      for (const double side : {-0.6, 0.6})
        spots.emplace_back(plan_.passage(row, 0).center().x() + side,
                           plan_.staging().min().y() + kDockWalk / 2.0);
  random.shuffle(spots);
  for (int i = 0; i < config_.standing_workers; ++i) {
    const bool in_aisle = config_.aisle >= kPassage + kStandRoom && !places.empty();
    if (!in_aisle && spots.empty())
      throw LayoutError("standing_workers",
                        "standing_workers is " + std::to_string(config_.standing_workers) +
                            ", and there is room for " + std::to_string(i) + "; allowed are 0 to " +
                            std::to_string(i) + " in this hall with this traffic");
    Eigen::Vector2d spot;
    if (in_aisle) {
      spot = {places.back().x(kStandRoom), places.back().y};
      places.pop_back();
    } else {
      spot = spots.back();
      spots.pop_back();
    }
    add(things, numbered("worker", static_cast<std::size_t>(config_.walking_workers + i + 1)),
        ThingClass::worker, at(spot.x(), spot.y(), 0.0), worker().shapes);
  }
}

void LayoutGoods::add_pedestal(Things& things, Random& random, const Place& place) {
  const std::string name = numbered("pedestal", ++pedestals_);
  const double height = random.uniform(config_.pedestal_min, config_.pedestal_max);
  const double x = place.x(kPedestalRoom);
  add(things, name, ThingClass::pedestal, at(x, place.y, 0.0, kPi / 2.0),
      {box_on(0.0, 0.0, 0.0, kPalletLength, kPalletWidth, height)});
  const double length = random.uniform(0.5, 1.0);
  const double width = random.uniform(0.4, 0.7);
  const double top = random.uniform(0.4, 0.9);
  if (random.chance(0.5))
    add(things, name + "_box", ThingClass::box, at(x, place.y, height, kPi / 2.0),
        {box_on(0.0, 0.0, 0.0, length, width, top)});
}

/// One to three boxes behind each other, turned a little.
void LayoutGoods::add_boxes(Things& things, Random& random, const Place& place) {
  const std::size_t count = 1 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    const double y =
        place.y + 0.75 * (static_cast<double>(i) - static_cast<double>(count - 1) / 2.0);
    const double length = random.uniform(0.35, 0.55);
    const double width = random.uniform(0.35, 0.55);
    const double height = random.uniform(0.3, 0.7);
    const double yaw = random.uniform(-0.3, 0.3);
    add(things, numbered("box", ++boxes_), ThingClass::box, at(place.x(kBoxRoom), y, 0.0, yaw),
        {box_on(0.0, 0.0, 0.0, length, width, height)});
  }
}

}  // namespace navvi_sim::generate
