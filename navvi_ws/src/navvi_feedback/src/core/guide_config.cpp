#include "core/guide_config.hpp"

namespace navvi_feedback::core {

GuideConfig::GuideConfig() : values_(std::make_unique<Values>()) {}
GuideConfig::GuideConfig(const GuideConfig& other)
    : values_(std::make_unique<Values>(*other.values_)) {}
GuideConfig& GuideConfig::operator=(const GuideConfig& other) {
  *values_ = *other.values_;
  return *this;
}
GuideConfig::~GuideConfig() = default;

void GuideConfig::describe(navvi_config::Visitor& visit) {
  visit(values_->lead, "lead", navvi_config::OneOf{{"words", "ticks", "flow", "hand"}}, "",
        "what leads along the way: words; ticks that count turns down, and words; flow, a sound "
        "that lasts, its side where to steer, its pitch how fast; hand, pulses of the motors, "
        "likewise, without any sound");
  visit.group("link", values_->link);
  visit.group("drive", values_->drive);
  visit.group("buttons", values_->buttons);
  visit.group("haptics", values_->haptics);
  visit.group("sounds", values_->sounds);
  visit.group("cues", values_->cues);
}

bool GuideConfig::has_sounds() const { return values_->sounds.enabled; }

std::string GuideConfig::lead(bool audible) const {
  const haptics::HapticsConfig& touch = values_->haptics;
  return !audible && touch.enabled && touch.instead_of_words ? "hand" : values_->lead;
}

}  // namespace navvi_feedback::core
