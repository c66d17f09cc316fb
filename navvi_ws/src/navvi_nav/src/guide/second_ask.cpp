#include "guide/second_ask.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kSameGoal = 0.5;  // m

bool same(Point a, Point b) { return distance(a, b) <= kSameGoal; }

}  // namespace

bool SecondAsk::agrees(Point goal, double stamp) {
  if (agreed_ && stamp == agreed_->stamp && same(goal, agreed_->place)) return true;
  if (!refused_ || !(stamp > refused_->stamp)) return false;
  const bool again = same(goal, refused_->place);
  refused_.reset();
  if (again) agreed_ = {goal, stamp};
  return again;
}

void SecondAsk::refused(Point goal, Guidance::Refusal why, double heard) {
  if (agreed_ && same(goal, agreed_->place)) agreed_.reset();
  if (why == Guidance::Refusal::not_seen || why == Guidance::Refusal::off_the_map)
    refused_ = {goal, heard};
}

void SecondAsk::reset() {
  refused_.reset();
  agreed_.reset();
}

}  // namespace navvi_nav::guide
