#include <array>
#include <utility>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {
namespace {

constexpr std::array<std::pair<ThingClass, const char*>, 9> kNames{{
    {ThingClass::floor, "floor"},
    {ThingClass::shelf, "shelf"},
    {ThingClass::wall, "wall"},
    {ThingClass::box, "box"},
    {ThingClass::pedestal, "pedestal"},
    {ThingClass::worker, "worker"},
    {ThingClass::forklift, "forklift"},
    {ThingClass::pallet_robot, "pallet_robot"},
    {ThingClass::other, "other"},
}};

}  // namespace

const char* to_string(ThingClass thing_class) {
  for (const auto& [value, name] : kNames)
    if (value == thing_class) return name;
  return "other";
}

std::optional<ThingClass> thing_class_from(const std::string& word) {
  for (const auto& [value, name] : kNames)
    if (word == name) return value;
  return std::nullopt;
}

std::string thing_class_words() {
  std::string words;
  for (const auto& [value, name] : kNames) words += (words.empty() ? "" : ", ") + std::string(name);
  return words;
}

}  // namespace navvi_sim
