#include "look/dress.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <navvi_types/angles.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <optional>
#include <utility>

namespace navvi_rviz::look {
namespace {

using navvi_types::point_msg;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr std::size_t kVeryMany = 20000;  // cubes; so many are left as RViz draws them
constexpr double kLayer = 0.01;           // m, of a colour over the one it covers
constexpr double kHeight = 0.03;          // m, of the path above the floor
constexpr double kEdge = 0.08;            // m, of each of the two edges of path, goal and turn
constexpr double kThin = 0.04;            // m, of the edge of a box
constexpr double kTile = 8.0;             // m, of the hall, that is drawn or left out as one
constexpr double kBelow = 1.0;            // m; a lower underside is not seen

Color scaled(const Color& color, float factor) {
  return {std::min(1.0F, color.r * factor), std::min(1.0F, color.g * factor),
          std::min(1.0F, color.b * factor)};
}

float brightest(const std_msgs::ColorRGBA& color) {
  return std::max({color.r, color.g, color.b, 1e-3F});
}

/// An empty list of triangles in a marker's place.
Marker triangles(const Marker& marker) {
  Marker list;
  list.header = marker.header;
  list.ns = marker.ns;
  list.id = marker.id;
  list.type = Marker::TRIANGLE_LIST;
  list.action = Marker::ADD;
  list.pose = marker.pose;
  list.scale.x = list.scale.y = list.scale.z = 1.0;
  list.color = color_msg({1.0F, 1.0F, 1.0F});
  return list;
}

/// One of the edges of a face, the outermost first.
struct Frame {
  double width;  ///< m
  Color color;
};

void add_face(const Eigen::Vector3d& middle, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
              const std::vector<Frame>& frames, const Color& fill, Marker& list) {
  double inset = 0.0;
  const double most = std::min(u.norm(), v.norm());
  const auto corner = [&](double a, double b, double in) {
    return point_msg(middle + a * (u - in * u.normalized()) + b * (v - in * v.normalized()));
  };
  constexpr double kA[] = {-1.0, 1.0, 1.0, -1.0, -1.0}, kB[] = {-1.0, -1.0, 1.0, 1.0, -1.0};
  for (const Frame& frame : frames) {
    const double next = std::min(inset + frame.width, 0.8 * most);
    for (int i = 0; i < 4; ++i)
      add_quad({corner(kA[i], kB[i], inset), corner(kA[i + 1], kB[i + 1], inset),
                corner(kA[i + 1], kB[i + 1], next), corner(kA[i], kB[i], next)},
               frame.color, list);
    inset = next;
  }
  add_quad({corner(kA[0], kB[0], inset), corner(kA[1], kB[1], inset), corner(kA[2], kB[2], inset),
            corner(kA[3], kB[3], inset)},
           fill, list);
}

Eigen::Vector3d vector(const geometry_msgs::Point& at) { return {at.x, at.y, at.z}; }

/// Gives a list of triangles the edges of boxes: where two of them in turn make a parallelogram, it
/// is a face. Without edges a triangle is as light as they are, by half.
Marker with_edges(const Marker& marker, const Frame& edge) {
  Marker list = marker;
  list.points.clear();
  list.colors.clear();
  const auto at = [&](std::size_t i) { return vector(marker.points[i]); };
  for (std::size_t i = 0; i + 3 <= marker.points.size(); i += 3) {
    const std_msgs::ColorRGBA& own = marker.colors[i / 3];
    const Color fill{own.r, own.g, own.b};
    const bool face = i + 6 <= marker.points.size() && at(i) == at(i + 3) &&
                      at(i + 2) == at(i + 4) &&
                      (at(i) + at(i + 2) - at(i + 1) - at(i + 5)).norm() < 1e-6;
    if (!face) {
      add_triangle({marker.points[i], marker.points[i + 1], marker.points[i + 2]},
                   scaled(edge.color, 0.5F), list);
      continue;
    }
    add_face(0.5 * (at(i) + at(i + 2)), 0.5 * (at(i + 1) - at(i)), 0.5 * (at(i + 2) - at(i + 1)),
             {edge}, fill, list);
    i += 3;
  }
  return list;
}

/// The faces of a box along the axes, without that on the floor.
void add_box(const Eigen::Vector3d& middle, const Eigen::Vector3d& size,
             const std::vector<Frame>& frames, const Color& top, const Color& side, Marker& list) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double half : {-0.5, 0.5}) {
      Eigen::Vector3d out = Eigen::Vector3d::Zero(), u = out, v = out;
      out[axis] = half * size[axis];
      u[(axis + 1) % 3] = 0.5 * size[(axis + 1) % 3];
      v[(axis + 2) % 3] = 0.5 * size[(axis + 2) % 3];
      if (half < 0.0) u.swap(v);
      if (axis == 2 && half < 0.0 && (middle + out).z() < kBelow) continue;
      const float light = axis == 0 ? 0.9F : 1.0F;
      add_face(middle + out, u, v, frames, axis == 2 ? top : scaled(side, light), list);
    }
  }
}

