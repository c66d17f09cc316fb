#pragma once

#include <optional>
#include <string>
#include <vector>

#include "haptics/haptics.hpp"
#include "lessons/lesson.hpp"
#include "lessons/teller.hpp"
#include "sounds/sounds_config.hpp"

namespace navvi_feedback::lessons {

/// Every signal that there is, one after another: its meaning in words, then the signal itself.
/// Next and previous go on and back, repeat gives it again, end ends it.
class Glossary : public Lesson {
 public:
  /// \throws navvi_config::ConfigError if the phrases lack the meaning of a signal
  Glossary(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons,
           const haptics::HapticsConfig& haptics, const sounds::SoundsConfig& sounds);

  [[nodiscard]] Taught update(const Observation& seen, double time) override;
  [[nodiscard]] bool over() const override { return over_; }

  /// The keys of all texts.
  [[nodiscard]] static std::vector<std::string> texts();

 private:
  /// One of these is set.
  struct Entry {
    std::string text;  ///< key of its meaning
    std::optional<haptics::Pattern> pattern = {};
    std::optional<sounds::Earcon> earcon = {};
    std::optional<cues::Side> near = {};  ///< what is felt of a thing there
    std::optional<CueKind> words = {};    ///< a phrase
    int hour = 0;                         ///< of that phrase
    bool by_hand = false;                 ///< pulses that lead
  };
  [[nodiscard]] static std::vector<Entry> all();
  [[nodiscard]] bool given(const Entry& entry, const Observation& seen) const;
  void go(int steps, const Observation& seen);
  void begin();
  void give(const Entry& entry, double since, Taught& taught);
  void beat(const Entry& entry, Taught& taught);

  haptics::HapticsConfig haptics_;
  sounds::SoundsConfig sounds_;
  bool clock_;  ///< directions are hours
  std::vector<Entry> entries_;
  Teller teller_;
  std::size_t at_ = 0;
  bool welcomed_ = false;
  bool over_ = false;
  bool leaving_ = false;
  bool reminded_ = false;
  std::optional<double> given_;  ///< s, when the signal itself began
  int beats_ = 0;                ///< of it so far
};

}  // namespace navvi_feedback::lessons
