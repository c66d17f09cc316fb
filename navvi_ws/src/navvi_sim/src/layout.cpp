#include "navvi_sim/layout.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "floor_plan.hpp"
#include "furniture.hpp"
#include "layout_traffic.hpp"

namespace navvi_sim {
namespace {

constexpr double kFloorDepth = 0.8;  // m; so deep that an OctoMap of it is made of few, large cubes
constexpr int kBaysPerRack = 6;      // at most; longer rows are made of several racks
constexpr double kDoorWidth = 3.0;   // m, of a dock
constexpr double kPanel = 0.08;      // m, thickness of a dock's door
constexpr double kFenceHeight = 2.0;     // m, of what closes an aisle
constexpr double kPalletHeight = 0.144;  // m, of a EUR-pallet
constexpr double kDockWalk = 1.3;        // m, left free along the dock wall
constexpr double kStagingDepth = 8.0;    // m, of staged pallets at most
constexpr double kStagingGap = 0.4;      // m, between the staged pallets and the first cross-aisle
constexpr double kPlace = 2.6;           // m, along an aisle, for one thing that was left there
constexpr double kPalletRoom = 0.95;     // m, that a pallet set down askew takes of an aisle
constexpr double kPedestalRoom = 0.85;   // m, likewise
constexpr double kBoxRoom = 0.75;        // m, likewise, boxes
constexpr double kStandRoom = 0.6;       // m, likewise, who stands

/// One use of the seed: to change one of them leaves what the others draw as it is.
enum class Stream : std::uint64_t { plan = 1, stock, traffic, staging, clutter };

Random stream(std::uint64_t seed, Stream use) {
  return Random(Random(seed + (static_cast<std::uint64_t>(use) << 56U)).next());
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void check(const LayoutConfig& config) {
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

/// Puts things into a world, numbered by kind.
class Builder {
 public:
  Builder(std::string name, const LayoutConfig& config, std::uint64_t seed)
      : config_(config),
        seed_(seed),
        random_(stream(seed, Stream::plan)),
        plan_(config, random_),
        traffic_(plan_, config, stream(seed, Stream::traffic)) {
    world_.name = std::move(name);
  }

  [[nodiscard]] WorldDescription build() {
    std::vector<Thing> movers = traffic_.movers();
    add_hall();
    add_inner_walls();
    add_fences();
    add_racks();
    add_staging();
    add_what_was_left();
    std::move(movers.begin(), movers.end(), std::back_inserter(world_.things));
    return std::move(world_);
  }

 private:
  void add(const std::string& name, ThingClass thing_class, const Eigen::Isometry3d& pose,
           std::vector<Shape> shapes) {
    world_.things.push_back(standing(name, thing_class, pose, std::move(shapes)));
  }
  /// A box that stands on `area`, `bottom` m above the floor.
  void add_block(const std::string& name, ThingClass thing_class, const Area& area, double height) {
    const Eigen::Vector2d size = area.sizes();
    add(name, thing_class, at(area.center().x(), area.center().y(), 0.0),
        {box_on(0.0, 0.0, 0.0, size.x(), size.y(), height)});
  }

  /// A floor, and walls around it with a closed door at each dock.
  void add_hall() {
    const Area hall = plan_.hall();
    const Eigen::Vector2d rim(kWallThickness, kWallThickness);
    const Area outside(hall.min() - rim, hall.max() + rim);
    const Eigen::Vector2d floor = outside.sizes() + 2.0 * rim;
    add("floor", ThingClass::floor, at(0.0, 0.0, 0.0),
        {box_on(0.0, 0.0, -kFloorDepth, floor.x(), floor.y(), kFloorDepth)});
    add_block("wall_north", ThingClass::wall,
              {Eigen::Vector2d(outside.min().x(), hall.max().y()), outside.max()}, kWallHeight);
    add_block("wall_east", ThingClass::wall,
              {Eigen::Vector2d(hall.max().x(), hall.min().y()),
               Eigen::Vector2d(outside.max().x(), hall.max().y())},
              kWallHeight);
    add_block("wall_west", ThingClass::wall,
              {Eigen::Vector2d(outside.min().x(), hall.min().y()),
               Eigen::Vector2d(hall.min().x(), hall.max().y())},
              kWallHeight);
    double west = outside.min().x();
    std::size_t piece = 0;
    const auto wall_to = [&](double east) {
      add_block(numbered("wall_south", ++piece), ThingClass::wall,
                {Eigen::Vector2d(west, outside.min().y()), Eigen::Vector2d(east, hall.min().y())},
                kWallHeight);
    };
    for (int lane = 0; lane < plan_.lanes(); ++lane) {
      if (!plan_.docked(lane)) continue;
      const Area way = plan_.lane(lane);
      const double half = std::min(kDoorWidth, way.sizes().x()) / 2.0;
      wall_to(way.center().x() - half);
      west = way.center().x() + half;
      add_block(numbered("dock_door", piece), ThingClass::wall,
                {Eigen::Vector2d(way.center().x() - half, outside.min().y()),
                 Eigen::Vector2d(west, outside.min().y() + kPanel)},
                kWallHeight);
      world_.things.back().shapes.front().look = ThingClass::other;
    }
    wall_to(outside.max().x());
  }

  /// Through the flue of a row from front to back, with a door in each open passage.
  void add_inner_walls() {
    std::size_t piece = 0;
    for (int row = 0; row < plan_.rows(); ++row) {
      if (!plan_.walled(row)) continue;
      const double x = plan_.passage(row, 0).center().x();
      double south = plan_.hall().min().y();
      const auto wall_to = [&](double north) {
        if (north - south < 1e-6) return;
        add_block(numbered("wall_inner", ++piece), ThingClass::wall,
                  {Eigen::Vector2d(x - kWallThickness / 2.0, south),
                   Eigen::Vector2d(x + kWallThickness / 2.0, north)},
                  kWallHeight);
      };
      for (int crossing = 0; crossing < plan_.crossings(); ++crossing) {
        if (!plan_.passage_open(row, crossing)) continue;
        const double middle = plan_.passage(row, crossing).center().y();
        wall_to(middle - plan_.door() / 2.0);
        south = middle + plan_.door() / 2.0;
      }
      wall_to(plan_.hall().max().y());
    }
  }

  /// What closes the ways that the plan has closed: an aisle at one end, a passage in its middle.
  void add_fences() {
    std::size_t number = 0;
    const double thickness = kWallThickness;
    for (int lane = 0; lane < plan_.lanes(); ++lane)
      for (int block = 0; block < plan_.blocks(); ++block) {
        if (plan_.aisle_open(lane, block)) continue;
        const Area aisle = plan_.aisle(lane, block);
        const double y = random_.chance(0.5) ? aisle.min().y() : aisle.max().y() - thickness;
        add_block(
            numbered("fence", ++number), ThingClass::wall,
            {Eigen::Vector2d(aisle.min().x(), y), Eigen::Vector2d(aisle.max().x(), y + thickness)},
            kFenceHeight);
      }
    for (int row = 0; row < plan_.rows(); ++row)
      for (int crossing = 0; crossing < plan_.crossings(); ++crossing) {
        if (plan_.walled(row) || plan_.passage_open(row, crossing)) continue;
        const Area passage = plan_.passage(row, crossing);
        const double x = passage.center().x() - thickness / 2.0;
        add_block(numbered("fence", ++number), ThingClass::wall,
                  {Eigen::Vector2d(x, passage.min().y()),
                   Eigen::Vector2d(x + thickness, passage.max().y())},
                  kFenceHeight);
      }
  }

  void add_racks() {
    Random random = stream(seed_, Stream::stock);
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
            add(numbered("shelf", ++number), ThingClass::shelf,
                at(x, area.min().y() + kBay * (from + to) / 2.0, 0.0, -side * M_PI / 2.0),
                loaded_rack(random, to - from, config_.fill));
          }
        }
      }
  }

