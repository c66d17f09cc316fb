#include "navvi_sim/model_class.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace navvi_sim {
namespace {

/// In order: the first word that occurs decides. "pallet jack" and the like stand before "pallet".
constexpr std::array<std::pair<const char*, ThingClass>, 30> kRules{{
    {"forklift", ThingClass::forklift},
    {"fork_lift", ThingClass::forklift},
    {"palletjack", ThingClass::other},
    {"pallet_jack", ThingClass::other},
    {"palletrobot", ThingClass::pallet_robot},
    {"pallet_robot", ThingClass::pallet_robot},
    {"shelf", ThingClass::shelf},
    {"shelves", ThingClass::shelf},
    {"bookcase", ThingClass::shelf},
    {"bracket", ThingClass::other},
    {"track", ThingClass::other},
    {"rack", ThingClass::shelf},
    {"wall", ThingClass::wall},
    {"fence", ThingClass::wall},
    {"pillar", ThingClass::wall},
    {"column", ThingClass::wall},
    {"ground", ThingClass::floor},
    {"floor", ThingClass::floor},
    {"person", ThingClass::worker},
    {"worker", ThingClass::worker},
    {"human", ThingClass::worker},
    {"pedestrian", ThingClass::worker},
    {"pedestal", ThingClass::pedestal},
    {"pallet", ThingClass::pedestal},
    {"box", ThingClass::box},
    {"crate", ThingClass::box},
    {"carton", ThingClass::box},
    {"clutter", ThingClass::box},
    {"package", ThingClass::box},
    {"parcel", ThingClass::box},
}};

}  // namespace

ThingClass class_of_model(const std::string& model_name) {
  std::string name = model_name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [word, thing_class] : kRules)
    if (name.find(word) != std::string::npos) return thing_class;
  return ThingClass::other;
}

}  // namespace navvi_sim
