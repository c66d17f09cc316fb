#include "physics/contact_counter.hpp"

#include <algorithm>

namespace navvi_sim::physics {

std::vector<navvi_types::Contact> ContactCounter::update(
    const std::vector<Touch>& touches, const std::vector<navvi_types::ThingClass>& classes,
    double speed, double dt) {
  for (auto held = held_.begin(); held != held_.end();) {
    const bool near = std::any_of(touches.begin(), touches.end(), [&](const Touch& touch) {
      return touch.thing == held->first && touch.distance <= kApart;
    });
    held->second = near ? 0.0 : held->second + dt;
    held = held->second >= kApartFor ? held_.erase(held) : std::next(held);
  }
  std::vector<navvi_types::Contact> begun;
  for (const Touch& touch : touches) {
    if (touch.distance > kTouching || !held_.emplace(touch.thing, 0.0).second) continue;
    ++counts_[classes[touch.thing]];
    navvi_types::Contact& contact = begun.emplace_back();
    contact.thing_class = classes[touch.thing];
    contact.point = touch.point.head<2>();
    contact.id = static_cast<std::uint32_t>(touch.thing);
    contact.height = touch.point.z();
    contact.speed = speed;
    contact.counts = counts_;
    contact.seq = ++seq_;
  }
  return begun;
}

}  // namespace navvi_sim::physics