  /// A pallet along y, with goods on it or without.
  void add_pallet(Random& random, double x, double y, double yaw, bool loaded) {
    const std::string name = numbered("pallet", ++pallets_);
    add(name, ThingClass::pedestal, at(x, y, 0.0, yaw + M_PI / 2.0),
        {box_on(0.0, 0.0, 0.0, kPalletLength, kPalletWidth, kPalletHeight)});
    const double height = random.uniform(0.4, 1.4);
    if (loaded)
      add(name + "_load", ThingClass::box, at(x, y, kPalletHeight, yaw + M_PI / 2.0),
          {box_on(0.0, 0.0, 0.0, kPalletLength - 0.08, kPalletWidth - 0.08, height)});
  }

  /// Loaded pallets in two files before each row, so that the ways to the docks stay free.
  void add_staging() {
    Random random = stream(seed_, Stream::staging);
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
            add_pallet(random, plan_.passage(row, 0).center().x() + side,
                       south + (file + 0.5) * pitch, askew, true);
        }
  }

  /// A place at one side of an aisle in which nothing moves.
  struct Place {
    Area aisle;
    double y;     ///< m, its middle
    double side;  ///< -1 west, 1 east
    /// Where something stands that takes `room` m of the aisle's width.
    [[nodiscard]] double x(double room) const {
      return (side < 0.0 ? aisle.min().x() : aisle.max().x()) - side * room / 2.0;
    }
  };

