#include "description/validate.hpp"

#include <cmath>
#include <unordered_set>

#include "description/sentence.hpp"

namespace navvi_sim {
namespace {

using Limits = WorldLimits;

[[noreturn]] void refuse(const std::string& who, const std::string& what) {
  throw WorldError(who + " " + what);
}

void check_coordinate(double value, const std::string& who, const std::string& what) {
  if (!(std::abs(value) <= Limits::extent))  // also refuses NaN
    refuse(who, "has " + what + " " + text(value) + "; allowed are -" + text(Limits::extent) +
                    " to " + text(Limits::extent) + " m");
}

void check_size(double value, const std::string& who, const std::string& what) {
  if (!(value > 0.0 && value < Limits::extent))
    refuse(who, "has " + what + " " + text(value) + "; allowed is more than 0 and less than " +
                    text(Limits::extent) + " m");
}

void check_pose(const Eigen::Isometry3d& pose, const std::string& who) {
  for (int axis = 0; axis < 3; ++axis)
    check_coordinate(pose.translation()[axis], who, "a position of");
  const Eigen::Matrix3d rotation = pose.linear();
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(error < 1e-6) || !(rotation.determinant() > 0.0))
    refuse(who, "has a pose that is not a rotation; allowed are rotations without scale or mirror");
}

/// What all meshes of a world may hold together.
struct MeshBudget {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

class GeometryCheck {
 public:
  GeometryCheck(const std::string& who, MeshBudget& budget) : who_(who), budget_(budget) {}

  void operator()(const Box& box) const {
    for (int axis = 0; axis < 3; ++axis) check_size(box.size[axis], who_, "a box of size");
  }
  void operator()(const Cylinder& cylinder) const {
    check_size(cylinder.radius, who_, "a cylinder of radius");
    check_size(cylinder.length, who_, "a cylinder of length");
  }
  void operator()(const Sphere& sphere) const {
    check_size(sphere.radius, who_, "a sphere of radius");
  }
  void operator()(const std::shared_ptr<const Mesh>& mesh) const {
    if (!mesh || mesh->triangles.empty())
      refuse(who_, "has a mesh without triangles; allowed are one or more");
    budget_.vertices += mesh->vertices.size();
    budget_.triangles += mesh->triangles.size();
    if (budget_.vertices > Limits::vertices || budget_.triangles > Limits::triangles)
      refuse(who_, "brings the meshes of the world over " + std::to_string(Limits::triangles) +
                       " triangles or vertices");
    for (const Eigen::Vector3f& vertex : mesh->vertices)
      for (int axis = 0; axis < 3; ++axis)
        check_coordinate(static_cast<double>(vertex[axis]), who_, "a mesh vertex at");
    for (const auto& triangle : mesh->triangles)
      for (const std::uint32_t index : triangle)
        if (index >= mesh->vertices.size())
          refuse(who_, "has a mesh triangle with vertex " + std::to_string(index) +
                           "; the mesh has " + std::to_string(mesh->vertices.size()));
  }

 private:
  const std::string& who_;
  MeshBudget& budget_;
};

void check_pause(double seconds, const std::string& who, const std::string& what) {
  if (!(seconds >= 0.0 && seconds <= Limits::pause))
    refuse(who, "has " + what + " " + text(seconds) + "; allowed are 0 to " + text(Limits::pause) +
                    " s");
}

void check_route(const Route& route, const std::string& who) {
  const std::size_t count = route.waypoints.size();
  if (count < 2 || count > Limits::waypoints)
    refuse(who, "has a route of " + std::to_string(count) + " way-points; allowed are 2 to " +
                    std::to_string(Limits::waypoints));
  double length = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 2; ++axis)
      check_coordinate(route.waypoints[i].at[axis], who, "a way-point at");
    length += (route.waypoints[i].at - route.waypoints[(i + 1) % count].at).norm();
    check_pause(route.waypoints[i].pause, who, "a way-point with pause");
    const double speed = route.waypoints[i].speed;
    if (!(speed >= 0.0 && speed <= Limits::speed))
      refuse(who, "has a way-point with speed " + text(speed) + "; allowed are 0, for the " +
                      "route's, to " + text(Limits::speed) + " m/s");
  }
  if (!(length > 0.01))
    refuse(who, "has a route that leads nowhere; allowed is a length of 0.01 m or more");
  if (!(route.speed > 0.0 && route.speed <= Limits::speed))
    refuse(who, "has a route with speed " + text(route.speed) +
                    "; allowed is more than 0 and up to " + text(Limits::speed) + " m/s");
  check_pause(route.delay, who, "a route with delay");
}

void check_thing(const Thing& thing, MeshBudget& budget) {
  const std::string who = "thing '" + thing.name + "'";
  check_pose(thing.pose, who);
  if (thing.shapes.empty() || thing.shapes.size() > Limits::shapes_per_thing)
    refuse(who, "has " + std::to_string(thing.shapes.size()) + " shapes; allowed are 1 to " +
                    std::to_string(Limits::shapes_per_thing));
  for (const Shape& shape : thing.shapes) {
    check_pose(shape.pose, who);
    std::visit(GeometryCheck(who, budget), shape.geometry);
  }
  if (!thing.route) return;
  if (thing.thing_class == ThingClass::floor)
    refuse(who, "is a floor with a route; a floor must stand still");
  check_route(*thing.route, who);
}

}  // namespace

void validate(const Thing& thing) {
  MeshBudget budget;
  check_thing(thing, budget);
}

void validate(const WorldDescription& world) {
  const std::string who = "world '" + world.name + "'";
  check_coordinate(world.floor_height, who, "a floor height of");
  if (world.things.empty() || world.things.size() > Limits::things)
    refuse(who, "has " + std::to_string(world.things.size()) + " things; allowed are 1 to " +
                    std::to_string(Limits::things));
  std::unordered_set<std::string> names;
  MeshBudget budget;
  bool has_floor = false;
  std::size_t shapes = 0;
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    const Thing& thing = world.things[i];
    if (thing.name.empty())
      refuse(who, "has a thing without a name, number " + std::to_string(i) +
                      "; each needs one of its own");
    if (!names.insert(thing.name).second)
      refuse(who, "has two things named '" + thing.name + "'; each needs a name of its own");
    shapes += thing.shapes.size();
    if (shapes > Limits::shapes)
      refuse(who, "has more than " + std::to_string(Limits::shapes) + " shapes, the most allowed");
    check_thing(thing, budget);
    has_floor = has_floor || thing.thing_class == ThingClass::floor;
  }
  if (!has_floor)
    refuse(who, "has no floor; one thing of class floor is needed for the robot to stand on");
}

}  // namespace navvi_sim
