#include "mesh/base_polygons.hpp"

namespace navvi_nav::mesh {

int BasePolygons::add(const ExactPolygon& shape) {
  int number = static_cast<int>(bases_.size());
  if (free_.empty()) {
    bases_.emplace_back();
    marks_.push_back(Mark::none);
  } else {
    number = free_.back();
    free_.pop_back();
  }
  grid_.add(number, step_ * shape.low, step_ * shape.high);
  (*this)[number].shape = shape;
  touch(number);
  return number;
}

void BasePolygons::remove(int number) {
  const ExactPolygon& shape = (*this)[number].shape;
  grid_.remove(number, step_ * shape.low, step_ * shape.high);
  (*this)[number] = {};
  free_.push_back(number);
}

void BasePolygons::touch(int number) {
  Mark& mark = marks_[static_cast<std::size_t>(number)];
  if (mark == Mark::touched) return;
  mark = Mark::touched;
  touched_.push_back(number);
}

void BasePolygons::find_borders() {
  for (const int base : touched_) {
    for (const BasePolygon::Neighbour& next : (*this)[base].neighbours) add_border(next.base);
  }
}

void BasePolygons::find_borders(const ExactPolygon& shape) {
  visit(shape, [this](int base) { add_border(base); });
}

void BasePolygons::add_border(int number) {
  Mark& mark = marks_[static_cast<std::size_t>(number)];
  if (mark != Mark::none) return;
  mark = Mark::border;
  borders_.push_back(number);
}

void BasePolygons::settle() {
  for (const int base : touched_) marks_[static_cast<std::size_t>(base)] = Mark::none;
  for (const int base : borders_) marks_[static_cast<std::size_t>(base)] = Mark::none;
  touched_.clear();
  borders_.clear();
}

}  // namespace navvi_nav::mesh
