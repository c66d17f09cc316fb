#include "picture/map_canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace navvi_sim::picture {
namespace {

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

}  // namespace

Paint paint_of(ThingClass thing_class) {
  static constexpr std::array<Paint, names(ThingClass{}).size()> kPaints{{
      {"#f4f3ee", "#d8d6cc"},  // floor
      {"#7d9bbd", "#34506f"},  // shelf
      {"#4a4a4a", "#2b2b2b"},  // wall
      {"#f2cf3b", "#8a7000"},  // box
      {"#c08a55", "#6e4315"},  // pedestal
      {"#27b04b", "#0c5a20"},  // worker
      {"#ff8a1f", "#8f4300"},  // forklift
      {"#17b3b3", "#005f5f"},  // pallet robot
      {"#d3c8aa", "#6b6350"},  // other
  }};
  return kPaints[static_cast<std::size_t>(thing_class)];
}

std::string svg_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  std::string result(text);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result == "-0" ? "0" : result;
}

Eigen::Vector2d MapCanvas::px(const Eigen::Vector2d& p) const {
  return {corner_.x() + (p.x() - area_.min().x()) * scale_,
          corner_.y() + (area_.max().y() - p.y()) * scale_};
}

std::string MapCanvas::path(const std::vector<Eigen::Vector2d>& points, bool closed) const {
  std::string path;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d at = px(point);
    path += (path.empty() ? "M" : "L") + svg_number(at.x()) + "," + svg_number(at.y());
  }
  return path + (closed ? "Z" : "");
}

double MapCanvas::stroke(double metres) const { return std::clamp(metres * scale_, 0.4, 2.0); }

void MapCanvas::text(const Eigen::Vector2d& page, double size, const std::string& text,
                     const std::string& more) {
  out_ << "<text x=\"" << svg_number(page.x()) << "\" y=\"" << svg_number(page.y())
       << "\" font-size=\"" << svg_number(size) << "\" " << more << ">" << escaped(text)
       << "</text>\n";
}

void MapCanvas::outline(const Outline& outline) {
  const Paint paint = paint_of(outline.look);
  std::string path;
  for (const auto& ring : outline.rings) path += this->path(ring, true);
  if (outline.hangs) {
    out_ << "<path d=\"" << path << "\" fill=\"none\" stroke=\"" << paint.edge
         << "\" stroke-width=\"" << svg_number(stroke(0.04)) << "\" stroke-dasharray=\"4 4\"/>\n";
    return;
  }
  const bool one = outline.rings.size() == 1;
  out_ << "<path d=\"" << path << "\" fill=\"" << paint.fill << '"';
  if (one)
    out_ << " stroke=\"" << paint.edge << "\" stroke-width=\"" << svg_number(stroke(0.04)) << '"';
  out_ << "/>\n";
  std::string solid;
  for (const auto& ring : outline.solid) solid += this->path(ring, true);
  if (!solid.empty())
    out_ << "<path d=\"" << solid << "\" fill=\"" << paint.fill << "\" stroke=\"" << paint.edge
         << "\" stroke-width=\"" << svg_number(stroke(0.04)) << "\" fill-rule=\"evenodd\"/>\n";
  std::string lines;
  for (const auto& points : outline.lines) lines += this->path(points, false);
  if (!lines.empty())
    out_ << "<path d=\"" << lines << "\" fill=\"none\" stroke=\"" << paint.edge
         << "\" stroke-width=\"" << svg_number(stroke(0.08)) << "\"/>\n";
  if (!outline.is_box) return;
  const auto& ring = outline.rings.front();
  if (outline.look == ThingClass::box) {  // taped
    line({(ring[0] + ring[3]) / 2.0, (ring[1] + ring[2]) / 2.0}, paint.edge, 0.05);
  } else if (outline.look == ThingClass::pedestal) {  // slats
    for (const double share : {0.25, 0.5, 0.75})
      line({ring[0] + share * (ring[1] - ring[0]), ring[3] + share * (ring[2] - ring[3])},
           paint.edge, 0.05);
  } else if (outline.look == ThingClass::other) {  // a door's leaves
    line({(ring[0] + ring[1]) / 2.0, (ring[2] + ring[3]) / 2.0}, paint.edge, 0.05);
  }
}

void MapCanvas::line(const std::vector<Eigen::Vector2d>& points, const char* color, double width,
                     const std::string& more) {
  out_ << "<path d=\"" << path(points, false) << "\" fill=\"none\" stroke=\"" << color
       << "\" stroke-width=\"" << svg_number(stroke(width)) << "\" " << more << "/>\n";
}

void MapCanvas::start(const Eigen::Vector2d& page, double yaw, double size) {
  out_ << "<g transform=\"translate(" << svg_number(page.x()) << ',' << svg_number(page.y())
       << ") rotate(" << svg_number(navvi_types::degrees(-yaw)) << ") scale(" << svg_number(size)
       << ")\"><circle r=\"1\" fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"0.2\"/>"
       << "<path d=\"M1.5,0L-0.5,0.75L-0.5,-0.75Z\" fill=\"#9b00d3\"/></g>\n";
}

void MapCanvas::goal(const Eigen::Vector2d& page) {
  out_ << "<g transform=\"translate(" << svg_number(page.x()) << ',' << svg_number(page.y())
       << ")\"><circle r=\"11\" fill=\"#ffffff\" stroke=\"#d00000\" stroke-width=\"3\"/>"
       << "<circle r=\"5\" fill=\"#d00000\"/></g>\n";
}

}  // namespace navvi_sim::picture
