#include "look/vision.hpp"

namespace navvi_rviz::look {
namespace {

constexpr Color kWhite{1.00F, 1.00F, 1.00F};
constexpr Color kBlack{0.00F, 0.00F, 0.00F};
constexpr Color kYellow{1.00F, 0.93F, 0.10F};

Vision high_contrast() {
  Vision vision;
  vision.fill = {{"floor", {0.02F, 0.025F, 0.03F}},
                 {"floor line", {0.20F, 0.22F, 0.24F}},
                 {"shelf", {0.11F, 0.16F, 0.22F}},
                 {"wall", {0.15F, 0.15F, 0.15F}},
                 {"box", {0.19F, 0.16F, 0.00F}},
                 {"pedestal", {0.20F, 0.15F, 0.08F}},
                 {"other", {0.15F, 0.15F, 0.14F}},
                 {"robot", kWhite},
                 {"path", {0.82F, 0.45F, 1.00F}},
                 {"goal", {1.00F, 0.33F, 0.25F}},
                 {"turn", kBlack},
                 {"zone", kYellow},
                 {"zone line", {0.10F, 0.80F, 0.60F}}};
  vision.edge = {{"shelf", {0.33F, 0.41F, 0.51F}},
                 {"wall", {0.40F, 0.40F, 0.40F}},
                 {"box", kYellow},
                 {"pedestal", {1.00F, 0.84F, 0.66F}},
                 {"other", {0.88F, 0.88F, 0.84F}}};
  vision.bright = vision.text = kWhite;
  vision.dark = vision.plate = kBlack;
  return vision;
}

Vision yellow_on_black() {
  Vision vision = high_contrast();
  vision.fill["floor"] = kBlack;
  vision.fill["path"] = vision.fill["goal"] = kYellow;
  vision.edge["shelf"] = vision.edge["wall"] = {0.40F, 0.40F, 0.34F};
  for (const char* ns : {"shelf", "wall", "box", "pedestal", "other"})
    vision.fill[ns] = {0.15F, 0.15F, 0.13F};
  for (const char* ns : {"box", "pedestal", "other"}) vision.edge[ns] = {0.90F, 0.90F, 0.80F};
  vision.fill["zone"] = vision.fill["zone line"] = vision.edge["box"];
  vision.bright = vision.text = kYellow;
  return vision;
}

Vision large() {
  Vision vision = high_contrast();
  vision.width = 2.0;
  vision.text_height = 52.0;
  return vision;
}

/// Hues of Okabe and Ito (2008), which all kinds of colour vision tell apart.
Vision color_blind() {
  Vision vision = high_contrast();
  vision.fill["path"] = {0.45F, 0.78F, 1.00F};
  vision.fill["goal"] = {0.95F, 0.45F, 0.05F};
  vision.edge["pedestal"] = {1.00F, 0.82F, 0.92F};
  return vision;
}

const std::map<std::string, Vision>& visions() {
  static const std::map<std::string, Vision> visions{{"color_blind", color_blind()},
                                                     {"high_contrast", high_contrast()},
                                                     {"large", large()},
                                                     {"yellow_on_black", yellow_on_black()}};
  return visions;
}

}  // namespace

const Vision* find_vision(const std::string& name) {
  const auto found = visions().find(name);
  return found == visions().end() ? nullptr : &found->second;
}

std::vector<std::string> vision_names() {
  std::vector<std::string> names;
  for (const auto& entry : visions()) names.push_back(entry.first);
  return names;
}

}  // namespace navvi_rviz::look
