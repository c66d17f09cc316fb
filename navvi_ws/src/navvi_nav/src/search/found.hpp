#pragma once

#include <cstddef>

#include "geometry.hpp"

namespace navvi_nav::search {

struct Found {
  bool found = false;
  Path path;            ///< from start to goal; one point if they are the same
  double length = 0.0;  ///< m
  std::size_t nodes_expanded = 0;
};

}  // namespace navvi_nav::search
