#include "read/sdf_things.hpp"

#include <algorithm>
#include <cmath>

#include "description/aabb_tree.hpp"
#include "description/floor_height.hpp"
#include "description/sentence.hpp"
#include "description/validate.hpp"

namespace navvi_sim::read {
namespace {

constexpr double kPlaneMargin = 2.0;     // m, of a plane beyond the other things
constexpr double kPlaneThickness = 0.1;  // m
constexpr double kDrivenOver = 0.05;     // m, above the floor: what is lower stops no robot
constexpr std::size_t kNamed = 10;       // things in a sentence
constexpr std::size_t kFewLost = 2;      // things, which any world may lose
constexpr double kLeastFloor = 4.0;      // m^2, level: a room has more, a piece of furniture less
constexpr double kFloorShare = 0.2;      // of a building's outline, that is floor in it at least
constexpr double kFloorExcess = 3.0;     // or of what is level above, as the tops of walls are
constexpr double kFloorDepth = 0.5;      // m, of a building below its own floor
constexpr double kHillyFloor = 0.2;      // level share of the outlines of all floors: less is said
constexpr double kLeastLevel = 0.02;     // and less than this is terrain
constexpr double kHeadroom = 2.0;        // m, below another storey
constexpr double kSlab = 0.35;           // m, between a storey's surface and the foot of its slab
constexpr double kCarried = 0.05;        // m, between a thing and what it stands on
constexpr double kCarries = 0.5;         // of the outlines of what stands, that a floor carries

/// Whether a box meets a shape, a mesh by the boxes of its triangles.
bool meets(const Thing& thing, const Shape& shape, const Eigen::AlignedBox3d& box) {
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry);
  if (mesh == nullptr) return true;
  const Eigen::Isometry3d pose = thing.pose * shape.pose;
  return std::any_of((*mesh)->triangles.begin(), (*mesh)->triangles.end(), [&](const auto& side) {
    Eigen::AlignedBox3d bounds;
    for (const std::uint32_t index : side)
      bounds.extend(pose * (*mesh)->vertices[index].template cast<double>());
    return box.intersects(bounds);
  });
}

}  // namespace

std::string SdfThings::unique(const std::string& name) {
  const std::string base = name.empty() ? "unnamed" : name;
  std::string result = base;
  for (int i = 2; !names_.insert(result).second; ++i) result = base + "#" + std::to_string(i);
  return result;
}

void SdfThings::add(Thing thing, const std::string& place) {
  if (thing.route && thing.thing_class == ThingClass::floor) {
    notes_.add(place, "'" + thing.name + "' is a floor, and stands still");
    thing.route.reset();
  }
  loaded.world.things.push_back(std::move(thing));
  places_.push_back(place);
}

void SdfThings::add_on_floor(Thing thing, const std::string& place) {
  on_floor_.push_back(loaded.world.things.size());
  add(std::move(thing), place);
}

void SdfThings::add_plane(const std::string& name, double height, const std::string& place) {
  planes_.push_back({name, height, place});
}

/// A plane has no end; the floor made of it goes as far as the other things do, and some more.
void SdfThings::add_planes() {
  for (const Plane& plane : planes_) {
    Eigen::AlignedBox3d bounds = bounds_of(loaded.world.things);
    if (bounds.isEmpty())
      bounds.extend(Eigen::Vector3d(-10, -10, 0)).extend(Eigen::Vector3d(10, 10, 0));
    const Eigen::Vector3d size = bounds.sizes() + Eigen::Vector3d::Constant(2.0 * kPlaneMargin);
    if (size.head<2>().maxCoeff() >= WorldLimits::extent) refuse_width(size.head<2>().maxCoeff());
    Thing thing;
    thing.name = unique(names_.count(plane.name) ? plane.name + "_plane" : plane.name);
    thing.thing_class = ThingClass::floor;
    thing.pose.translation() = Eigen::Vector3d(bounds.center().x(), bounds.center().y(),
                                               plane.height - kPlaneThickness / 2.0);
    thing.shapes.push_back(
        {Box{{size.x(), size.y(), kPlaneThickness}}, Eigen::Isometry3d::Identity()});
    add(std::move(thing), plane.place);
  }
}

