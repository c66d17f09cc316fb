#pragma once

#include <cstddef>
#include <vector>

#include "mesh/box_grid.hpp"
#include "mesh/exact_polygon.hpp"

namespace navvi_nav::mesh {

/// A polygon of the floor without holes.
struct BasePolygon {
  struct Neighbour {
    int base = 0;
    int edge = 0;  ///< number of our edge that it touches
  };
  ExactPolygon shape;  ///< without edges: an empty slot
  std::vector<Neighbour> neighbours;
  std::vector<int> holes;   ///< that reach into it
  std::vector<int> pieces;  ///< its polygons in the mesh
  int component = 0;        ///< of the floor without holes
};

/// The polygons of a floor by number and by place, and those that a change concerns: the touched
/// ones are cut again, and their neighbours, the borders, get new portals.
class BasePolygons {
 public:
  BasePolygons() = default;
  /// \param low, high  m, of the first floor \param square  m, of the grid \param step  m, of the
  /// shapes' lattice
  BasePolygons(Point low, Point high, double square, double step)
      : grid_(low, high, square), step_(step) {}

  /// Adds a touched polygon. \returns its number, the next one or that of an empty slot
  int add(const ExactPolygon& shape);
  void remove(int number);
  [[nodiscard]] BasePolygon& operator[](int number) {
    return bases_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] const BasePolygon& operator[](int number) const {
    return bases_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] std::size_t size() const { return bases_.size(); }  ///< with empty slots
  /// Calls visit(number) for all that the shape may touch; for some more than once.
  template <typename Visit>
  void visit(const ExactPolygon& shape, Visit visit) const {
    this->visit(step_ * shape.low, step_ * shape.high, visit);
  }

  /// Calls visit(number) for all that may touch the box, m; for some more than once.
  template <typename Visit>
  void visit(Point low, Point high, Visit visit) const {
    grid_.visit(low, high, visit);
  }

  void touch(int number);
  void find_borders();                           ///< neighbours of those touched
  void find_borders(const ExactPolygon& shape);  ///< those that the shape may touch
  [[nodiscard]] bool is_touched(int number) const {
    return marks_[static_cast<std::size_t>(number)] == Mark::touched;
  }
  [[nodiscard]] const std::vector<int>& touched() const { return touched_; }
  [[nodiscard]] const std::vector<int>& borders() const { return borders_; }
  /// Ends the change: nothing is touched.
  void settle();

 private:
  enum class Mark : char { none, touched, border };
  void add_border(int number);

  BoxGrid grid_;
  double step_ = 1.0;
  std::vector<BasePolygon> bases_;
  std::vector<int> free_;
  std::vector<Mark> marks_;
  std::vector<int> touched_;
  std::vector<int> borders_;
};

}  // namespace navvi_nav::mesh
