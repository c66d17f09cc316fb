#include "navvi_sim/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "description/floor_height.hpp"
#include "scene/cube_lists.hpp"
#include "scene/painter.hpp"
#include "scene/rack_drawing.hpp"

namespace navvi_sim::scene {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kWallCut = 1.0;  // m above the floor, to which walls are drawn
constexpr double kCut = 2.7;      // m above the floor, to which everything else is drawn
constexpr double kNoCut = std::numeric_limits<double>::max();
constexpr std::size_t kMostLists = 500;  // of cubes
constexpr double kBoxGrid = 0.1;         // m, of the sizes of boxes on shelves
constexpr double kCoarseGrid = 0.2;      // m, likewise, in worlds of very many things
constexpr std::size_t kVeryMany = 1000;  // things
constexpr double kFloorGrid = 5.0;       // m, between lines on the floor
constexpr std::size_t kMany = 100;       // movers; beyond, far ones take turns
constexpr double kFar = 30.0;            // m from the robot
constexpr std::uint64_t kTurns = 10;     // a far mover is in one message of these

constexpr Color kFloorLine{0.17F, 0.19F, 0.21F};
constexpr Color kRobot{0.95F, 1.00F, 0.95F};
constexpr Color kNose{0.00F, 1.00F, 0.20F};

/// What is drawn in place of a thing's own shapes, as large as they are together.
std::optional<std::string> model_of(ThingClass thing_class) {
  switch (thing_class) {
    case ThingClass::worker:
    case ThingClass::forklift:
    case ThingClass::pallet_robot:
      return std::string("package://navvi_sim/meshes/") + to_string(thing_class) + ".dae";
    default:
      return std::nullopt;
  }
}

bool is_upright(const Eigen::Isometry3d& pose) { return pose.linear()(2, 2) > 1.0 - 1e-6; }

/// A box whose faces look along the axes of map.
std::optional<Eigen::AlignedBox3d> cube_of(const Geometry& geometry,
                                           const Eigen::Isometry3d& pose) {
  if (!std::holds_alternative<Box>(geometry) || !is_upright(pose)) return std::nullopt;
  const double x = std::abs(pose.linear()(0, 0));
  if (x > 1e-6 && x < 1.0 - 1e-6) return std::nullopt;
  return bounds_of(geometry, pose);
}

/// The markers of everything that stands still.
class StaticMarkers {
 public:
  explicit StaticMarkers(const WorldDescription& world)
      : floor_(world.floor_height),
        grid_(world.things.size() > kVeryMany ? kCoarseGrid : kBoxGrid) {}

  void add(const Thing& thing) {
    if (thing.thing_class == ThingClass::shelf) return add_shelf(thing);
    for (const Shape& shape : thing.shapes) {
      const ThingClass look = look_of(thing, shape);
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      add(look, color_of(look), shape.geometry, pose);
      if (look == ThingClass::floor) ground_.extend(bounds_of(shape.geometry, pose));
    }
  }

  void append_to(MarkerArray& array, std::map<std::string, int>& next_id) {
    for (auto& [ns, msg] : triangles_) {
      if (msg.points.empty()) continue;
      msg.id = next_id[ns]++;
      array.markers.push_back(std::move(msg));
    }
    for (Marker& msg : cubes_.markers(kMostLists, next_id)) array.markers.push_back(std::move(msg));
    if (!ground_.isEmpty()) array.markers.push_back(floor_lines(next_id["floor"]++));
  }

