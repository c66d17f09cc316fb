#include "tool/mesh_picture.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace navvi_nav::tool {
namespace {

constexpr double kScale = 20.0;  // units a metre
constexpr double kFrame = 0.5;   // m around the map
constexpr double kLegend = 14;   // lines of text, its width
constexpr const char* kShades[] = {"#3fd0e0", "#7fe0a0", "#a0b8ff", "#e0d070", "#ffb0d0"};
constexpr const char* kPath = "#8a00d4";
constexpr const char* kStart = "#1fa340";
constexpr const char* kGoal = "#e01020";

/// Writes places of the map as places of the picture.
class Canvas {
 public:
  explicit Canvas(const map::Floor& floor)
      : low_{floor.origin().x * floor.cell_size() - kFrame,
             floor.origin().y * floor.cell_size() - kFrame},
        high_{(floor.origin().x + floor.columns()) * floor.cell_size() + kFrame,
              (floor.origin().y + floor.rows()) * floor.cell_size() + kFrame} {
    const double map_height = kScale * (high_.y - low_.y);
    right_ = kScale * (high_.x - low_.x);
    line_ = std::max(16.0, std::max(right_, map_height) / 60.0);
    const double width = right_ + kLegend * line_, height = std::max(map_height, 12.0 * line_);
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" "
        "height=\"%.0f\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#8a8f98\"/>\n",
        width, height, width, height);
  }

  template <typename... Values>
  void add(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    out_ += text;
  }
  void add(const char* text) { out_ += text; }
  void place(Point at) { add("%.2f,%.2f ", x(at), y(at)); }
  [[nodiscard]] double x(Point at) const { return kScale * (at.x - low_.x); }
  [[nodiscard]] double y(Point at) const { return kScale * (high_.y - at.y); }
  [[nodiscard]] double right() const { return right_; }  ///< of the map
  [[nodiscard]] double line() const { return line_; }    ///< height of a line of text
  void text(double at_x, double at_y, const char* words) {
    add("<text x=\"%.1f\" y=\"%.1f\" font-size=\"%.1f\" font-family=\"sans-serif\">%s</text>\n",
        at_x, at_y, 0.8 * line_, words);
  }
  [[nodiscard]] std::string finish() {
    out_ += "</svg>\n";
    return std::move(out_);
  }

 private:
  Point low_, high_;
  double right_ = 0.0;
  double line_ = 0.0;
  std::string out_;
};

/// Runs of cells of one kind, a rectangle each.
void draw_ground(Canvas& canvas, const map::Floor& floor, map::Ground kind, const char* colour) {
  const double cell = floor.cell_size();
  canvas.add("<path fill=\"%s\" d=\"", colour);
  for (int y = floor.origin().y; y < floor.origin().y + floor.rows(); ++y) {
    const int end = floor.origin().x + floor.columns();
    for (int x = floor.origin().x; x < end; ++x) {
      const int from = x;
      while (x < end && floor.ground({x, y}) == kind) ++x;
      if (x > from)
        canvas.add("M%.2f %.2fh%.2fv%.2fh%.2fz", canvas.x({from * cell, 0}),
                   canvas.y({0, (y + 1) * cell}), kScale * cell * (x - from), kScale * cell,
                   -kScale * cell * (x - from));
    }
  }
  canvas.add("\"/>\n");
}

void draw_mesh(Canvas& canvas, const mesh::Mesh& mesh) {
  canvas.add("<g stroke=\"#05606b\" stroke-width=\"0.7\" stroke-linejoin=\"round\">\n");
  for (const mesh::Polygon& polygon : mesh.polygons) {
    if (polygon.corners.empty()) continue;
    canvas.add("<polygon fill=\"%s\" points=\"", kShades[polygon.component % 5]);
    for (const int corner : polygon.corners) canvas.place(mesh.at(corner));
    canvas.add("\"/>\n");
  }
  canvas.add("</g>\n");
}

void draw_path(Canvas& canvas, const Path& path) {
  canvas.add(
      "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" "
      "stroke=\"#8a00d4\" stroke-width=\"%.1f\" points=\"",
      0.31 * canvas.line());
  for (const Point point : path) canvas.place(point);
  canvas.add("\"/>\n");
}

void draw_dot(Canvas& canvas, Point at, double radius, const char* style) {
  canvas.add("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" %s/>\n", canvas.x(at), canvas.y(at),
             radius, style);
}

/// What the colours mean, a bar to measure by, and where x and y are 0.
void draw_legend(Canvas& canvas, const PictureOf& what) {
  const double line = canvas.line(), x = canvas.right() + 0.5 * line;
  double y = 0.5 * line;
  const auto entry = [&](const char* colour, const char* words) {
    canvas.add("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", x, y,
               line, 0.8 * line, colour);
    canvas.text(x + 1.3 * line, y + 0.75 * line, words);
    y += 1.2 * line;
  };
  entry("#f2f2ee", "floor");
  entry("#30343a", "obstacle");
  if (what.mesh != nullptr) entry(kShades[0], "mesh, its parts in shades");
  if (!what.cylinders.empty()) entry("#ff9a3c", "moving thing");
  if (!what.path.empty()) {
    entry(kPath, "guide path");
    entry(kStart, "start");
    entry(kGoal, "goal");
  }
  double metres = 1.0;
  for (const double longer : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
    if (kScale * longer <= 0.7 * kLegend * line) metres = longer;
  char words[16];
  std::snprintf(words, sizeof words, "%.0f m", metres);
  canvas.add("<path d=\"M%.1f %.1fv%.1fh%.1fv%.1f\" fill=\"none\" stroke=\"#000000\"/>\n", x, y,
             0.4 * line, kScale * metres, -0.4 * line);
  canvas.text(x, y + 1.3 * line, words);
  const Point origin{canvas.x({0, 0}), canvas.y({0, 0})};
  canvas.add("<path d=\"M%.1f %.1fh%.1fm%.1f %.1fv%.1f\" stroke=\"#000000\" stroke-width=\"2\"/>\n",
             origin.x, origin.y, line, -line, 0.0, -line);
  canvas.text(origin.x + 0.3 * line, origin.y - 0.3 * line, "0, 0");
}

}  // namespace

std::string svg_of(const PictureOf& what) {
  Canvas canvas(*what.floor);
  draw_ground(canvas, *what.floor, map::Ground::floor, "#f2f2ee");
  draw_ground(canvas, *what.floor, map::Ground::obstacle, "#30343a");
  if (what.mesh != nullptr) draw_mesh(canvas, *what.mesh);
  for (const Cylinder& cylinder : what.cylinders)
    draw_dot(canvas, cylinder.center, kScale * cylinder.radius,
             "fill=\"#ff9a3c\" stroke=\"#7a3d00\" stroke-width=\"1\"");
  if (!what.path.empty()) draw_path(canvas, what.path);
  for (const Point point : what.turns)
    draw_dot(canvas, point, 0.28 * canvas.line(),
             "fill=\"#ffffff\" stroke=\"#8a00d4\" stroke-width=\"2.5\"");
  if (!what.path.empty()) {
    draw_dot(canvas, what.path.front(), 0.44 * canvas.line(),
             "fill=\"#1fa340\" stroke=\"#ffffff\" stroke-width=\"2\"");
    draw_dot(canvas, what.path.back(), 0.44 * canvas.line(),
             "fill=\"#e01020\" stroke=\"#ffffff\" stroke-width=\"2\"");
  }
  draw_legend(canvas, what);
  return canvas.finish();
}

}  // namespace navvi_nav::tool
