#include "navvi_sim/world_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "outline.hpp"

namespace navvi_sim {
namespace {

constexpr double kLongSide = 1500.0;  // px, of the map
constexpr double kMinScale = 4.0;     // px a metre
constexpr double kMaxScale = 40.0;    // px a metre
constexpr double kFrame = 24.0;       // px, around everything
constexpr double kHead = 64.0;        // px, title
constexpr double kLegend = 250.0;     // px, width
constexpr double kLine = 26.0;        // px, height of a line of the legend

struct Paint {
  const char* fill;
  const char* edge;
};

/// Hues as in the scene in RViz, on a light ground.
Paint paint_of(ThingClass thing_class) {
  switch (thing_class) {
    case ThingClass::floor:
      return {"#f4f3ee", "#d8d6cc"};
    case ThingClass::shelf:
      return {"#7d9bbd", "#34506f"};
    case ThingClass::wall:
      return {"#4a4a4a", "#2b2b2b"};
    case ThingClass::box:
      return {"#f2cf3b", "#8a7000"};
    case ThingClass::pedestal:
      return {"#c08a55", "#6e4315"};
    case ThingClass::worker:
      return {"#27b04b", "#0c5a20"};
    case ThingClass::forklift:
      return {"#ff8a1f", "#8f4300"};
    case ThingClass::pallet_robot:
      return {"#17b3b3", "#005f5f"};
    case ThingClass::other:
      break;
  }
  return {"#d3c8aa", "#6b6350"};
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  std::string result(text);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result == "-0" ? "0" : result;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result;
}

class Picture {
 public:
  Picture(const WorldDescription& world, const std::optional<Scenario>& scenario,
          std::string caption)
      : world_(world), scenario_(scenario), caption_(std::move(caption)) {
    for (const Thing& thing : world.things)
      for (Outline& outline : outlines_of(thing)) {
        for (const auto& ring : outline.rings)
          for (const Eigen::Vector2d& p : ring) bounds_.extend(p);
        (thing.route ? moving_ : standing_).push_back(std::move(outline));
      }
    if (bounds_.isEmpty())
      bounds_.extend(Eigen::Vector2d(-1.0, -1.0)).extend(Eigen::Vector2d(1.0, 1.0));
    scale_ = std::clamp(kLongSide / bounds_.sizes().maxCoeff(), kMinScale, kMaxScale);
    const auto by_height = [](const Outline& a, const Outline& b) { return a.top < b.top; };
    std::stable_sort(standing_.begin(), standing_.end(), by_height);
    // Those that move are drawn thing by thing, and within a thing from below.
  }

