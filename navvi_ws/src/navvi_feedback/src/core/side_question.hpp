#pragma once

#include <optional>

namespace navvi_feedback::core {

/// Asks once, before a trial, which side a sound comes from: headphones may be the wrong way round,
/// and an ear deaf. The words are CueKind::which_side; after them a sound comes again and again
/// from one side until the stick goes aside, the trial begins, or 12 s have passed.
class SideQuestion {
 public:
  /// Call it at 50 Hz.
  /// \param may  the person can be asked now
  /// \param quiet  nothing is spoken
  /// \param aside  of the stick, [-1, 1], positive to the left
  /// \param time  s, of a clock that does not run backwards
  /// \return whether the answer is right, once
  [[nodiscard]] std::optional<bool> update(bool may, bool quiet, double aside, double time);
  /// The words were heard to their end.
  void told() { told_ = true; }
  [[nodiscard]] bool asks() const { return asks_; }
  /// The sound is due now, from there: 1 left, -1 right.
  [[nodiscard]] std::optional<double> sounds() const { return sounds_; }

 private:
  [[nodiscard]] std::optional<bool> end(std::optional<bool> right);

  bool asks_ = false;
  bool told_ = false;
  bool over_ = false;
  bool neutral_ = false;  ///< the stick was, since the first sound
  double side_ = 0.0;     ///< as sounds(); 0: there was none yet
  double since_ = 0.0;    ///< s, of the first sound
  double last_ = 0.0;     ///< s
  std::optional<double> sounds_;
};

}  // namespace navvi_feedback::core