/// \param width  m, of the plane
void SdfThings::refuse_width(double width) const {
  std::size_t farthest = 0;
  double distance = 0.0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double reach =
        bounds_of({loaded.world.things[i]}).center().head<2>().lpNorm<Eigen::Infinity>();
    if (reach > distance) farthest = i;
    distance = std::max(distance, reach);
  }
  throw WorldError(places_[farthest] + ": the things lie up to " + text(std::round(width)) +
                   " m apart, such as '" + shortened(loaded.world.things[farthest].name) + "', " +
                   text(std::round(distance)) +
                   " m from the middle of the map; allowed is less than " +
                   text(WorldLimits::extent) + " m");
}

void SdfThings::find_floor(const std::filesystem::path& file) {
  add_planes();
  if (!main_floor_height(loaded.world.things)) find_floor_of_buildings();
  const auto height = main_floor_height(loaded.world.things);
  if (!height)
    refuse_floor(file, "no thing is a floor with a level surface, and no building has one");
  loaded.world.floor_height = *height;
  judge_terrain(*height, file);
  const auto storey = storey_above(loaded.world.things, *height + kHeadroom);
  judge_floors(*height);
  for (const std::size_t thing : on_floor_)
    loaded.world.things[thing].pose.translation().z() = *height;
  leave_out_what_is_under(*height, file);
  if (storey) leave_out_storey(*storey);
  judge_what_stands(*height, file);
  name_what_hangs();
}

void SdfThings::refuse_floor(const std::filesystem::path& file, const std::string& why) const {
  throw WorldError(file.string() + ": " + why +
                   ". Allowed are worlds with a ground plane: add <include><uri>"
                   "model://ground_plane</uri></include> at the height on which things stand; it "
                   "hides nothing" +
                   notes_.left_out());
}

/// A floor carries more than half of what stands, by the area of outlines: else it is the bottom of
/// a rack, and the true floor is missing.
void SdfThings::judge_what_stands(double height, const std::filesystem::path& file) {
  std::vector<Eigen::AlignedBox3d> floors;
  for (const Thing& thing : loaded.world.things) {
    Eigen::AlignedBox3d bounds = bounds_of({thing});
    if (bounds.isEmpty()) continue;
    if (thing.thing_class != ThingClass::floor ||
        level_area(thing, height - kDrivenOver, height + kDrivenOver) <= 0.0)
      continue;
    // Floors that touch are one.
    bounds.min() -= Eigen::Vector3d::Constant(kDrivenOver);
    bounds.max() += Eigen::Vector3d::Constant(kDrivenOver);
    for (std::size_t i = floors.size(); i-- > 0;)
      if (floors[i].intersects(bounds)) {
        bounds.extend(floors[i]);
        floors.erase(floors.begin() + static_cast<std::ptrdiff_t>(i));
        i = floors.size();
      }
    floors.push_back(bounds);
  }
  const std::vector<Eigen::AlignedBox3d> standing = standing_in(loaded.world);
  if (standing.empty()) {
    notes_.add(file.string(), "NOTHING STANDS in this world: a trial there measures nothing");
    return;
  }
  const auto area = [](const Eigen::AlignedBox3d& box) {
    return box.sizes().x() * box.sizes().y();
  };
  double all = 0.0, most = 0.0;
  for (const Eigen::AlignedBox3d& thing : standing) all += area(thing);
  for (const Eigen::AlignedBox3d& floor : floors) {
    double carried = 0.0;
    for (const Eigen::AlignedBox3d& thing : standing) {
      const Eigen::Vector2d centre = thing.center().head<2>();
      if ((centre - floor.min().head<2>()).minCoeff() >= 0.0 &&
          (floor.max().head<2>() - centre).minCoeff() >= 0.0)
        carried += area(thing);
    }
    most = std::max(most, carried);
  }
  if (all > 0.0 && most <= kCarries * all)
    refuse_floor(file, "no floor carries more than half of what stands: the best one, at " +
                           text(std::round(1000.0 * height) / 1000.0 + 0.0) + " m, carries " +
                           text(std::round(100.0 * most / all)) + " %");
}

