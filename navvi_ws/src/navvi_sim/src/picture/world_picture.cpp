#include "picture/world_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "picture/map_canvas.hpp"

namespace navvi_sim::picture {
namespace {

constexpr double kLongSide = 1500.0;  // px, of the map
constexpr double kMinScale = 4.0;     // px a metre
constexpr double kMaxScale = 40.0;    // px a metre
constexpr double kFrame = 24.0;       // px, around everything
constexpr double kHead = 64.0;        // px, title
constexpr double kLegend = 250.0;     // px, width
constexpr double kMargin = 2.0;       // m, of floor around what stands
constexpr double kLabel = 70.0;       // px, from a symbol to the end of its name
constexpr double kLegendLine = 26.0;  // px, height of a line of the legend

/// What stands, from below, what hangs, and what moves, thing by thing.
struct Outlines {
  std::vector<Outline> standing, moving;
  Eigen::AlignedBox2d bounds;  ///< m, in map, of what is shown; not empty
  int beyond = 0;              ///< things that are not, since they lie far from all others
};

/// Chooses what is shown: everything but the floor's margin, and the few things without which the
/// rest would be drawn twice as large.
void choose_bounds(Outlines& all, std::vector<Eigen::AlignedBox2d> things,
                   const Eigen::AlignedBox2d& ground, const Eigen::AlignedBox2d& needed) {
  const auto around = [&](std::size_t without) {
    Eigen::AlignedBox2d box = needed;
    for (std::size_t i = 0; i < things.size(); ++i)
      if (i != without) box.extend(things[i]);
    return box;
  };
  const auto side = [&](std::size_t without) { return around(without).sizes().maxCoeff(); };
  for (std::size_t few = std::min<std::size_t>(things.size() / 20, 8); few > 0; --few) {
    std::size_t far = 0;
    for (std::size_t i = 1; i < things.size(); ++i)
      if (side(i) < side(far)) far = i;
    if (2.0 * side(far) > side(things.size())) break;
    things.erase(things.begin() + static_cast<std::ptrdiff_t>(far));
    ++all.beyond;
  }
  all.bounds = around(things.size());
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin);
  if (all.bounds.isEmpty())
    all.bounds = ground;
  else
    all.bounds.extend(Eigen::AlignedBox2d(all.bounds.min() - margin, all.bounds.max() + margin)
                          .intersection(ground));
  if (all.bounds.isEmpty())
    all.bounds.extend(Eigen::Vector2d(-1.0, -1.0)).extend(Eigen::Vector2d(1.0, 1.0));
}

Outlines all_outlines(const WorldDescription& world,
                      const std::optional<scenario::StartAndGoal>& scenario) {
  Outlines all;
  std::vector<Eigen::AlignedBox2d> things;
  Eigen::AlignedBox2d ground, needed;
  for (const Thing& thing : world.things) {
    Eigen::AlignedBox2d bounds;
    for (Outline& outline : outlines_of(thing, world.floor_height)) {
      for (const auto* set : {&outline.rings, &outline.solid, &outline.lines})
        for (const auto& ring : *set)
          for (const Eigen::Vector2d& p : ring)
            (outline.look == ThingClass::floor ? ground : bounds).extend(p);
      (thing.route ? all.moving : all.standing).push_back(std::move(outline));
    }
    if (!bounds.isEmpty()) things.push_back(bounds);
    if (thing.route)
      for (const Waypoint& waypoint : thing.route->waypoints) needed.extend(waypoint.at);
  }
  if (scenario) needed.extend(scenario->start.position).extend(scenario->goal);
  choose_bounds(all, std::move(things), ground, needed);
  std::stable_sort(all.standing.begin(), all.standing.end(),
                   [](const Outline& a, const Outline& b) {
                     return std::make_pair(a.hangs, a.top) < std::make_pair(b.hangs, b.top);
                   });
  return all;
}

void draw_route(MapCanvas& canvas, const Thing& thing) {
  const char* color = paint_of(thing.thing_class).edge;
  std::vector<Eigen::Vector2d> line;
  for (const Waypoint& waypoint : thing.route->waypoints) line.push_back(waypoint.at);
  if (thing.route->loop && line.size() > 2) line.push_back(line.front());
  canvas.line(line, color, 0.06, "stroke-dasharray=\"6 4\" opacity=\"0.8\"");
  const double size = std::clamp(0.2 * canvas.scale(), 2.0, 6.0) / canvas.scale();
  for (const Waypoint& waypoint : thing.route->waypoints) {
    if (!(waypoint.pause > 0.0)) continue;
    const std::vector<Eigen::Vector2d> diamond{
        waypoint.at + Eigen::Vector2d(size, 0.0), waypoint.at + Eigen::Vector2d(0.0, size),
        waypoint.at - Eigen::Vector2d(size, 0.0), waypoint.at - Eigen::Vector2d(0.0, size)};
    canvas.svg() << "<path d=\"" << canvas.path(diamond, true) << "\" fill=\"#ffffff\" stroke=\""
                 << color << "\"/>\n";
  }
}

/// An arrow head over what moves shows its heading.
void draw_heading(MapCanvas& canvas, const Thing& thing) {
  const Eigen::Vector2d centre = thing.pose.translation().head<2>();
  Eigen::Vector2d ahead = thing.pose.linear().col(0).head<2>();
  if (ahead.norm() < 1e-6) return;
  ahead.normalize();
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const double size = std::max(0.22, 4.0 / canvas.scale());
  canvas.svg() << "<path d=\""
               << canvas.path({centre + size * ahead, centre - size * (0.7 * ahead - 0.7 * left),
                               centre - size * (0.7 * ahead + 0.7 * left)},
                              true)
               << "\" fill=\"#ffffff\" stroke=\"" << paint_of(thing.thing_class).edge << "\"/>\n";
}

void label(MapCanvas& canvas, const Eigen::Vector2d& p, const std::string& text) {
  const bool fits = p.x() + kLabel < canvas.px(canvas.area().max()).x();
  canvas.text({p.x() + (fits ? 16.0 : -16.0), p.y() - 8.0}, 14.0, text,
              std::string("font-weight=\"bold\" stroke=\"#ffffff\" stroke-width=\"4\" "
                          "paint-order=\"stroke\" text-anchor=\"") +
                  (fits ? "start\"" : "end\""));
}

void draw_turn(MapCanvas& canvas, const Eigen::Vector2d& page) {
  canvas.svg() << "<circle cx=\"" << svg_number(page.x()) << "\" cy=\"" << svg_number(page.y())
               << "\" r=\"5\" fill=\"#ffffff\" stroke=\"#9b00d3\" stroke-width=\"2.5\"/>\n";
}

void draw_scenario(MapCanvas& canvas, const scenario::StartAndGoal& scenario, const Guide& guide) {
  const auto& way = guide.path.empty() ? scenario.route : guide.path;
  if (!way.empty()) {
    canvas.svg()
        << "<path d=\"" << canvas.path(way, false)
        << "\" fill=\"none\" stroke=\"#9b00d3\" stroke-width=\"3\" stroke-linejoin=\"round\" "
           "opacity=\"0.75\"/>\n";
  }
  for (const Eigen::Vector2d& turn : guide.turns) draw_turn(canvas, canvas.px(turn));
  canvas.goal(canvas.px(scenario.goal));
  canvas.start(canvas.px(scenario.start.position), scenario.start.yaw,
               std::max(0.35 * canvas.scale(), 7.0));
  label(canvas, canvas.px(scenario.start.position), "start");
  label(canvas, canvas.px(scenario.goal), "goal");
}

/// One such thing, drawn as in the map at a scale of its own.
void draw_swatch(MapCanvas& canvas, const WorldDescription& world, ThingClass thing_class,
                 const Eigen::Vector2d& p) {
  for (const Thing& thing : world.things) {
    if (thing.thing_class != thing_class) continue;
    if (thing_class == ThingClass::wall) break;  // long, or around a room
    const auto outlines = outlines_of(thing, world.floor_height);
    Eigen::AlignedBox2d bounds;
    for (const Outline& outline : outlines) bounds.extend(outline.local);
    const bool is_line =
        bounds.isEmpty() || bounds.sizes().minCoeff() < 0.15 * bounds.sizes().maxCoeff();
    if (is_line || outlines.front().rings.size() != 1 || outlines.front().hangs) break;
    const double scale = std::min(32.0 / bounds.sizes().x(), 18.0 / bounds.sizes().y());
    const double yaw = std::atan2(thing.pose.linear()(1, 0), thing.pose.linear()(0, 0));
    const Eigen::Vector2d place = canvas.px(thing.pose.translation().head<2>());
    const Eigen::Vector2d middle = bounds.center() * canvas.scale();
    canvas.svg() << "<g transform=\"translate(" << svg_number(p.x()) << ',' << svg_number(p.y())
                 << ") scale(" << svg_number(scale / canvas.scale()) << ") translate("
                 << svg_number(-middle.x()) << ',' << svg_number(middle.y()) << ") rotate("
                 << svg_number(navvi_types::degrees(yaw)) << ") translate("
                 << svg_number(-place.x()) << ',' << svg_number(-place.y()) << ")\">\n";
    for (const Outline& outline : outlines) canvas.outline(outline);
    canvas.svg() << "</g>\n";
    return;
  }
  canvas.svg() << "<rect x=\"" << svg_number(p.x() - 16.0) << "\" y=\"" << svg_number(p.y() - 8.0)
               << "\" width=\"32\" height=\"16\" fill=\"" << paint_of(thing_class).fill
               << "\" stroke=\"" << paint_of(thing_class).edge << "\"/>\n";
}

/// Doors of docks, and routes, where there are any. \return y, px, of the next line
double draw_other_legends(MapCanvas& canvas, const WorldDescription& world, double x, double y) {
  const auto any = [&](const auto& has) {
    return std::any_of(world.things.begin(), world.things.end(), has);
  };
  if (any([](const Thing& thing) {
        return thing.thing_class == ThingClass::wall && thing.shapes.size() == 1 &&
               thing.shapes.front().look == ThingClass::other;
      })) {
    const Paint paint = paint_of(ThingClass::other);
    canvas.svg() << "<rect x=\"" << svg_number(x) << "\" y=\"" << svg_number(y - 8.0)
                 << "\" width=\"32\" height=\"5\" fill=\"" << paint.fill << "\" stroke=\""
                 << paint.edge << "\"/>\n";
    canvas.text({x + 42.0, y}, 14.0, "dock door");
    y += kLegendLine;
  }
  if (any([](const Thing& thing) { return thing.route.has_value(); })) {
    canvas.svg() << "<path d=\"M" << svg_number(x) << ',' << svg_number(y - 5.0)
                 << "h32\" stroke=\"#8f4300\" stroke-width=\"2\" stroke-dasharray=\"6 4\"/>\n"
                 << "<path d=\"M" << svg_number(x + 16.0) << ',' << svg_number(y - 11.0)
                 << "l6,6l-6,6l-6,-6Z\" fill=\"#ffffff\" stroke=\"#8f4300\"/>\n";
    canvas.text({x + 42.0, y}, 14.0, "route, and a stop");
    y += kLegendLine;
  }
  return y + 0.2 * kLegendLine;
}

/// A bar of 1, 2 or 5 times a power of ten metres.
void draw_scale(MapCanvas& canvas, double x, double y) {
  double length = 1.0;
  const double most = std::max(1.0, canvas.area().sizes().x() / 4.0);
  for (const double next : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
    if (next <= most) length = next;
  const double width = length * canvas.scale();
  for (int part = 0; part < 4; ++part)
    canvas.svg() << "<rect x=\"" << svg_number(x + part * width / 4.0) << "\" y=\"" << svg_number(y)
                 << "\" width=\"" << svg_number(width / 4.0)
                 << "\" height=\"6\" stroke=\"#000000\" fill=\""
                 << (part % 2 == 0 ? "#000000" : "#ffffff") << "\"/>\n";
  canvas.text({x + width + 8.0, y + 9.0}, 14.0, svg_number(length) + " m");
  // North, as far as the map is concerned.
  const double north = x + canvas.area().sizes().x() * canvas.scale() - 20.0;
  canvas.svg() << "<path d=\"M" << svg_number(north) << ',' << svg_number(y + 14.0)
               << "l0,-26l-5,9m5,-9l5,9\" "
               << "fill=\"none\" stroke=\"#000000\" stroke-width=\"2\"/>\n";
  canvas.text({north + 10.0, y + 9.0}, 14.0, "y");
}

/// What the symbols and colours mean, with counts.
void draw_legend(MapCanvas& canvas, const WorldDescription& world, bool has_scenario, bool guided,
                 double x, double y) {
  std::map<ThingClass, std::pair<int, int>> counts;  // standing, moving
  for (const Thing& thing : world.things) {
    auto& [standing, moving] = counts[thing.thing_class];
    ++(thing.route ? moving : standing);
  }
  for (const auto& [thing_class, count] : counts) {
    if (thing_class == ThingClass::floor) continue;
    draw_swatch(canvas, world, thing_class, {x + 16.0, y - 6.0});
    std::string words = to_string(thing_class);
    std::replace(words.begin(), words.end(), '_', ' ');
    words += " (" + std::to_string(count.first + count.second);
    if (count.second > 0) words += ", " + std::to_string(count.second) + " moving";
    canvas.text({x + 42.0, y}, 14.0, words + ")");
    y += kLegendLine;
  }
  y = draw_other_legends(canvas, world, x, y + kLegendLine / 2.0);
  if (!has_scenario) return;
  canvas.start({x + 16.0, y - 5.0}, 0.0, 8.0);
  canvas.text({x + 42.0, y}, 14.0, "start of the robot");
  y += 1.2 * kLegendLine;
  canvas.goal({x + 16.0, y - 5.0});
  canvas.text({x + 42.0, y}, 14.0, "goal");
  y += 1.2 * kLegendLine;
  canvas.svg() << "<path d=\"M" << svg_number(x) << ',' << svg_number(y - 5.0)
               << "h32\" stroke=\"#9b00d3\" stroke-width=\"3\"/>\n";
  if (guided) draw_turn(canvas, {x + 16.0, y - 5.0});
  canvas.text({x + 42.0, y}, 14.0, guided ? "guide path, and a turn" : "a way with room");
}

/// What the map shows, for programs that draw over it: least x and y, greatest x and y, m.
std::string area_of(const Eigen::AlignedBox2d& bounds) {
  return svg_number(bounds.min().x()) + " " + svg_number(bounds.min().y()) + " " +
         svg_number(bounds.max().x()) + " " + svg_number(bounds.max().y());
}

}  // namespace

std::string world_picture(const WorldDescription& world,
                          const std::optional<scenario::StartAndGoal>& scenario,
                          const std::string& caption, const Guide& guide) {
  const Outlines outlines = all_outlines(world, scenario);
  const double scale =
      std::clamp(kLongSide / outlines.bounds.sizes().maxCoeff(), kMinScale, kMaxScale);
  MapCanvas canvas(outlines.bounds, {kFrame, kHead}, scale);
  const Eigen::Vector2d map = outlines.bounds.sizes() * scale;  // px
  const double width = 3.0 * kFrame + map.x() + kLegend;
  const double height = kHead + std::max(map.y(), 15.0 * kLegendLine) + kFrame + 50.0;
  canvas.svg() << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << svg_number(width)
               << "\" height=\"" << svg_number(height) << "\" viewBox=\"0 0 " << svg_number(width)
               << ' ' << svg_number(height) << "\" font-family=\"sans-serif\" data-area=\""
               << area_of(outlines.bounds) << "\">\n"
               << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  canvas.text({kFrame, 30.0}, 22.0, world.name);
  const std::string far = outlines.beyond == 0   ? ""
                          : outlines.beyond == 1 ? "; one thing lies beyond the picture"
                                                 : "; " + std::to_string(outlines.beyond) +
                                                       " things lie beyond the picture";
  canvas.text({kFrame, 52.0}, 14.0, caption + far);
  canvas.svg() << "<clipPath id=\"map\"><rect x=\"" << svg_number(kFrame) << "\" y=\""
               << svg_number(kHead) << "\" width=\"" << svg_number(map.x()) << "\" height=\""
               << svg_number(map.y()) << "\"/></clipPath>\n<g clip-path=\"url(#map)\">\n";
  for (const Outline& outline : outlines.standing) canvas.outline(outline);
  for (const Thing& thing : world.things)
    if (thing.route) draw_route(canvas, thing);
  for (const Outline& outline : outlines.moving) canvas.outline(outline);
  for (const Thing& thing : world.things)
    if (thing.route) draw_heading(canvas, thing);
  canvas.svg() << "</g>\n";
  if (scenario) draw_scenario(canvas, *scenario, guide);
  draw_scale(canvas, kFrame, kHead + map.y() + 30.0);
  draw_legend(canvas, world, scenario.has_value(), !guide.path.empty(), 2.0 * kFrame + map.x(),
              kHead + kLegendLine);
  canvas.svg() << "</svg>\n";
  return canvas.str();
}

}  // namespace navvi_sim::picture
