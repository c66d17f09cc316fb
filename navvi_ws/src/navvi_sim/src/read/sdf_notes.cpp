#include "read/sdf_notes.hpp"

#include <algorithm>
#include <set>

#include "read/sdf_own.hpp"

namespace navvi_sim::read {
namespace {

constexpr std::size_t kNamed = 3;  // of a kind, the others are counted

/// Of a <world>, a <model> and a <link>: what means nothing to a driver.
const std::set<std::string> kHarmless{"animation",
                                      "atmosphere",
                                      "audio",
                                      "audio_sink",
                                      "audio_source",
                                      "battery",
                                      "gripper",
                                      "gui",
                                      "joint",
                                      "light",
                                      "magnetic_field",
                                      "material",
                                      "particle_emitter",
                                      "physics",
                                      "projector",
                                      "scene",
                                      "sensor",
                                      "skin",
                                      "spherical_coordinates",
                                      "wind"};
/// What is read, and what says no more than how a body moves when it is pushed.
const std::set<std::string> kUnderstood{"actor",
                                        "allow_auto_disable",
                                        "collision",
                                        "enable_wind",
                                        "frame",
                                        "gravity",
                                        "inertial",
                                        "kinematic",
                                        "link",
                                        "model",
                                        "must_be_base_link",
                                        "pose",
                                        "script",
                                        "self_collide",
                                        "state",
                                        "static",
                                        "velocity_decay",
                                        "visual"};

}  // namespace

void SdfNotes::add_leftovers(const XmlElement& element) {
  for (const XmlElement& child : element.children) {
    const bool is_plugin = child.name == "plugin";
    if (kHarmless.count(child.name) > 0) {
      if (child.attribute("type") != "fixed") add_harmless(child);
    } else if (is_plugin && element.name == "world") {
      add_plugin(child, "");
    } else if (!is_plugin && kUnderstood.count(child.name) == 0 && !is_own(child)) {
      add(child, "<" + child.name + "> is not known here, and is not taken over");
    }
  }
}

void SdfNotes::add_plugin(const XmlElement& plugin, const std::string& whose) {
  add(plugin, "the plugin '" + plugin.attribute("name") + "' (" + plugin.attribute("filename") +
                  ") " + whose + "is not run");
}

void SdfNotes::add_harmless(const XmlElement& element) {
  const std::string name = element.attribute("name");
  const std::string quoted = name.empty() ? "" : "'" + name + "', ";
  harmless_[element.name].push_back(quoted + "line " + std::to_string(element.line));
}

std::vector<std::string> SdfNotes::sentences() const {
  std::vector<std::string> result = sentences_;
  if (harmless_.empty()) return result;
  std::string all;
  for (const auto& [kind, places] : harmless_) {
    all += (all.empty() ? "" : "; ") + std::to_string(places.size()) + " <" + kind + "> (";
    for (std::size_t i = 0; i < std::min(kNamed, places.size()); ++i)
      all += (i == 0 ? "" : "; ") + places[i];
    all += places.size() > kNamed ? "; ...)" : ")";
  }
  result.push_back("without meaning here, and left out: " + all);
  return result;
}

}  // namespace navvi_sim::read
