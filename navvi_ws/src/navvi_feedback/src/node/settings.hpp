#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/menu/places_file.hpp"
#include "navvi_feedback/core/guide.hpp"
#include "node/node_config.hpp"
#include "person/person_file.hpp"
#include "person/saver.hpp"
#include "types.hpp"

namespace navvi_feedback::node {

/// What a person sets while driving, and what a lesson finds for them: in force at once, kept in
/// their file, and written where the node is started anew. And the places that they remember, which
/// the file of places keeps.
class Settings {
 public:
  /// \param config  outlives this
  explicit Settings(NodeConfig& config);

  /// The values of all parameters that the menu may offer.
  [[nodiscard]] std::map<std::string, std::string> values() const;
  /// A person has a file, whose settings are in force.
  [[nodiscard]] bool loaded() const { return file_.has_value(); }
  /// False once the file could not take what a lesson found.
  [[nodiscard]] bool saved() const { return saved_; }

  /// \param word  such as "speaker/rate:=240"
  void change(const std::string& word);
  /// A place to be remembered. A lesson's results: its table goes to the parameter `record`, its
  /// settings to the file.
  void keep(const core::Output& told);

  /// To be called often; does not wait. \return cues that say what has failed, which is logged
  [[nodiscard]] std::vector<Content> failures();
  /// Waits until all is saved. \return likewise
  [[nodiscard]] std::vector<Content> finish();

 private:
  std::vector<Content> cues_of(const std::vector<std::vector<person::Failure>>& all);

  NodeConfig& config_;
  std::optional<person::PersonFile> file_;
  person::Saver<std::string> saver_, master_;  ///< to the file; for this node, if it starts anew
  person::Saver<menu::NamedPlace> places_;
  std::string recorded_;            ///< of the lesson, as it is in the file
  std::vector<std::string> found_;  ///< by the lesson
  bool saved_ = true;
};

}  // namespace navvi_feedback::node
