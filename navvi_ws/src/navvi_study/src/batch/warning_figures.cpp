#include "batch/warning_figures.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

namespace navvi_study::batch {
namespace {

constexpr std::array<std::string_view, 3> kMovers = {"worker", "forklift", "pallet_robot"};
constexpr double kFelt = 3.0;      // s before a contact
constexpr double kTold = 2.0;      // s
constexpr double kLongAgo = 10.0;  // s; a word before that was no warning

}  // namespace

void WarningFigures::feel(const navvi_msgs::Proximity& near, double time) {
  std::map<std::uint32_t, double> felt;
  for (const auto& thing : near.things)
    felt[thing.id] = felt_.count(thing.id) > 0 ? felt_[thing.id] : time;
  felt_ = felt;
}

void WarningFigures::hear(const navvi_types::CueEvent& cue, double time) {
  for (const std::string_view mover : kMovers) {
    std::string word(mover);
    const bool sound = cue.word().find(word) != std::string::npos;
    std::replace(word.begin(), word.end(), '_', ' ');
    if (sound || cue.text.find(word) != std::string::npos)
      named_[std::string(mover)].push_back(time);
  }
}

void WarningFigures::touch(const navvi_msgs::Contact& contact, double time) {
  const auto named = named_.find(contact.thing_class);
  if (std::find(kMovers.begin(), kMovers.end(), contact.thing_class) == kMovers.end()) return;
  double told = 0.0;
  if (named != named_.end())
    for (const double said : named->second)
      if (time - said < kLongAgo) told = std::max(told, time - said);
  const double felt = felt_.count(contact.id) > 0 ? time - felt_[contact.id] : 0.0;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%s%.1f/%.1f", warned_.empty() ? "" : " ", felt, told);
  warned_ += text.data();
  if (felt < kFelt || told < kTold) ++late_;
}

}  // namespace navvi_study::batch