 private:
  /// A rack is drawn so that it is seen into: from above through its highest board, of which only
  /// the rim is drawn, and from aside through what is a solid box to the driver.
  void add_shelf(const Thing& thing) {
    Eigen::AlignedBox3d bounds;
    for (const Shape& shape : thing.shapes) bounds.extend(bounds_of(shape.geometry, shape.pose));
    for (const Shape& shape : thing.shapes) {
      const ThingClass look = look_of(thing, shape);
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      const auto* box = std::get_if<Box>(&shape.geometry);
      if (!box || look == ThingClass::box || !is_upright(shape.pose)) {
        add(look, color_of(look), shape.geometry, pose, look == ThingClass::box);
        continue;
      }
      const double top = shape.pose.translation().z() + 0.5 * box->size.z();
      for (const ColoredCube& part : shelf_parts(box->size, top > bounds.max().z() - 1e-6))
        add(look, part.color, Box{part.cube.sizes()},
            pose * Eigen::Translation3d(part.cube.center()));
    }
  }

  void add(ThingClass look, const Color& color, const Geometry& geometry,
           const Eigen::Isometry3d& pose, bool coarse = false) {
    const std::string ns = to_string(look);
    const double cut = floor_ + (look == ThingClass::wall ? kWallCut : kCut);
    if (bounds_of(geometry, pose).min().z() >= cut) return;
    auto cube = cube_of(geometry, pose);
    if (cube && cube->sizes().head<2>().maxCoeff() <= kLongestCube + 1e-6) {
      cube->max().z() = std::min(cube->max().z(), cut);
      if (coarse) *cube = on_grid(*cube);
      return cubes_.add(ns, color, *cube);
    }
    if (triangles_.count(ns) == 0)
      triangles_[ns] = marker_msg(ns, 0, Marker::TRIANGLE_LIST, color_of(look));
    Painter(triangles_[ns], color, cut).shape(geometry, pose);
  }

  /// Not larger, with its centre and underside where they were: so that many have one size.
  [[nodiscard]] Eigen::AlignedBox3d on_grid(const Eigen::AlignedBox3d& cube) const {
    const Eigen::Vector3d size = cube.sizes().unaryExpr([this](double side) {
      return std::max(std::min(side, grid_), grid_ * std::floor(side / grid_ + 1e-6));
    });
    Eigen::Vector3d centre = cube.center();
    centre.z() = cube.min().z() + 0.5 * size.z();
    return {centre - 0.5 * size, centre + 0.5 * size};
  }

  /// Motion is seen against something.
  [[nodiscard]] Marker floor_lines(int id) const {
    Marker msg = marker_msg("floor", id, Marker::LINE_LIST, kFloorLine);
    msg.scale.x = 0.04;
    const Eigen::Vector3d low = ground_.min(), high = ground_.max();
    for (int axis = 0; axis < 2; ++axis) {
      for (double at = std::ceil(low[axis] / kFloorGrid) * kFloorGrid; at <= high[axis];
           at += kFloorGrid) {
        for (const Eigen::Vector3d& end : {low, high}) {
          Eigen::Vector3d point(end.x(), end.y(), floor_ + 0.01);
          point[axis] = at;
          msg.points.push_back(point_msg(point));
        }
      }
    }
    return msg;
  }

  double floor_;
  double grid_;
  CubeLists cubes_;
  std::map<std::string, Marker> triangles_;
  Eigen::AlignedBox3d ground_;
};

}  // namespace

Scene::Scene(const WorldDescription& world, const physics::RobotConfig& robot)
    : world_(world), robot_(parts_of(robot)) {
  std::map<std::string, int> next_id;
  for (std::size_t id = 0; id < world.things.size(); ++id)
    if (world.things[id].route) movers_[id] = parts_of(world.things[id], next_id);
}

