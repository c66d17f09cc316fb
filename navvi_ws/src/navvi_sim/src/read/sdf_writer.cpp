#include "read/sdf_writer.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>

namespace navvi_sim::read {
namespace {

/// The shortest text that reads back as the same number.
std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value).ptr;
  return {text, end};
}

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + number(value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string element(const std::string& name, const std::string& text) {
  return "<" + name + ">" + text + "</" + name + ">";
}

/// x y z, and SDF's roll pitch yaw: turned about the fixed axes x, y, z in this order. Nothing for
/// the identity.
std::string pose_element(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d r = pose.linear();
  const Eigen::Vector3d t = pose.translation();
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  double roll = std::atan2(r(2, 1), r(2, 2));
  double yaw = std::atan2(r(1, 0), r(0, 0));
  if (std::hypot(r(0, 0), r(1, 0)) < 1e-9) {  // straight up or down: roll and yaw are one
    roll = 0.0;
    yaw = std::atan2(-r(0, 1), r(1, 1));
  }
  const std::string text = numbers({t.x(), t.y(), t.z(), roll, pitch, yaw});
  return text == "0 0 0 0 0 0" ? "" : element("pose", text);
}

/// Of the visuals, much as in the scene (r g b a).
const char* color_of(ThingClass thing_class) {
  static constexpr std::array<const char*, names(ThingClass{}).size()> kColors{
      "0.6 0.6 0.58 1",    // floor
      "0.33 0.45 0.58 1",  // shelf
      "0.78 0.78 0.78 1",  // wall
      "0.85 0.68 0.3 1",   // box
      "0.72 0.42 0.16 1",  // pedestal
      "0.2 0.8 0.35 1",    // worker
      "1 0.5 0 1",         // forklift
      "0 0.8 0.8 1",       // pallet robot
      "0.55 0.55 0.5 1",   // other
  };
  return kColors[static_cast<std::size_t>(thing_class)];
}

class GeometryWriter {
 public:
  explicit GeometryWriter(const std::string& who) : who_(who) {}

  std::string operator()(const Box& box) const {
    return element("box", element("size", numbers({box.size.x(), box.size.y(), box.size.z()})));
  }
  std::string operator()(const Cylinder& cylinder) const {
    return element("cylinder", element("radius", number(cylinder.radius)) +
                                   element("length", number(cylinder.length)));
  }
  std::string operator()(const Sphere& sphere) const {
    return element("sphere", element("radius", number(sphere.radius)));
  }
  std::string operator()(const std::shared_ptr<const Mesh>&) const {
    throw WorldError("thing '" + who_ +
                     "' has a mesh, which cannot be written; allowed are worlds of boxes, "
                     "cylinders and spheres");
  }

 private:
  const std::string& who_;
};

class SdfWriter {
 public:
  explicit SdfWriter(bool visuals) : visuals_(visuals) {}

  [[nodiscard]] std::string write(const WorldDescription& world) {
    out_ =
        "<?xml version=\"1.0\"?>\n"
        "<sdf version=\"1.7\" xmlns:navvi=\"navvi\">\n"
        "<world name=\"" +
        escaped(world.name) + "\">\n" +
        "<light type=\"directional\" name=\"sun\"><pose>0 0 20 0 0 0</pose>"
        "<diffuse>0.9 0.9 0.9 1</diffuse><direction>-0.4 0.3 -0.9</direction></light>\n";
    for (const Thing& thing : world.things) write(thing);
    return out_ + "</world>\n</sdf>\n";
  }

 private:
  void write(const Thing& thing) {
    out_ += "<model name=\"" + escaped(thing.name) + "\">\n<static>true</static>" +
            element("navvi:class", to_string(thing.thing_class)) + pose_element(thing.pose) + "\n";
    if (thing.route) write(*thing.route);
    out_ += "<link name=\"link\">\n";
    std::size_t number = 0;
    for (const Shape& shape : thing.shapes) write(thing, shape, ++number);
    out_ += "</link>\n</model>\n";
  }

  void write(const Thing& thing, const Shape& shape, std::size_t number) {
    const std::string pose = pose_element(shape.pose);
    const std::string geometry =
        element("geometry", std::visit(GeometryWriter(thing.name), shape.geometry));
    const std::string color = color_of(look_of(thing, shape));
    out_ += "<collision name=\"c" + std::to_string(number) + "\">" + pose + geometry +
            (shape.look ? element("navvi:look", to_string(*shape.look)) : "") + "</collision>\n";
    if (!visuals_) return;
    out_ += "<visual name=\"v" + std::to_string(number) + "\">" + pose + geometry +
            element("material", element("ambient", color) + element("diffuse", color)) +
            "</visual>\n";
  }

  void write(const Route& route) {
    const auto truth = [](bool value) { return value ? "\"true\"" : "\"false\""; };
    out_ += "<navvi:route speed=\"" + number(route.speed) + "\" loop=" + truth(route.loop) +
            " delay=\"" + number(route.delay) + "\" yields=" + truth(route.yields) + ">\n";
    for (const Waypoint& waypoint : route.waypoints)
      out_ += "<navvi:waypoint pause=\"" + number(waypoint.pause) + "\" speed=\"" +
              number(waypoint.speed) + "\">" + numbers({waypoint.at.x(), waypoint.at.y()}) +
              "</navvi:waypoint>\n";
    out_ += "</navvi:route>\n";
  }

  bool visuals_;
  std::string out_;
};

}  // namespace

std::string to_sdf(const WorldDescription& world, bool visuals) {
  return SdfWriter(visuals).write(world);
}

}  // namespace navvi_sim::read