class Dresser {
 public:
  Dresser(const MarkerArray& markers, const Vision& vision) : vision_(vision) {
    for (const Marker& marker : markers.markers)
      if (marker.type == Marker::CUBE_LIST) cubes_ += marker.points.size();
  }

  [[nodiscard]] MarkerArray dress(const MarkerArray& markers) const {
    MarkerArray array;
    Tiles tiles;
    for (const Marker& marker : markers.markers) {
      if (marker.action == Marker::ADD && marker.type == Marker::TEXT_VIEW_FACING) continue;
      if (marker.action == Marker::ADD && marker.type == Marker::CUBE_LIST && cubes_ < kVeryMany &&
          knows(marker))
        add_boxes(marker, tiles);
      else
        array.markers.push_back(dress(marker));
    }
    for (auto& tile : tiles) {
      tile.second.ns = kStanding;
      tile.second.id = static_cast<int>(array.markers.size());
      array.markers.push_back(std::move(tile.second));
    }
    return array;
  }

 private:
  using Tiles = std::map<std::pair<long, long>, Marker>;

  [[nodiscard]] Marker dress(const Marker& marker) const {
    if (marker.action != Marker::ADD) return marker;
    if (marker.ns == "path") return path(marker);
    if (marker.ns == "goal")
      return marker.type == Marker::CYLINDER ? pole(marker) : ring(marker, kHeight + 3.0 * kLayer);
    if (marker.ns == "stop" && !marker.points.empty())
      return ring(marker, marker.points.front().z);
    if (marker.ns == "turn") return arrow(marker);
    if (marker.ns == "zone" && !marker.points.empty()) return border(marker);
    if (marker.ns == "robot" && marker.type == Marker::CYLINDER) return robot(marker);
    return knows(marker) ? recolored(marker) : marker;
  }

  [[nodiscard]] bool knows(const Marker& marker) const {
    return vision_.fill.count(marker.ns) > 0;
  }

  [[nodiscard]] Color fill(const Marker& marker) const {
    const bool line = marker.type == Marker::LINE_LIST;
    const auto found = vision_.fill.find(line ? marker.ns + " line" : marker.ns);
    if (found != vision_.fill.end()) return found->second;
    return {marker.color.r, marker.color.g, marker.color.b};
  }

  /// What stands around has edges; floors and what moves have none.
  [[nodiscard]] std::optional<Frame> edge(const Marker& marker) const {
    const auto found = vision_.edge.find(marker.ns);
    if (found == vision_.edge.end()) return std::nullopt;
    const bool stumbled_over = marker.ns == "pedestal" || marker.ns == "other";
    return Frame{stumbled_over ? 2.0 * kThin : kThin, found->second};
  }

  [[nodiscard]] Marker recolored(Marker marker) const {
    if (marker.type == Marker::MESH_RESOURCE) return marker;
    const std::optional<Frame> edge = this->edge(marker);
    const bool cubes = edge && marker.type == Marker::CUBE_LIST;  // which cannot have edges
    const Color color = marker.ns == "robot" ? vision_.dark : cubes ? edge->color : fill(marker);
    const float base = brightest(marker.color);
    marker.color = color_msg(color);
    for (std_msgs::ColorRGBA& each : marker.colors)
      each = color_msg(scaled(color, std::min(1.0F, brightest(each) / base)));
    const bool framed = edge && marker.type == Marker::TRIANGLE_LIST &&
                        marker.points.size() == 3 * marker.colors.size();
    return framed ? with_edges(marker, *edge) : marker;
  }

  /// Boards and posts are so thin that their sides are their edges.
  void add_boxes(const Marker& marker, Tiles& tiles) const {
    const Eigen::Vector3d size(marker.scale.x, marker.scale.y, marker.scale.z);
    const std::optional<Frame> edge = this->edge(marker);
    const bool thin = edge && marker.ns == "shelf";
    const std::vector<Frame> frames = edge && !thin ? std::vector{*edge} : std::vector<Frame>{};
    for (const geometry_msgs::Point& at : marker.points) {
      const std::pair tile{std::lround(at.x / kTile), std::lround(at.y / kTile)};
      add_box({at.x, at.y, at.z}, size, frames, fill(marker), thin ? edge->color : fill(marker),
              tiles.try_emplace(tile, triangles(marker)).first->second);
    }
  }

  /// The wide line becomes the two edges, the narrow one the ribbon between them.
  [[nodiscard]] Marker path(const Marker& marker) const {
    std::vector<Eigen::Vector2d> line;
    for (const geometry_msgs::Point& at : marker.points) line.emplace_back(at.x, at.y);
    line = rounded(line);
    Marker list = triangles(marker);
    const double half = 0.5 * vision_.width * marker.scale.x;
    if (marker.id == 0) {
      add_borders(line, half, half + kEdge, kHeight, vision_.dark, list);
      add_ribbon(line, -half, half, kHeight + kLayer, vision_.bright, list);
    } else {
      add_ribbon(line, -half, half, kHeight + 2.0 * kLayer, fill(marker), list);
    }
    return list;
  }

