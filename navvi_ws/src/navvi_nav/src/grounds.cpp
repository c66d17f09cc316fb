#include "navvi_nav/grounds.hpp"

namespace navvi_nav {

int Grounds::add(const ExactPolygon& shape) {
  int number = static_cast<int>(grounds_.size());
  if (free_.empty()) {
    grounds_.emplace_back();
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

void Grounds::remove(int number) {
  const ExactPolygon& shape = (*this)[number].shape;
  grid_.remove(number, step_ * shape.low, step_ * shape.high);
  (*this)[number] = {};
  free_.push_back(number);
}

void Grounds::touch(int number) {
  Mark& mark = marks_[static_cast<std::size_t>(number)];
  if (mark == Mark::touched) return;
  mark = Mark::touched;
  touched_.push_back(number);
}

void Grounds::find_borders() {
  for (const int ground : touched_) {
    for (const Ground::Neighbour& next : (*this)[ground].neighbours) add_border(next.ground);
  }
}

void Grounds::find_borders(const ExactPolygon& shape) {
  visit(shape, [this](int ground) { add_border(ground); });
}

void Grounds::add_border(int number) {
  Mark& mark = marks_[static_cast<std::size_t>(number)];
  if (mark != Mark::none) return;
  mark = Mark::border;
  borders_.push_back(number);
}

void Grounds::settle() {
  for (const int ground : touched_) marks_[static_cast<std::size_t>(ground)] = Mark::none;
  for (const int ground : borders_) marks_[static_cast<std::size_t>(ground)] = Mark::none;
  touched_.clear();
  borders_.clear();
}

}  // namespace navvi_nav
