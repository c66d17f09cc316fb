#include "haptics/haptics.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "navvi_config/reader.hpp"

namespace navvi_feedback::haptics {
namespace {

/// Of a change of a motor's force: what every driver can tell from none, so that a change begins
/// with the message that asks for it, however soon that comes after the last one.
constexpr double kStep = 2.0 / 255.0;

/// A motor command that the motor can follow: nothing, or at least its starting threshold.
double motor(double force, double start, double gain) {
  if (force <= 0.0) return 0.0;
  return std::min(1.0, start + (gain - start) * force);
}

double slewed(double value, double wanted, double limit) {
  return value + std::clamp(wanted - value, -limit, limit);
}

}  // namespace

void HapticsConfig::describe(navvi_config::Visitor& visit) {
  using namespace navvi_config;
  visit(enabled, "enabled", Any{}, "", "false: the motors stay off");
  visit(near, "near", Any{}, "", "false: only patterns are felt, such as that of a hit");
  visit(strength, "strength", Range{0.1, 1.0}, "", "share of their force that the motors have");
  visit(range, "range", Range{0.5, 20.0}, "m", "a thing is felt if its gap is less than this");
  visit(center, "center", Range{0.0, 5.0}, "m",
        "a thing whose nearest point lies less far to the side is felt in both motors");
  visit(curve, "curve", OneOf{{"log", "linear", "power"}}, "", "force over distance");
  visit(rear, "rear", Range{0.0, 1.0}, "",
        "how much of its force a thing right behind the robot has; beside it, half way to all");
  visit(duck, "duck", Range{0.0, 1.0}, "",
        "how much of the force is left while a safety phrase is spoken (R-AUD-6)");
  visit(rest_at_goal, "rest_at_goal", Any{}, "", "near things are not felt after the arrival");
  visit(patterns, "patterns", Any{}, "",
        "hits, stops, a stuck robot, new routes and the arrival are felt, each by its own pattern");
  visit(instead_of_words, "instead_of_words", Any{}, "",
        "while there should be sound and is none, the motors lead as by feedback/lead:=hand, and "
        "alarms are felt");
  visit(normalize, "normalize", Any{}, "",
        "log curve: divide by ln 2, so that touching gives full force");
  visit(classes, "classes",
        OneOf{{"shelf", "wall", "box", "pedestal", "worker", "forklift", "pallet_robot", "other"}},
        "", "the classes of things that are felt");
  visit(onset, "onset", Range{0.0, 5.0}, "s", "from nothing to the full force; 0: at once");
  visit(slew, "slew", Range{0.0, 1000.0}, "1/s", "largest change of a motor's force; 0: no limit");
  visit(range_hysteresis, "range_hysteresis", Range{0.0, 1.0}, "m",
        "a thing must come this much nearer than range to be felt first");
  visit(zone_hysteresis, "zone_hysteresis", Range{0.0, 1.0}, "m",
        "a thing must be this far across the border between two zones to change zone");
  visit(start_left, "start_left", Range{0.0, 0.5}, "", "least command that turns the left motor");
  visit(start_right, "start_right", Range{0.0, 0.5}, "",
        "least command that turns the right motor");
  visit(gain_left, "gain_left", Range{0.0, 1.0}, "", "left motor's command at full force");
  visit(gain_right, "gain_right", Range{0.0, 1.0}, "", "right motor's command at full force");
  visit(pads, "pads", Any{}, "",
        "pads by their identifier, each with the person's start_left, start_right and gain of both "
        "motors, such as \"0300-1 0.05 0.07 0.9\"; ./navvi calibrate finds them");
}

double rumble_force(const HapticsConfig& config, double gap) {
  if (!std::isfinite(gap)) return 0.0;
  const double nearness = 1.0 - std::max(gap, 0.0) / config.range;
  if (nearness <= 0.0) return 0.0;
  if (config.curve == "linear") return nearness;
  if (config.curve == "power") return std::pow(nearness, config.exponent);
  return std::log1p(nearness) / (config.normalize ? std::log(2.0) : 1.0);
}

Haptics::Haptics(const HapticsConfig& config) : config_(config) {
  for (const std::string& word : config.classes) {
    const auto thing_class = navvi_types::from_word<ThingClass>(word);
    if (!thing_class || thing_class == ThingClass::floor)
      throw navvi_config::ConfigError("haptics/classes: \"" + word +
                                      "\" is not a class of things; allowed are shelf, wall, box, "
                                      "pedestal, worker, forklift, pallet_robot and other");
    classes_.push_back(*thing_class);
  }
  for (const std::string& pad : config.pads) {
    std::istringstream words(pad);
    std::string name;
    std::string more;
    Motors motors;
    const bool read =
        words >> name >> motors.start_left >> motors.start_right >> motors.gain_left &&
        !(words >> more);
    const auto within = [](double value, double most) { return value >= 0.0 && value <= most; };
    if (!read || !within(motors.start_left, 0.5) || !within(motors.start_right, 0.5) ||
        !within(motors.gain_left, 1.0))
      throw navvi_config::ConfigError("haptics/pads: \"" + pad +
                                      "\" is not a pad with its start_left and start_right, 0 to "
                                      "0.5, and gain, 0 to 1.");
    motors.gain_right = motors.gain_left;
    pads_[name] = motors;
  }
  use_pad("");
}

void Haptics::use_pad(const std::string& pad) {
  pad_ = pad;
  const auto found = pads_.find(pad);
  motors_ = found != pads_.end() ? found->second
                                 : Motors{config_.start_left, config_.start_right,
                                          config_.gain_left, config_.gain_right};
}

std::optional<Haptics::Felt> Haptics::strongest(const std::vector<NearThing>& things) const {
  const double limit = zone_ ? config_.range : config_.range - config_.range_hysteresis;
  std::optional<Felt> best;
  for (const NearThing& thing : things) {
    if (std::find(classes_.begin(), classes_.end(), thing.thing_class) == classes_.end()) continue;
    if (!std::isfinite(thing.gap) || !thing.nearest.allFinite() || thing.gap >= limit) continue;
    const double distance = thing.nearest.norm();
    const double ahead = distance > 0.0 ? 0.5 * (1.0 + thing.nearest.x() / distance) : 1.0;
    const double force =
        (config_.rear + (1.0 - config_.rear) * ahead) * rumble_force(config_, thing.gap);
    if (!best || force > best->force) best = Felt{thing.nearest.y(), force};
  }
  return best;
}

Zone Haptics::zone_of(double lateral) const {
  // A thing leaves its zone only some way behind the border.
  const double bias = zone_ ? config_.zone_hysteresis : 0.0;
  const double to_left = config_.center + (zone_ == Zone::left ? -bias : bias);
  const double to_right = config_.center + (zone_ == Zone::right ? -bias : bias);
  if (lateral > to_left) return Zone::left;
  if (lateral < -to_right) return Zone::right;
  return Zone::center;
}

void Haptics::stop() {
  zone_.reset();
  felt_for_ = 0.0;
  force_ = {};
}

Rumble Haptics::update(const std::vector<NearThing>& things, bool fresh, double dt) {
  if (!fresh || !config_.enabled || !config_.near) {
    stop();
    return {};
  }
  double wanted_left = 0.0;
  double wanted_right = 0.0;
  if (const auto felt = strongest(things)) {
    felt_for_ += dt;
    zone_ = zone_of(felt->lateral);
    const double ramp =
        config_.onset > 0.0 ? std::clamp(felt_for_ / config_.onset, kStep, 1.0) : 1.0;
    const double force = ramp * felt->force;
    if (*zone_ != Zone::right) wanted_left = force;
    if (*zone_ != Zone::left) wanted_right = force;
  } else {
    zone_.reset();
    felt_for_ = 0.0;
  }
  if (config_.slew > 0.0) {
    const double limit = std::max(kStep, config_.slew * dt);
    force_.left = slewed(force_.left, wanted_left, limit);
    force_.right = slewed(force_.right, wanted_right, limit);
  } else {
    force_ = {wanted_left, wanted_right};
  }
  return {motor(config_.strength * force_.left, motors_.start_left, motors_.gain_left),
          motor(config_.strength * force_.right, motors_.start_right, motors_.gain_right)};
}

}  // namespace navvi_feedback::haptics
