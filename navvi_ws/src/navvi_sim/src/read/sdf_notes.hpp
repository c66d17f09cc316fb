#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "navvi_sim/read/loaded_world.hpp"
#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// Sentences, each with its place. Of those that differ in what stands in quotes only, the first is
/// said and the others are named.
class SdfSentences {
 public:
  void add(const std::string& place, const std::string& sentence);
  /// \param most  names in a sentence; others are counted
  [[nodiscard]] std::vector<std::string> lines(std::size_t most) const;
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  struct Kind {
    std::string first;
    std::size_t more = 0;
    std::set<std::string> seen;
    std::vector<std::string> names;  ///< of those after the first, once each
  };

  std::vector<Kind> kinds_;
  std::map<std::string, std::size_t> by_kind_;
  std::size_t count_ = 0;
};

/// What is wrong with an SDF world, and what it holds that is not taken over as it is.
class SdfNotes {
 public:
  explicit SdfNotes(Missing missing) : missing_(missing) {}

  /// Something that a person may miss, with the place.
  void add(const XmlElement& at, const std::string& sentence) { add(at.place(), sentence); }
  void add(const std::string& place, const std::string& sentence) { notes_.add(place, sentence); }
  /// Something that changes nothing here, such as a light: named in one sentence for all.
  void add_harmless(const XmlElement& element);

  /// What a <world>, <model>, <actor> or <link> holds beside what is read of it: harmless or not.
  void add_leftovers(const XmlElement& element);

  /// Reads one piece of the world, and goes on where that throws a PlaceError.
  /// \param whose  the model that it belongs to; may be empty
  void piece(const std::string& whose, const std::function<void()>& read);
  /// \throws WorldError that says what is wrong with all pieces, unless these may be left out
  void refuse_faults() const;

  [[nodiscard]] std::vector<std::string> sentences() const;
  /// Of an error that may come of it: what was left out, a line each; empty if nothing was.
  [[nodiscard]] std::string left_out() const;

 private:
  void add_plugin(const XmlElement& plugin, const XmlElement& owner);
  [[nodiscard]] std::string driven() const;

  Missing missing_;
  SdfSentences faults_;
  SdfSentences notes_;
  std::map<std::string, std::vector<std::string>> harmless_;  ///< names and lines by kind
  std::vector<std::string> driven_;  ///< models, actors and links with plugins
  std::string first_plugin_;         ///< its place
};

}  // namespace navvi_sim::read