  /// A square pole with edges on each side, so that it has them from wherever it is seen.
  [[nodiscard]] Marker pole(const Marker& marker) const {
    Marker list = triangles(marker);
    const double side = 1.4 * marker.scale.x;
    add_box(Eigen::Vector3d::Zero(), {side, side, marker.scale.z},
            {{kEdge, vision_.dark}, {kEdge, vision_.bright}}, fill(marker), fill(marker), list);
    return list;
  }

  /// \param height  m, above the floor
  [[nodiscard]] Marker ring(const Marker& marker, double height) const {
    return line(marker, marker.points.size(), height, vision_.bright);
  }

  /// Of a zone: one line of a closed one, dashes of a slow one.
  [[nodiscard]] Marker border(const Marker& marker) const {
    const std::size_t most = marker.type == Marker::LINE_LIST ? 2 : marker.points.size();
    return line(marker, most, marker.points.front().z, fill(marker));
  }

  /// A flat line with dark edges, or several of so many points.
  [[nodiscard]] Marker line(const Marker& marker, std::size_t most, double height,
                            const Color& color) const {
    Marker list = triangles(marker);
    const double half = 0.5 * vision_.width * marker.scale.x;
    std::vector<Eigen::Vector2d> line;
    for (const geometry_msgs::Point& at : marker.points) {
      line.emplace_back(at.x, at.y);
      if (line.size() < most) continue;
      add_borders(line, half, half + kEdge, height, vision_.dark, list);
      add_ribbon(line, -half, half, height, color, list);
      line.clear();
    }
    return list;
  }

  [[nodiscard]] Marker arrow(const Marker& marker) const {
    Marker list = triangles(marker);
    if (marker.points.size() != 2) return list;
    const Eigen::Vector2d from(marker.points[0].x, marker.points[0].y);
    const Eigen::Vector2d to(marker.points[1].x, marker.points[1].y);
    const Eigen::Vector2d ahead = (to - from).normalized(), aside(-ahead.y(), ahead.x());
    const double length = (to - from).norm(), wide = vision_.width * marker.scale.y;
    const auto add = [&](double more, double height, const Color& color) {
      const auto place = [&](double along, double across) {
        return point_msg(from + along * ahead + across * aside, height);
      };
      const double neck = length - wide, shaft = 0.25 * wide + more;
      add_quad({place(-more, -shaft), place(neck, -shaft), place(neck, shaft), place(-more, shaft)},
               color, list);
      const double head = 0.75 * wide + 2.0 * more;
      add_triangle(
          {place(neck - more, -head), place(length + 2.0 * more, 0.0), place(neck - more, head)},
          color, list);
    };
    add(2.0 * kEdge, marker.points[0].z, vision_.dark);
    add(kEdge, marker.points[0].z + kLayer, vision_.bright);
    add(0.0, marker.points[0].z + 2.0 * kLayer, fill(marker));
    return list;
  }

  /// A tube with dark rims; the arrow on its lid is the marker after it.
  [[nodiscard]] Marker robot(const Marker& marker) const {
    constexpr int kCorners = 32;
    Marker list = triangles(marker);
    const double radius = 0.5 * marker.scale.x, half = 0.5 * marker.scale.z;
    const auto at = [&](int i, double r, double z) {
      const double angle = 2.0 * navvi_types::kPi * i / kCorners;
      return point_msg({r * std::cos(angle), r * std::sin(angle)}, z);
    };
    const auto band = [&](double low, double high, const Color& color) {
      for (int i = 0; i < kCorners; ++i)
        add_quad({at(i, radius, low), at(i + 1, radius, low), at(i + 1, radius, high),
                  at(i, radius, high)},
                 color, list);
    };
    band(-half, 0.05 - half, vision_.dark);
    band(0.05 - half, half - 0.05, scaled(fill(marker), 0.85F));
    band(half - 0.05, half, vision_.dark);
    const double lid = radius - 0.04;
    for (int i = 0; i < kCorners; ++i) {
      add_triangle({point_msg({0.0, 0.0}, half), at(i, lid, half), at(i + 1, lid, half)},
                   fill(marker), list);
      add_quad({at(i, lid, half), at(i, radius, half), at(i + 1, radius, half), at(i + 1, lid, half)},
               vision_.dark, list);
    }
    return list;
  }

  const Vision& vision_;
  std::size_t cubes_ = 0;
};

}  // namespace

visualization_msgs::MarkerArray dress(const visualization_msgs::MarkerArray& markers,
                                      const Vision& vision) {
  return Dresser(markers, vision).dress(markers);
}

}  // namespace navvi_rviz::look
