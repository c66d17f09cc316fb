#include "navvi_types/thing.hpp"

#include <cmath>

namespace navvi_types {
namespace {

constexpr double kSticksOut = 1e-3;  // m, by which a rectangle may stick out of its cylinder

}  // namespace

bool MovingThing::sound() const {
  if (length == 0.0 && width == 0.0) return true;
  return length > 0.0 && width > 0.0 && std::hypot(length, width) / 2.0 <= radius + kSticksOut;
}

}  // namespace navvi_types
