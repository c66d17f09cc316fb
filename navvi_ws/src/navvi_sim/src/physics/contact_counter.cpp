#include "navvi_sim/physics/contact_counter.hpp"

#include <algorithm>

namespace navvi_sim::physics {

std::vector<ContactEvent> ContactCounter::update(const std::vector<Touch>& touches,
                                                 const std::vector<ThingClass>& classes,
                                                 double speed, double dt) {
  for (auto held = held_.begin(); held != held_.end();) {
    const bool near = std::any_of(touches.begin(), touches.end(), [&](const Touch& touch) {
      return touch.thing == held->first && touch.distance <= kApart;
    });
    held->second = near ? 0.0 : held->second + dt;
    held = held->second >= kApartFor ? held_.erase(held) : std::next(held);
  }
  std::vector<ContactEvent> begun;
  for (const Touch& touch : touches) {
    if (touch.distance > kTouching || !held_.emplace(touch.thing, 0.0).second) continue;
    ++counts_[classes[touch.thing]];
    begun.push_back({++seq_, touch.thing, touch.point, speed, counts_});
  }
  return begun;
}

}  // namespace navvi_sim::physics