  [[nodiscard]] std::string draw() {
    const double map_width = bounds_.sizes().x() * scale_;
    const double map_height = bounds_.sizes().y() * scale_;
    const double width = 3.0 * kFrame + map_width + kLegend;
    const double height = kHead + std::max(map_height, 15.0 * kLine) + kFrame + 50.0;
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << number(width) << "\" height=\""
         << number(height) << "\" viewBox=\"0 0 " << number(width) << ' ' << number(height)
         << "\" font-family=\"sans-serif\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    write(kFrame, 30.0, 22.0, world_.name);
    write(kFrame, 52.0, 14.0, caption_);
    for (const Outline& outline : standing_) draw_outline(outline);
    for (const Thing& thing : world_.things)
      if (thing.route) draw_route(thing);
    for (const Outline& outline : moving_) draw_outline(outline);
    for (const Thing& thing : world_.things)
      if (thing.route) draw_heading(thing);
    if (scenario_) draw_scenario();
    draw_scale(kFrame, kHead + map_height + 30.0);
    draw_legend(2.0 * kFrame + map_width, kHead + kLine);
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  [[nodiscard]] Eigen::Vector2d px(const Eigen::Vector2d& p) const {
    return {kFrame + (p.x() - bounds_.min().x()) * scale_,
            kHead + (bounds_.max().y() - p.y()) * scale_};
  }
  [[nodiscard]] std::string at(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d q = px(p);
    return number(q.x()) + "," + number(q.y());
  }
  [[nodiscard]] std::string ring_path(const std::vector<Eigen::Vector2d>& ring, bool closed) const {
    std::string path;
    for (const Eigen::Vector2d& p : ring) path += (path.empty() ? "M" : "L") + at(p);
    return path + (closed ? "Z" : "");
  }
  void write(double x, double y, double size, const std::string& text,
             const std::string& more = "") {
    out_ << "<text x=\"" << number(x) << "\" y=\"" << number(y) << "\" font-size=\"" << number(size)
         << "\" " << more << ">" << escaped(text) << "</text>\n";
  }
  /// px; thin lines of large halls are not thicker than what they bound.
  [[nodiscard]] double stroke(double metres) const { return std::clamp(metres * scale_, 0.4, 2.0); }

  void draw_outline(const Outline& outline) {
    const Paint paint = paint_of(outline.look);
    std::string path;
    for (const auto& ring : outline.rings) path += ring_path(ring, true);
    const bool one = outline.rings.size() == 1;
    out_ << "<path d=\"" << path << "\" fill=\"" << paint.fill << '"';
    if (one)
      out_ << " stroke=\"" << paint.edge << "\" stroke-width=\"" << number(stroke(0.04)) << '"';
    out_ << "/>\n";
    if (!outline.is_box) return;
    const auto& ring = outline.rings.front();
    if (outline.look == ThingClass::box) {  // taped
      draw_line({(ring[0] + ring[3]) / 2.0, (ring[1] + ring[2]) / 2.0}, paint.edge, 0.05);
    } else if (outline.look == ThingClass::pedestal) {  // slats
      for (const double share : {0.25, 0.5, 0.75})
        draw_line({ring[0] + share * (ring[1] - ring[0]), ring[3] + share * (ring[2] - ring[3])},
                  paint.edge, 0.05);
    } else if (outline.look == ThingClass::other) {  // a door's leaves
      draw_line({(ring[0] + ring[1]) / 2.0, (ring[2] + ring[3]) / 2.0}, paint.edge, 0.05);
    }
  }

  void draw_line(const std::vector<Eigen::Vector2d>& line, const char* color, double metres,
                 const std::string& more = "") {
    out_ << "<path d=\"" << ring_path(line, false) << "\" fill=\"none\" stroke=\"" << color
         << "\" stroke-width=\"" << number(stroke(metres)) << "\" " << more << "/>\n";
  }

  void draw_route(const Thing& thing) {
    const char* color = paint_of(thing.thing_class).edge;
    std::vector<Eigen::Vector2d> line;
    for (const Waypoint& waypoint : thing.route->waypoints) line.push_back(waypoint.at);
    if (thing.route->loop && line.size() > 2) line.push_back(line.front());
    draw_line(line, color, 0.06, "stroke-dasharray=\"6 4\" opacity=\"0.8\"");
    const double size = std::clamp(0.2 * scale_, 2.0, 6.0) / scale_;
    for (const Waypoint& waypoint : thing.route->waypoints) {
      if (!(waypoint.pause > 0.0)) continue;
      const std::vector<Eigen::Vector2d> diamond{
          waypoint.at + Eigen::Vector2d(size, 0.0), waypoint.at + Eigen::Vector2d(0.0, size),
          waypoint.at - Eigen::Vector2d(size, 0.0), waypoint.at - Eigen::Vector2d(0.0, size)};
      out_ << "<path d=\"" << ring_path(diamond, true) << "\" fill=\"#ffffff\" stroke=\"" << color
           << "\"/>\n";
    }
  }

  /// An arrow head over what moves says where ahead is.
  void draw_heading(const Thing& thing) {
    const Eigen::Vector2d centre = thing.pose.translation().head<2>();
    Eigen::Vector2d ahead = thing.pose.linear().col(0).head<2>();
    if (ahead.norm() < 1e-6) return;
    ahead.normalize();
    const Eigen::Vector2d left(-ahead.y(), ahead.x());
    const double size = std::max(0.22, 4.0 / scale_);
    out_ << "<path d=\""
         << ring_path({centre + size * ahead, centre - size * (0.7 * ahead - 0.7 * left),
                       centre - size * (0.7 * ahead + 0.7 * left)},
                      true)
         << "\" fill=\"#ffffff\" stroke=\"" << paint_of(thing.thing_class).edge << "\"/>\n";
  }

  void draw_scenario() {
    if (!scenario_->route.empty()) {
      out_ << "<path d=\"" << ring_path(scenario_->route, false)
           << "\" fill=\"none\" stroke=\"#9b00d3\" stroke-width=\"3\" stroke-linejoin=\"round\" "
              "opacity=\"0.75\"/>\n";
    }
    draw_goal(px(scenario_->goal));
    draw_start(px({scenario_->start.x, scenario_->start.y}), scenario_->start.yaw,
               std::max(0.35 * scale_, 7.0));
    label(px({scenario_->start.x, scenario_->start.y}), "start");
    label(px(scenario_->goal), "goal");
  }
  void draw_start(const Eigen::Vector2d& p, double yaw, double size) {
    out_ << "<g transform=\"translate(" << number(p.x()) << ',' << number(p.y()) << ") rotate("
         << number(-yaw * 180.0 / M_PI) << ") scale(" << number(size)
         << ")\"><circle r=\"1\" fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"0.2\"/>"
         << "<path d=\"M1.5,0L-0.5,0.75L-0.5,-0.75Z\" fill=\"#9b00d3\"/></g>\n";
  }
  void draw_goal(const Eigen::Vector2d& p) {
    out_ << "<g transform=\"translate(" << number(p.x()) << ',' << number(p.y())
         << ")\"><circle r=\"11\" fill=\"#ffffff\" stroke=\"#d00000\" stroke-width=\"3\"/>"
         << "<circle r=\"5\" fill=\"#d00000\"/></g>\n";
  }
  void label(const Eigen::Vector2d& p, const std::string& text) {
    write(p.x() + 16.0, p.y() - 8.0, 14.0, text,
          "font-weight=\"bold\" stroke=\"#ffffff\" stroke-width=\"4\" paint-order=\"stroke\"");
  }

  /// A bar of 1, 2 or 5 times a power of ten metres.
  void draw_scale(double x, double y) {
    double length = 1.0;
    const double most = std::max(1.0, bounds_.sizes().x() / 4.0);
    for (const double next : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
      if (next <= most) length = next;
    const double width = length * scale_;
    for (int part = 0; part < 4; ++part)
      out_ << "<rect x=\"" << number(x + part * width / 4.0) << "\" y=\"" << number(y)
           << "\" width=\"" << number(width / 4.0) << "\" height=\"6\" stroke=\"#000000\" fill=\""
           << (part % 2 == 0 ? "#000000" : "#ffffff") << "\"/>\n";
    write(x + width + 8.0, y + 9.0, 14.0, number(length) + " m");
    // North, as far as the map is concerned.
    const double north = x + bounds_.sizes().x() * scale_ - 20.0;
    out_ << "<path d=\"M" << number(north) << ',' << number(y + 14.0) << "l0,-26l-5,9m5,-9l5,9\" "
         << "fill=\"none\" stroke=\"#000000\" stroke-width=\"2\"/>\n";
    write(north + 10.0, y + 9.0, 14.0, "y");
  }

  void draw_legend(double x, double y) {
    std::map<ThingClass, std::pair<int, int>> counts;  // standing, moving
    for (const Thing& thing : world_.things) {
      auto& [standing, moving] = counts[thing.thing_class];
      ++(thing.route ? moving : standing);
    }
    for (const auto& [thing_class, count] : counts) {
      if (thing_class == ThingClass::floor) continue;
      draw_swatch(thing_class, {x + 16.0, y - 6.0});
      std::string words = to_string(thing_class);
      std::replace(words.begin(), words.end(), '_', ' ');
      words += " (" + std::to_string(count.first + count.second);
      if (count.second > 0) words += ", " + std::to_string(count.second) + " moving";
      write(x + 42.0, y, 14.0, words + ")");
      y += kLine;
    }
    y = draw_other_legends(x, y + kLine / 2.0);
    if (!scenario_) return;
    draw_start({x + 16.0, y - 5.0}, 0.0, 8.0);
    write(x + 42.0, y, 14.0, "start of the robot");
    y += 1.2 * kLine;
    draw_goal({x + 16.0, y - 5.0});
    write(x + 42.0, y, 14.0, "goal");
    y += 1.2 * kLine;
    out_ << "<path d=\"M" << number(x) << ',' << number(y - 5.0)
         << "h32\" stroke=\"#9b00d3\" stroke-width=\"3\"/>\n";
    write(x + 42.0, y, 14.0, "shortest way");
  }

  /// Doors of docks, and routes, where there are any. \return y, px, of the next line
  double draw_other_legends(double x, double y) {
    const auto any = [&](const auto& has) {
      return std::any_of(world_.things.begin(), world_.things.end(), has);
    };
    if (any([](const Thing& thing) {
          return thing.thing_class == ThingClass::wall && thing.shapes.size() == 1 &&
                 thing.shapes.front().look == ThingClass::other;
        })) {
      const Paint paint = paint_of(ThingClass::other);
      out_ << "<rect x=\"" << number(x) << "\" y=\"" << number(y - 8.0)
           << "\" width=\"32\" height=\"5\" fill=\"" << paint.fill << "\" stroke=\"" << paint.edge
           << "\"/>\n";
      write(x + 42.0, y, 14.0, "dock door");
      y += kLine;
    }
    if (any([](const Thing& thing) { return thing.route.has_value(); })) {
      out_ << "<path d=\"M" << number(x) << ',' << number(y - 5.0)
           << "h32\" stroke=\"#8f4300\" stroke-width=\"2\" stroke-dasharray=\"6 4\"/>\n"
           << "<path d=\"M" << number(x + 16.0) << ',' << number(y - 11.0)
           << "l6,6l-6,6l-6,-6Z\" fill=\"#ffffff\" stroke=\"#8f4300\"/>\n";
      write(x + 42.0, y, 14.0, "route, and a stop");
      y += kLine;
    }
    return y + 0.2 * kLine;
  }

  /// One such thing, drawn as in the map at a scale of its own.
  void draw_swatch(ThingClass thing_class, const Eigen::Vector2d& p) {
    for (const Thing& thing : world_.things) {
      if (thing.thing_class != thing_class) continue;
      const auto outlines = outlines_of(thing);
      Eigen::AlignedBox2d bounds;
      for (const Outline& outline : outlines) bounds.extend(outline.local);
      const bool is_line =
          bounds.isEmpty() || bounds.sizes().minCoeff() < 0.15 * bounds.sizes().maxCoeff();
      if (is_line || outlines.front().rings.size() != 1) break;
      const double scale = std::min(32.0 / bounds.sizes().x(), 18.0 / bounds.sizes().y());
      const double yaw = std::atan2(thing.pose.linear()(1, 0), thing.pose.linear()(0, 0));
      const Eigen::Vector2d place = px(thing.pose.translation().head<2>());
      const Eigen::Vector2d middle = bounds.center() * scale_;
      out_ << "<g transform=\"translate(" << number(p.x()) << ',' << number(p.y()) << ") scale("
           << number(scale / scale_) << ") translate(" << number(-middle.x()) << ','
           << number(middle.y()) << ") rotate(" << number(yaw * 180.0 / M_PI) << ") translate("
           << number(-place.x()) << ',' << number(-place.y()) << ")\">\n";
      for (const Outline& outline : outlines) draw_outline(outline);
      out_ << "</g>\n";
      return;
    }
    out_ << "<rect x=\"" << number(p.x() - 16.0) << "\" y=\"" << number(p.y() - 8.0)
         << "\" width=\"32\" height=\"16\" fill=\"" << paint_of(thing_class).fill << "\" stroke=\""
         << paint_of(thing_class).edge << "\"/>\n";
  }

  const WorldDescription& world_;
  const std::optional<Scenario>& scenario_;
  std::string caption_;
  std::vector<Outline> standing_, moving_;
  Eigen::AlignedBox2d bounds_;  ///< m, in map
  double scale_ = 1.0;          ///< px a metre
  std::ostringstream out_;
};

}  // namespace

std::string world_picture(const WorldDescription& world, const std::optional<Scenario>& scenario,
                          const std::string& caption) {
  return Picture(world, scenario, caption).draw();
}

}  // namespace navvi_sim