  [[nodiscard]] std::vector<Place> quiet_places(Random& random) const {
    std::vector<Place> places;
    for (int lane = 0; lane < plan_.lanes(); ++lane)
      for (int block = 0; block < plan_.blocks(); ++block) {
        const Area aisle = plan_.aisle(lane, block);
        const double margin = plan_.aisle_open(lane, block) ? 0.2 : 0.5;
        const double length = aisle.sizes().y() - 2.0 * margin;
        const int count = std::max(1, static_cast<int>(length / kPlace));
        for (int i = 0; i < count; ++i) {
          const double side = random.chance(0.5) ? -1.0 : 1.0;
          if (traffic_.quiet(lane, block))
            places.push_back({aisle, aisle.min().y() + margin + length * (i + 0.5) / count, side});
        }
      }
    for (std::size_t i = places.size(); i > 1; --i)
      std::swap(places[i - 1], places[random.below(i)]);
    return places;
  }

  void add_what_was_left() {
    Random random = stream(seed_, Stream::clutter);
    std::vector<Place> places = quiet_places(random);
    add_standing_workers(random, places);
    for (const Place& place : places) {
      const double kind = random.uniform(0.0, 1.0);
      if (kind < config_.pallets)
        add_pallet(random, place.x(kPalletRoom), place.y, random.uniform(-0.06, 0.06),
                   random.chance(0.6));
      else if (kind < config_.pallets + config_.pedestals)
        add_pedestal(random, place);
      else if (kind < config_.pallets + config_.pedestals + config_.clutter)
        add_boxes(random, place);
    }
  }

  /// In quiet aisles, and, where those are too few or too narrow, along the dock wall.
  void add_standing_workers(Random& random, std::vector<Place>& places) {
    std::vector<Eigen::Vector2d> spots;
    if (plan_.staging().sizes().y() > 0.0)
      for (int row = 0; row < plan_.rows(); ++row)
        for (const double side : {-0.6, 0.6})
          spots.emplace_back(plan_.passage(row, 0).center().x() + side,
                             plan_.staging().min().y() + kDockWalk / 2.0);
    for (std::size_t i = spots.size(); i > 1; --i) std::swap(spots[i - 1], spots[random.below(i)]);
    for (int i = 0; i < config_.standing_workers; ++i) {
      const bool in_aisle = config_.aisle >= kPassage + kStandRoom && !places.empty();
      if (!in_aisle && spots.empty())
        throw LayoutError("standing_workers", "standing_workers is " +
                                                  std::to_string(config_.standing_workers) +
                                                  ", and there is room for " + std::to_string(i) +
                                                  "; allowed are 0 to " + std::to_string(i) +
                                                  " in this hall with this traffic");
      Eigen::Vector2d spot;
      if (in_aisle) {
        spot = {places.back().x(kStandRoom), places.back().y};
        places.pop_back();
      } else {
        spot = spots.back();
        spots.pop_back();
      }
      add(numbered("worker", static_cast<std::size_t>(config_.walking_workers + i + 1)),
          ThingClass::worker, at(spot.x(), spot.y(), 0.0), worker().shapes);
    }
  }

  void add_pedestal(Random& random, const Place& place) {
    const std::string name = numbered("pedestal", ++pedestals_);
    const double height = random.uniform(config_.pedestal_min, config_.pedestal_max);
    const double x = place.x(kPedestalRoom);
    add(name, ThingClass::pedestal, at(x, place.y, 0.0, M_PI / 2.0),
        {box_on(0.0, 0.0, 0.0, kPalletLength, kPalletWidth, height)});
    const double length = random.uniform(0.5, 1.0);
    const double width = random.uniform(0.4, 0.7);
    const double top = random.uniform(0.4, 0.9);
    if (random.chance(0.5))
      add(name + "_box", ThingClass::box, at(x, place.y, height, M_PI / 2.0),
          {box_on(0.0, 0.0, 0.0, length, width, top)});
  }

  /// One to three boxes behind each other, turned a little.
  void add_boxes(Random& random, const Place& place) {
    const std::size_t count = 1 + random.below(3);
    for (std::size_t i = 0; i < count; ++i) {
      const double y =
          place.y + 0.75 * (static_cast<double>(i) - static_cast<double>(count - 1) / 2.0);
      const double length = random.uniform(0.35, 0.55);
      const double width = random.uniform(0.35, 0.55);
      const double height = random.uniform(0.3, 0.7);
      const double yaw = random.uniform(-0.3, 0.3);
      add(numbered("box", ++boxes_), ThingClass::box, at(place.x(kBoxRoom), y, 0.0, yaw),
          {box_on(0.0, 0.0, 0.0, length, width, height)});
    }
  }

  const LayoutConfig& config_;
  std::uint64_t seed_;
  Random random_;
  FloorPlan plan_;
  LayoutTraffic traffic_;
  WorldDescription world_;
  std::size_t pallets_ = 0;
  std::size_t pedestals_ = 0;
  std::size_t boxes_ = 0;
};

}  // namespace

WorldDescription layout(const std::string& name, const LayoutConfig& config, std::uint64_t seed) {
  check(config);
  return Builder(name, config, seed).build();
}

}  // namespace navvi_sim