/// A building of one piece has its own floor, which no rule knows by name.
void SdfThings::find_floor_of_buildings() {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Thing& thing = loaded.world.things[i];
    Thing building = thing;
    building.thing_class = ThingClass::floor;
    const auto height = main_floor_height({building});
    if (!height || thing.route) continue;
    const Eigen::AlignedBox3d bounds = bounds_of({thing});
    const double area = level_area(thing, *height - kDrivenOver, *height + kDrivenOver);
    const bool is_most =
        area >= kFloorShare * bounds.sizes().x() * bounds.sizes().y() ||
        area >= kFloorExcess * level_area(thing, *height + kDrivenOver, bounds.max().z());
    if (area < kLeastFloor || !is_most || *height > bounds.min().z() + kFloorDepth) continue;
    thing.thing_class = ThingClass::floor;
    notes_.add(places_[i], "no thing is named a floor, and '" + thing.name +
                               "' has one of its own, which is taken");
  }
}

/// The robot drives on one level: hills are a floor of which it reaches a small part, or none.
void SdfThings::judge_terrain(double height, const std::filesystem::path& file) {
  double level = 0.0;
  double outlines = 0.0;
  std::string largest;
  double most = 0.0;
  for (const Thing& thing : loaded.world.things) {
    if (thing.thing_class != ThingClass::floor) continue;
    const Eigen::Vector3d size = bounds_of({thing}).sizes();
    level += level_area(thing, height - kDrivenOver, height + kDrivenOver);
    outlines += size.x() * size.y();
    if (size.x() * size.y() > most) largest = thing.name;
    most = std::max(most, size.x() * size.y());
  }
  if (level >= kHillyFloor * outlines) return;
  const std::string sentence =
      "only " + text(std::round(1000.0 * level / outlines) / 10.0) + " % of the floor, such as '" +
      shortened(largest) + "', is level at " + text(std::round(1000.0 * height) / 1000.0 + 0.0) +
      " m, and the robot drives on one level";
  if (level < kLeastLevel * outlines)
    throw WorldError(file.string() + ": " + sentence + "; allowed is a share of " +
                     text(100.0 * kLeastLevel) + " % or more");
  notes_.add(file.string(), sentence);
}

/// What rises above the floor and has no floor of its own is an obstacle, whatever its name.
void SdfThings::judge_floors(double height) {
  for (Thing& thing : loaded.world.things) {
    const auto match = if_no_floor_.find(thing.name);
    if (match == if_no_floor_.end() || thing.thing_class != ThingClass::floor ||
        top_of(thing) <= height + kDrivenOver ||
        level_area(thing, height - kDrivenOver, height + kDrivenOver) >= kLeastFloor)
      continue;
    thing.thing_class = match->second;
  }
}

std::vector<SdfThings::Lost> SdfThings::leave_out(
    const std::function<bool(const Thing&)>& is_lost, const std::string& why) {
  std::vector<Thing> kept;
  std::vector<std::string> kept_places;
  std::vector<Lost> lost;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Thing& thing = loaded.world.things[i];
    if (is_lost(thing)) {
      if (!why.empty()) notes_.add(places_[i], "'" + thing.name + "' is " + why);
      lost.push_back({std::move(thing.name), std::move(places_[i])});
      continue;
    }
    kept.push_back(std::move(thing));
    kept_places.push_back(std::move(places_[i]));
  }
  loaded.world.things = std::move(kept);
  places_ = std::move(kept_places);
  return lost;
}

void SdfThings::leave_out_what_is_under(double height, const std::filesystem::path& file) {
  const auto is_under = [&](const Thing& thing) {
    return thing.thing_class != ThingClass::floor && top_of(thing) < height;
  };
  leave_out_spares(height);
  leave_out_what_is_in_slabs(height);
  const std::size_t all = places_.size();
  const std::vector<Lost> lost =
      leave_out(is_under, "not taken over: all of it lies under the floor");
  if (lost.size() > kFewLost && lost.size() > all / 10)
    throw WorldError(file.string() + ": " + std::to_string(lost.size()) + " of " +
                     std::to_string(all) + " things lie under the floor at " +
                     std::to_string(height) +
                     " m; allowed is a tenth. A plane, or a model that a " +
                     "class rule calls a floor, must lie where the things stand");
}

