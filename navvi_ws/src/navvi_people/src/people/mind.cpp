#include "navvi_people/people/mind.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_people::people {

bool Memory::keeps(double speed, double time) {
  constexpr double kUsualSpeed = 0.8;  // of the stick
  const double free = std::clamp((time - told_) / config_.kSpan, 0.0, 1.0);
  const double quick = speed / kUsualSpeed;
  const bool lost = random_.chance(config_.lost * (1.0 - free) * quick * quick);
  if (config_.faults && lost) return false;
  told_ = time;
  return true;
}

void Attention::update(bool moves, double time, double dt) {
  constexpr double kSecondsAMinute = 60.0;
  const bool wanders = random_.chance(config_.distractions * dt / kSecondsAMinute);
  if (!config_.faults) return;
  if (wanders) elsewhere_until_ = time + config_.distracted;
  if (moves) stands_.reset();
  if (!moves && !stands_) stands_ = time;
  if (stands_ && time - *stands_ > config_.gives_up) gave_up_ = true;
}

void LearningConfig::describe(navvi_config::Visitor& visit) {
  visit(on, "on", navvi_config::Any{}, "", "false: every route is the first");
  visit(routes, "routes", navvi_config::Range{1, 1000}, "", "driven, this one too");
}

double Learning::factor() const {
  return config_.on ? std::pow(static_cast<double>(config_.routes), -config_.rate) : 1.0;
}

void Learning::turned(double angle, double rest) {
  constexpr double kMostBias = 0.35;     // rad
  constexpr double kMostResidual = 0.7;  // rad; more is another turn, not the rest of one
  if (!config_.on || std::abs(rest) > kMostResidual) return;
  bias_ =
      std::clamp(bias_ + config_.kBiasRate * (angle > 0.0 ? rest : -rest), -kMostBias, kMostBias);
}

}  // namespace navvi_people::people
