#include "navvi_feedback/nearby.hpp"

#include <array>
#include <cmath>

namespace navvi_feedback {
namespace {

constexpr std::array<const char*, 8> kNames = {"shelf",  "wall",     "box",          "pedestal",
                                               "worker", "forklift", "pallet_robot", "other"};

}  // namespace

const char* to_string(ThingClass thing_class) {
  return kNames.at(static_cast<std::size_t>(thing_class));
}

std::optional<ThingClass> thing_class_from(const std::string& word) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (word == kNames[i]) return static_cast<ThingClass>(i);
  return std::nullopt;
}

Side side_of(const Eigen::Vector2d& point) {
  if (std::abs(point.y()) > std::abs(point.x())) return point.y() > 0.0 ? Side::left : Side::right;
  return point.x() >= 0.0 ? Side::ahead : Side::behind;
}

}  // namespace navvi_feedback
