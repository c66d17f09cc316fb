#pragma once

#include <vector>

#include "geometry.hpp"

namespace navvi_nav::mesh {

/// Spatial index: each thing is listed in the squares of a grid that its bounding
/// box touches. The cost of adding and removing it follows the size of the box alone.
class BoxGrid {
 public:
  BoxGrid() = default;
  /// \param low, high  m, of all boxes that will be added; a box beyond is listed at the border
  /// \param square  m, edge
  BoxGrid(Point low, Point high, double square)
      : low_(low),
        square_(square),
        columns_(1 + static_cast<int>((high.x - low.x) / square)),
        rows_(1 + static_cast<int>((high.y - low.y) / square)),
        squares_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(int thing, Point low, Point high) {
    each_square(low, high, [thing](std::vector<int>& square) { square.push_back(thing); });
  }
  /// The box must be the same as when it was added.
  void remove(int thing, Point low, Point high) {
    each_square(low, high, [thing](std::vector<int>& square) {
      const auto found = std::find(square.begin(), square.end(), thing);
      if (found == square.end()) return;
      *found = square.back();
      square.pop_back();
    });
  }
  /// Calls visit(thing) for all whose box may touch this one; for some more than once.
  template <typename Visit>
  void visit(Point low, Point high, Visit visit) const {
    if (squares_.empty()) return;
    const int x0 = column(low.x), x1 = column(high.x), y0 = row(low.y), y1 = row(high.y);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        for (const int thing : squares_[index(x, y)]) visit(thing);
      }
    }
  }
  [[nodiscard]] double square() const { return square_; }  ///< m

 private:
  [[nodiscard]] int column(double x) const { return number((x - low_.x) / square_, columns_); }
  [[nodiscard]] int row(double y) const { return number((y - low_.y) / square_, rows_); }
  [[nodiscard]] static int number(double at, int count) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }
  template <typename Change>
  void each_square(Point low, Point high, Change change) {
    const int x0 = column(low.x), x1 = column(high.x), y0 = row(low.y), y1 = row(high.y);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) change(squares_[index(x, y)]);
    }
  }

  Point low_;
  double square_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::vector<int>> squares_;
};

}  // namespace navvi_nav::mesh
