#pragma once

#include <Eigen/Geometry>
#include <sstream>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "picture/outline.hpp"

namespace navvi_sim::picture {

struct Paint {
  const char* fill;
  const char* edge;
};

/// Hues as in the scene in RViz, on a light ground.
[[nodiscard]] Paint paint_of(ThingClass thing_class);

/// A number as SVG takes it, to 0.01.
[[nodiscard]] std::string svg_number(double value);

/// A map drawn as SVG: lines and symbols at places in map (m), text and legend at places on the
/// page (px, y down).
class MapCanvas {
 public:
  /// \param area    m, in map, what is shown
  /// \param corner  px, its upper left corner on the page
  /// \param scale   px a metre
  MapCanvas(const Eigen::AlignedBox2d& area, const Eigen::Vector2d& corner, double scale)
      : area_(area), corner_(corner), scale_(scale) {}

  [[nodiscard]] const Eigen::AlignedBox2d& area() const { return area_; }
  [[nodiscard]] double scale() const { return scale_; }
  /// The page's place of a point in map.
  [[nodiscard]] Eigen::Vector2d px(const Eigen::Vector2d& p) const;
  /// The data of a path through points in map.
  [[nodiscard]] std::string path(const std::vector<Eigen::Vector2d>& points, bool closed) const;

  /// SVG as it is.
  std::ostream& svg() { return out_; }
  [[nodiscard]] std::string str() const { return out_.str(); }

  /// \param size  px
  /// \param more  further attributes
  void text(const Eigen::Vector2d& page, double size, const std::string& text,
            const std::string& more = "");
  /// \param width  m
  void line(const std::vector<Eigen::Vector2d>& points, const char* color, double width,
            const std::string& more = "");
  void outline(const Outline& outline);
  /// \param yaw   rad
  /// \param size  px
  void start(const Eigen::Vector2d& page, double yaw, double size);
  void goal(const Eigen::Vector2d& page);

 private:
  /// px; thin lines of large halls are not thicker than what they bound.
  [[nodiscard]] double stroke(double metres) const;

  Eigen::AlignedBox2d area_;
  Eigen::Vector2d corner_;
  double scale_;
  std::ostringstream out_;
};

}  // namespace navvi_sim::picture