/// Such as people who are plates of 2 cm on a slab of 5 cm.
void SdfThings::leave_out_what_is_in_slabs(double height) {
  std::vector<Eigen::AlignedBox3d> slabs;
  for (const Thing& thing : loaded.world.things)
    if (!thing.route && std::abs(top_of(thing) - height) < kDrivenOver / 2.0 &&
        level_area(thing, height - kDrivenOver, height + kDrivenOver) >= kLeastFloor)
      slabs.push_back(bounds_of({thing}));
  const auto is_in_one = [&](const Thing& thing) {
    const Eigen::AlignedBox3d bounds = bounds_of({thing});
    return thing.thing_class != ThingClass::floor && bounds.max().z() < height &&
           std::any_of(slabs.begin(), slabs.end(),
                       [&](const Eigen::AlignedBox3d& slab) { return slab.contains(bounds); });
  };
  leave_out(is_in_one, "not taken over: all of it lies within a slab");
}

/// Models that Gazebo parks far below the floor, for plugins to fetch, where some things stand on
/// the floor and no floor carries the spares.
void SdfThings::leave_out_spares(double height) {
  std::vector<Eigen::AlignedBox3d> cellars;
  bool stands = false;
  for (const Thing& thing : loaded.world.things) {
    const Eigen::AlignedBox3d bounds = bounds_of({thing});
    if (thing.thing_class != ThingClass::floor)
      stands = stands || bounds.max().z() >= height;
    else if (bounds.min().z() < height - kHeadroom)
      cellars.push_back(bounds);
  }
  if (!stands) return;
  const auto is_spare = [&](const Thing& thing) {
    Eigen::AlignedBox3d bounds = bounds_of({thing});
    if (thing.thing_class == ThingClass::floor || bounds.max().z() >= height - kHeadroom)
      return false;
    bounds.min().z() -= kCarried;
    return std::none_of(cellars.begin(), cellars.end(), [&](const Eigen::AlignedBox3d& cellar) {
      return bounds.intersects(cellar);
    });
  };
  leave_out(is_spare, "parked far below the floor, and is left out");
}

/// No robot gets there.
void SdfThings::leave_out_storey(double storey) {
  const std::vector<Lost> lost =
      leave_out([&](const Thing& thing) { return bounds_of({thing}).min().z() > storey - kSlab; });
  if (lost.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, lost.size()); ++i)
    names += (i == 0 ? "'" : ", '") + shortened(lost[i].name) + "'";
  notes_.add(lost[0].place, "A STOREY OR CEILING at " + text(storey) +
                                " m is left out with all that is above it, " +
                                "since the robot drives at " + text(loaded.world.floor_height) +
                                " m: " + std::to_string(lost.size()) + " things, " + names +
                                (lost.size() > kNamed ? ", ..." : ""));
}

/// Things stay where their file puts them, also what falls in Gazebo. Boxes along the axes tell
/// what is near, so that what is carried somehow is not named.
void SdfThings::name_what_hangs() {
  struct Piece {
    std::size_t thing;
    const Shape* shape;
  };
  std::vector<Piece> pieces;
  std::vector<Eigen::AlignedBox3d> boxes;
  const std::vector<Thing>& things = loaded.world.things;
  for (std::size_t i = 0; i < things.size() && !loose_.empty(); ++i)
    for (const Shape& shape : things[i].shapes) {
      pieces.push_back({i, &shape});
      boxes.push_back(bounds_of(shape.geometry, things[i].pose * shape.pose));
    }
  const AabbTree tree(boxes);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const Thing& thing = things[i];
    Eigen::AlignedBox3d reach = bounds_of({thing});
    reach.min().z() -= kCarried;
    if (loose_.count(thing.name) == 0 || thing.route || thing.thing_class == ThingClass::floor ||
        reach.min().z() <= loaded.world.floor_height)
      continue;
    bool carried = false;
    tree.search([&](const Eigen::AlignedBox3d& box) { return reach.squaredExteriorDistance(box); },
                [&] { return carried ? -1.0 : 0.0; },
                [&](std::uint32_t index) {
                  const Piece& piece = pieces[index];
                  carried = carried || (piece.thing != i && reach.intersects(boxes[index]) &&
                                        meets(things[piece.thing], *piece.shape, reach));
                });
    if (!carried)
      notes_.add(places_[i], "'" + thing.name +
                                 "' is not static and nothing carries it: in Gazebo it falls, and "
                                 "here it stays in the air");
  }
}

}  // namespace navvi_sim::read
