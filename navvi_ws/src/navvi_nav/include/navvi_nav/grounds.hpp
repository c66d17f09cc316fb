#pragma once

#include <cstddef>
#include <vector>

#include "navvi_nav/box_grid.hpp"
#include "navvi_nav/exact_polygon.hpp"

namespace navvi_nav {

/// The polygons of a floor by number and by place, and which of them a change is about: those that
/// it touches, to be cut anew, and the others on their borders, to be linked anew.
class Grounds {
 public:
  /// A polygon of the floor.
  struct Ground {
    struct Neighbour {
      int ground = 0;
      int edge = 0;  ///< number of our edge that it touches
    };
    ExactPolygon shape;  ///< without edges: an empty slot
    std::vector<Neighbour> neighbours;
    std::vector<int> holes;   ///< that reach into it
    std::vector<int> pieces;  ///< its polygons in the mesh
  };

  Grounds() = default;
  /// \param low, high  m, of the floor at first \param square  m, of the grid \param step  m, of
  /// the shapes' numbers
  Grounds(Point low, Point high, double square, double step)
      : grid_(low, high, square), step_(step) {}

  /// Adds one that is touched. \returns its number, the next one or that of an empty slot
  int add(const ExactPolygon& shape);
  void remove(int number);
  [[nodiscard]] Ground& operator[](int number) {
    return grounds_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] std::size_t size() const { return grounds_.size(); }  ///< with empty slots
  /// Calls visit(number) for all that the shape may touch; for some more than once.
  template <typename Visit>
  void visit(const ExactPolygon& shape, Visit visit) const {
    grid_.visit(step_ * shape.low, step_ * shape.high, visit);
  }

  void touch(int number);
  void find_borders();                           ///< neighbours of those touched
  void find_borders(const ExactPolygon& shape);  ///< those that the shape may touch
  [[nodiscard]] bool is_touched(int number) const {
    return marks_[static_cast<std::size_t>(number)] == Mark::touched;
  }
  [[nodiscard]] const std::vector<int>& touched() const { return touched_; }
  [[nodiscard]] const std::vector<int>& borders() const { return borders_; }
  /// The change is done.
  void settle();

 private:
  enum class Mark : char { none, touched, border };
  void add_border(int number);

  BoxGrid grid_;
  double step_ = 1.0;
  std::vector<Ground> grounds_;
  std::vector<int> free_;
  std::vector<Mark> marks_;
  std::vector<int> touched_;
  std::vector<int> borders_;
};

}  // namespace navvi_nav
