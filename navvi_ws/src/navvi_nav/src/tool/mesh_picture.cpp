#include "tool/mesh_picture.hpp"

#include <cstdio>
#include <utility>

namespace navvi_nav::tool {
namespace {

constexpr double kScale = 20.0;  // units a metre
constexpr double kFrame = 0.5;   // m around the map

/// Writes places of the map as places of the picture.
class Canvas {
 public:
  explicit Canvas(const map::Floor& floor)
      : low_{floor.origin().x * floor.cell_size() - kFrame,
             floor.origin().y * floor.cell_size() - kFrame},
        high_{(floor.origin().x + floor.columns()) * floor.cell_size() + kFrame,
              (floor.origin().y + floor.rows()) * floor.cell_size() + kFrame} {
    const double width = kScale * (high_.x - low_.x), height = kScale * (high_.y - low_.y);
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
  [[nodiscard]] std::string finish() {
    out_ += "</svg>\n";
    return std::move(out_);
  }

 private:
  Point low_, high_;
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
  static constexpr const char* kShades[] = {"#3fd0e0", "#7fe0a0", "#a0b8ff", "#e0d070", "#ffb0d0"};
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
      "stroke=\"#8a00d4\" stroke-width=\"5\" points=\"");
  for (const Point point : path) canvas.place(point);
  canvas.add("\"/>\n");
}

void draw_dot(Canvas& canvas, Point at, double radius, const char* style) {
  canvas.add("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" %s/>\n", canvas.x(at), canvas.y(at),
             radius, style);
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
  for (const Point point : what.path)
    draw_dot(canvas, point, 4.5, "fill=\"#ffffff\" stroke=\"#8a00d4\" stroke-width=\"2.5\"");
  if (!what.path.empty()) {
    draw_dot(canvas, what.path.front(), 7.0,
             "fill=\"#1fa340\" stroke=\"#ffffff\" stroke-width=\"2\"");
    draw_dot(canvas, what.path.back(), 7.0,
             "fill=\"#e01020\" stroke=\"#ffffff\" stroke-width=\"2\"");
  }
  return canvas.finish();
}

}  // namespace navvi_nav::tool