/// The model of its class where there is one, or a marker a shape.
Scene::Parts Scene::parts_of(const Thing& thing, std::map<std::string, int>& next_id) const {
  Parts parts;
  const auto model = model_of(thing.thing_class);
  if (model && is_upright(thing.pose)) {
    const std::string ns = to_string(thing.thing_class);
    Eigen::AlignedBox3d bounds;
    for (const Shape& shape : thing.shapes) bounds.extend(bounds_of(shape.geometry, shape.pose));
    Marker msg =
        marker_msg(ns, next_id[ns]++, Marker::MESH_RESOURCE, {0.0F, 0.0F, 0.0F}, bounds.sizes());
    msg.color.a = 0.0F;  // no tint: the model's own colours
    msg.mesh_resource = *model;
    msg.mesh_use_embedded_materials = true;
    parts.push_back({std::move(msg), Eigen::Isometry3d(Eigen::Translation3d(bounds.center()))});
    return parts;
  }
  for (const Shape& shape : thing.shapes) {
    const ThingClass look = look_of(thing, shape);
    const std::string ns = to_string(look);
    const auto* box = std::get_if<Box>(&shape.geometry);
    Marker msg = marker_msg(ns, next_id[ns]++, box ? int{Marker::CUBE} : int{Marker::TRIANGLE_LIST},
                            color_of(look), box ? box->size : Eigen::Vector3d::Ones());
    if (!box)
      Painter(msg, color_of(look), kNoCut).shape(shape.geometry, Eigen::Isometry3d::Identity());
    parts.push_back({std::move(msg), shape.pose});
  }
  return parts;
}

MarkerArray Scene::standing(const ros::Time& stamp) const {
  MarkerArray array;
  std::map<std::string, int> next_id;
  StaticMarkers still(world_);
  for (const Thing& thing : world_.things) {
    if (thing.route) continue;
    if (!model_of(thing.thing_class) || !is_upright(thing.pose)) {
      still.add(thing);
      continue;
    }
    for (Part& part : parts_of(thing, next_id)) {
      part.marker.pose = pose_msg(thing.pose * part.pose);
      array.markers.push_back(std::move(part.marker));
    }
  }
  still.append_to(array, next_id);
  for (Marker& msg : array.markers) msg.header.stamp = stamp;
  return array;
}

const MarkerArray& Scene::moving(const live::Snapshot& now, const ros::Time& stamp) {
  std::size_t count = 0;
  // Into the markers of the last call: what they hold need not be made anew.
  const auto show = [&](const Parts& parts, const Eigen::Isometry3d& pose) {
    for (const Part& part : parts) {
      if (count == moving_.markers.size()) moving_.markers.emplace_back();
      Marker& msg = moving_.markers[count++];
      msg = part.marker;
      msg.header.stamp = stamp;
      msg.pose = pose_msg(pose * part.pose);
    }
  };
  ++turn_;
  for (std::size_t i = 0; i < now.movers.size(); ++i) {
    const MoverState& mover = now.movers[i];
    const Eigen::Vector2d away = mover.pose.translation().head<2>() - now.robot.position;
    const bool has_turn = now.movers.size() <= kMany || (turn_ + i) % kTurns == 0;
    if (has_turn || away.norm() <= kFar) show(movers_.at(mover.thing.id), mover.pose);
  }
  Eigen::Isometry3d base(Eigen::AngleAxisd(now.robot.yaw, Eigen::Vector3d::UnitZ()));
  base.translation() << now.robot.position, world_.floor_height;
  show(robot_, base);
  moving_.markers.resize(count);
  return moving_;
}

Scene::Parts Scene::parts_of(const physics::RobotConfig& robot) {
  const double r = robot.radius;
  const Marker body =
      marker_msg("robot", 0, Marker::CYLINDER, kRobot, {2.0 * r, 2.0 * r, robot.height});

  // A flat arrow head over the lid, its tip over the rim, shows the heading.
  Marker nose = marker_msg("robot", 1, Marker::TRIANGLE_LIST, kNose);
  Painter(nose, kNose, kNoCut)
      .triangle({1.5 * r, 0.0, 0.0}, {-0.6 * r, 0.75 * r, 0.0}, {-0.6 * r, -0.75 * r, 0.0});
  const auto above = [](double z) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); };
  return {{body, above(robot.height / 2.0)}, {nose, above(robot.height + 0.02)}};
}

}  // namespace navvi_sim::scene
