#include "read/sdf_own.hpp"

#include <algorithm>
#include <initializer_list>

#include "description/sentence.hpp"
#include "description/validate.hpp"
#include "read/sdf_value.hpp"

namespace navvi_sim::read {
namespace {

/// An attribute as if it were an element, so that what is wrong with it is said in the same way.
XmlElement as_element(const XmlElement& owner, const std::string& key) {
  const std::string value = owner.attribute(key);
  if (value.empty())
    refuse(owner, "<" + owner.name + "> has no attribute " + key + "; it needs one");
  return {key, value, {}, {}, owner.file, owner.line};
}

bool truth(const XmlElement& owner, const std::string& key) {
  XmlElement holder = owner;
  holder.children = {as_element(owner, key)};
  return flag(holder, key, true);
}

void check_attributes(const XmlElement& element, std::initializer_list<const char*> known) {
  for (const auto& [key, value] : element.attributes)
    if (std::find(known.begin(), known.end(), key) == known.end())
      refuse(element, "<" + element.name + "> has the attribute " + key + ", which is not known");
}

}  // namespace

bool is_own(const XmlElement& element) { return element.name.rfind("navvi:", 0) == 0; }

std::optional<ThingClass> own_class(const XmlElement& element, const std::string& name) {
  const XmlElement* word = element.child("navvi:" + name);
  if (word == nullptr) return std::nullopt;
  const auto thing_class = navvi_types::from_word<ThingClass>(word->text);
  if (!thing_class)
    refuse(*word,
           "'" + word->text.substr(0, 40) + "' is not a class; allowed are " + thing_class_words());
  return thing_class;
}

std::optional<Route> own_route(const XmlElement& model) {
  const XmlElement* element = model.child("navvi:route");
  if (element == nullptr) return std::nullopt;
  check_attributes(*element, {"speed", "loop", "delay", "yields"});
  Route route;
  route.speed = number(as_element(*element, "speed"));
  route.loop = truth(*element, "loop");
  route.delay = number(as_element(*element, "delay"));
  route.yields = truth(*element, "yields");
  const auto waypoints = element->children_named("navvi:waypoint");
  if (waypoints.size() < 2 || waypoints.size() > WorldLimits::waypoints)
    refuse(*element, "<navvi:route> has " + std::to_string(waypoints.size()) +
                         " way-points; allowed are 2 to " + std::to_string(WorldLimits::waypoints));
  for (const XmlElement* one : waypoints) {
    check_attributes(*one, {"pause", "speed"});
    const std::vector<double> at = numbers(*one, 2);
    route.waypoints.push_back(
        {{at[0], at[1]}, number(as_element(*one, "pause")), number(as_element(*one, "speed"))});
  }
  return route;
}

}  // namespace navvi_sim::read
