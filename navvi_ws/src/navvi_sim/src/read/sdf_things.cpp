#include "read/sdf_things.hpp"

#include "description/floor_height.hpp"

namespace navvi_sim::read {
namespace {

constexpr double kPlaneMargin = 2.0;     // m, of a plane beyond the other things
constexpr double kPlaneThickness = 0.1;  // m
constexpr double kDrivenOver = 0.05;     // m, above the floor: what is lower stops no robot
constexpr std::size_t kFewLost = 2;      // things, which any world may lose
constexpr double kLeastFloor = 4.0;      // m^2, level: a room has more, a piece of furniture less

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
    Thing thing;
    thing.name = unique(names_.count(plane.name) ? plane.name + "_plane" : plane.name);
    thing.thing_class = ThingClass::floor;
    loaded.rules[thing.name] = "a plane";
    thing.pose.translation() = Eigen::Vector3d(bounds.center().x(), bounds.center().y(),
                                               plane.height - kPlaneThickness / 2.0);
    thing.shapes.push_back(
        {Box{{size.x(), size.y(), kPlaneThickness}}, Eigen::Isometry3d::Identity()});
    add(std::move(thing), plane.place);
  }
}

void SdfThings::find_floor(const std::filesystem::path& file) {
  add_planes();
  const auto height = main_floor_height(loaded.world.things);
  if (!height)
    throw WorldError(file.string() +
                     ": no thing is a floor with a level surface; allowed are worlds with a "
                     "plane, or with a model that a class rule calls a floor. To add a ground "
                     "plane is safe: it hides nothing");
  loaded.world.floor_height = *height;
  judge_floors(*height);
  for (const std::size_t thing : on_floor_)
    loaded.world.things[thing].pose.translation().z() = *height;
  leave_out_what_is_under(*height, file);
}

/// What rises above the floor and has no floor of its own is an obstacle, whatever its name.
void SdfThings::judge_floors(double height) {
  for (Thing& thing : loaded.world.things) {
    const auto match = if_no_floor_.find(thing.name);
    if (match == if_no_floor_.end() || thing.thing_class != ThingClass::floor ||
        top_of(thing) <= height + kDrivenOver ||
        level_area(thing, height - kDrivenOver, height + kDrivenOver) >= kLeastFloor)
      continue;
    thing.thing_class = match->second.thing_class;
    loaded.rules[thing.name] = match->second.pattern.empty() ? "no floor: it rises above the floor"
                                                             : match->second.pattern;
  }
}

void SdfThings::leave_out_what_is_under(double height, const std::filesystem::path& file) {
  std::vector<Thing>& things = loaded.world.things;
  std::vector<Thing> kept;
  std::vector<std::string> kept_places;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].thing_class != ThingClass::floor && top_of(things[i]) < height) {
      notes_.add(places_[i],
                 "'" + things[i].name + "' is not taken over: all of it lies under the floor");
      continue;
    }
    kept.push_back(std::move(things[i]));
    kept_places.push_back(std::move(places_[i]));
  }
  const std::size_t lost = things.size() - kept.size();
  if (lost > kFewLost && lost > things.size() / 10)
    throw WorldError(file.string() + ": " + std::to_string(lost) + " of " +
                     std::to_string(things.size()) + " things lie under the floor at " +
                     std::to_string(height) +
                     " m; allowed is a tenth. A plane, or a model that a " +
                     "class rule calls a floor, must lie where the things stand");
  things = std::move(kept);
  places_ = std::move(kept_places);
}

}  // namespace navvi_sim::read
