#include "read/sdf_notes.hpp"

#include <algorithm>

#include "description/sentence.hpp"
#include "read/sdf_own.hpp"

namespace navvi_sim::read {
namespace {

constexpr std::size_t kNamed = 3;          // of what is harmless, by kind; others are counted
constexpr std::size_t kNotesNamed = 10;    // of a note
constexpr std::size_t kFaultsNamed = 300;  // of what is wrong: all of it in nearly all worlds
constexpr const char* kAdvice =
    "With missing:=leave_out (sim/missing:=leave_out in a session) the world is read without ";
constexpr std::size_t kMost = 1'000;  // kinds, and names of one, that are kept

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
                                      "road",
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

/// A sentence, taken apart at its quotes.
struct Parts {
  std::string shown;  ///< with long names cut
  std::string kind;   ///< without names
  std::string name;   ///< the first, in its quotes
};

Parts parts_of(const std::string& sentence) {
  Parts parts;
  for (std::size_t at = 0; at < sentence.size();) {
    const char quote = sentence[at];
    const std::size_t end =
        quote == '\'' || quote == '"' ? sentence.find(quote, at + 1) : std::string::npos;
    if (end == std::string::npos) {
      parts.shown += quote;
      parts.kind += quote;
      ++at;
      continue;
    }
    const std::string quoted =
        quote + shortened(sentence.substr(at + 1, end - at - 1)) + std::string(1, quote);
    parts.shown += quoted;
    if (parts.name.empty()) parts.name = quoted;
    at = end + 1;
  }
  return parts;
}

}  // namespace

void SdfSentences::add(const std::string& place, const std::string& sentence) {
  ++count_;
  const Parts parts = parts_of(sentence);
  const std::string name = parts.name.empty() ? place : parts.name;
  const auto [known, is_new] = by_kind_.emplace(parts.kind, kinds_.size());
  if (is_new && kinds_.size() < kMost) {
    kinds_.push_back({place + ": " + parts.shown, 0, {name}, {}});
    return;
  }
  if (is_new) by_kind_.erase(known);
  Kind& kind = kinds_[is_new ? kinds_.size() - 1 : known->second];
  ++kind.more;
  if (kind.seen.size() < kMost && kind.seen.insert(name).second) kind.names.push_back(name);
}

std::vector<std::string> SdfSentences::lines(std::size_t most) const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    lines.push_back(kind.first);
    if (kind.more == 0) continue;
    lines.back() += " (and " + std::to_string(kind.more) + " more of the same kind";
    for (std::size_t i = 0; i < std::min(most, kind.names.size()); ++i)
      lines.back() += (i == 0 ? ": " : ", ") + kind.names[i];
    lines.back() += kind.names.size() > most ? ", ...)" : ")";
  }
  return lines;
}

void SdfNotes::piece(const std::string& whose, const std::function<void()>& read) {
  try {
    read();
  } catch (const PlaceError& error) {
    faults_.add(error.place, error.what_is_wrong + (whose.empty() ? "" : ", in '" + whose + "'"));
  }
}

void SdfNotes::refuse_faults() const {
  if (missing_ == Missing::leave_out || faults_.count() == 0) return;
  const std::vector<std::string> lines = faults_.lines(kFaultsNamed);
  if (faults_.count() == 1) throw WorldError(lines[0] + ". " + kAdvice + "it");
  std::string all;
  for (const std::string& line : lines) all += "\n  " + line;
  throw WorldError(std::to_string(faults_.count()) + " pieces of the world are missing or wrong. " +
                   kAdvice + "them" + all);
}

void SdfNotes::add_leftovers(const XmlElement& element) {
  for (const XmlElement& child : element.children) {
    if (kHarmless.count(child.name) > 0) {
      if (child.attribute("type") != "fixed") add_harmless(child);
    } else if (child.name == "plugin") {
      add_plugin(child, element);
    } else if (kUnderstood.count(child.name) == 0 && !is_own(child)) {
      add(child, "<" + child.name + "> is not known here, and is not taken over");
    }
  }
}

/// A world's own plugins are Gazebo's systems, such as its physics.
void SdfNotes::add_plugin(const XmlElement& plugin, const XmlElement& owner) {
  if (owner.name == "world") {
    add_harmless(plugin);
    return;
  }
  const std::string name = "'" + shortened(owner.attribute("name")) + "'";
  if (driven_.empty()) first_plugin_ = plugin.place();
  if (std::find(driven_.begin(), driven_.end(), name) == driven_.end() && driven_.size() < kMost)
    driven_.push_back(name);
}

std::string SdfNotes::driven() const {
  std::string line = first_plugin_ + ": what plugins move in Gazebo stands still here: ";
  for (std::size_t i = 0; i < std::min(kNotesNamed, driven_.size()); ++i)
    line += (i == 0 ? "" : ", ") + driven_[i];
  if (driven_.size() > kNotesNamed)
    line += " and " + std::to_string(driven_.size() - kNotesNamed) + " more";
  return line;
}

void SdfNotes::add_harmless(const XmlElement& element) {
  const std::string name = element.attribute("name");
  const std::string quoted = name.empty() ? "" : "'" + name + "', ";
  harmless_[element.name].push_back(quoted + "line " + std::to_string(element.line));
}

std::string SdfNotes::left_out() const {
  std::string all;
  for (const std::string& line : faults_.lines(kNotesNamed)) all += "\n  LEFT OUT: " + line;
  return all;
}

std::vector<std::string> SdfNotes::sentences() const {
  std::vector<std::string> result;
  for (const std::string& line : faults_.lines(kFaultsNamed)) result.push_back("LEFT OUT: " + line);
  for (std::string& line : notes_.lines(kNotesNamed)) result.push_back(std::move(line));
  if (!driven_.empty()) result.push_back(driven());
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
