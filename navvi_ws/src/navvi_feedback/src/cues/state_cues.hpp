#pragma once

#include <optional>

#include "cues/cue_config.hpp"
#include "cues/phrases.hpp"
#include "cues/phrasing.hpp"
#include "cues/tick.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Why the guidance does not lead anywhere; nullopt if it does.
[[nodiscard]] std::optional<Content> problem_of(const Guidance& guidance);

/// That, with the thing that is in the way.
[[nodiscard]] Utterance problem_words(const Content& problem, const Observation& now);

/// Tells why the guidance does not lead, or what a trial waits for, once that has lasted, and again
/// while it lasts; and that a trial begins.
class StateCues {
 public:
  explicit StateCues(const CuePolicyConfig& config) : config_(config) {}

  /// \param halted  s, when the person was told to stop, and waits since; nullopt: they do not wait
  /// \param phrasing  knows what was said too short a time ago
  [[nodiscard]] Utterances update(const Tick& tick, std::optional<double> halted,
                                  const Phrasing& phrasing);
  /// These words were not heard: if they are true still, they are said again a little later.
  void lost(const Content& content, double time);

  /// As of the last update. \return nullopt: the guidance leads, or nothing is known of it
  [[nodiscard]] std::optional<Content> problem() const { return problem_; }
  /// There is nowhere to drive to.
  [[nodiscard]] bool goal_gone() const;

 private:
  [[nodiscard]] std::optional<Content> judge(const Tick& tick) const;
  void observe(const Tick& tick);
  [[nodiscard]] bool due(const Tick& tick, std::optional<double> halted) const;
  [[nodiscard]] double hold(const Tick& tick, std::optional<double> halted) const;

  CuePolicyConfig config_;
  bool awaited_ = false;                            ///< a trial waits for the person
  std::optional<Content> problem_;                  ///< why the guidance does not lead
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();  ///< m, in map, when that began
  double since_ = 0.0;                              ///< s
  std::optional<double> said_;                      ///< s
  std::optional<double> lost_;                      ///< s, when that was dropped unheard
  bool arrival_said_ = false;                       ///< since there was a path to follow
  bool led_ = false;                                ///< there was one
};

}  // namespace navvi_feedback::cues
