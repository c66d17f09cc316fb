#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lessons/lesson.hpp"
#include "lessons/teller.hpp"
#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::lessons {

/// A direction that the person points in with the stick: pushed out and held steady.
class Pointing {
 public:
  struct Direction {
    int degrees;    ///< counter-clockwise from straight ahead, left positive, (-180, 180]
    double pushed;  ///< s, when the stick was pushed out for it
  };

  /// \param time  s, of a clock that does not run backwards
  /// \return once a push, when it was held within 10 degrees for 0.5 s; nothing of a stick that was
  /// pushed before the first update, until it was at rest
  [[nodiscard]] std::optional<Direction> update(const drive::Stick& stick, double time);

 private:
  std::optional<double> pushed_;  ///< s, nullopt: the stick is at rest
  double angle_ = 0.0;            ///< rad, from which it may stray
  double since_ = 0.0;            ///< s, when it came to that angle
  bool taken_ = true;             ///< nothing more is taken until it is at rest
};

struct Question {
  std::string name;                 ///< in the record: letters, digits, - and _
  std::string ask;                  ///< sentences
  std::vector<std::string> values;  ///< in the record, from least to most
  std::vector<std::string> spoken;  ///< the same, as they are said
  bool point = false;               ///< instead of values: answered by pointing with the stick
};

/// \param path  YAML: items, each with name, ask, values and spoken; or name, ask and point: true
/// \throws navvi_config::ConfigError that names the file, the key and what is allowed
[[nodiscard]] std::vector<Question> read_questions(const std::filesystem::path& path);

/// Asks by voice and takes answers by stick and buttons: up for more, down for less, a button to
/// answer, one to go back and correct, one to hear it again, one for who would rather not say.
/// Nothing is chosen beforehand. A question of a direction is answered by pointing with the stick.
class Questionnaire : public Lesson {
 public:
  /// The answer of who would rather not say.
  static constexpr const char* kDeclined = "declined";

  /// \throws navvi_config::ConfigError if the phrases lack a text
  Questionnaire(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons,
                std::vector<Question> questions);

  [[nodiscard]] Taught update(const Observation& seen, double time) override;
  [[nodiscard]] bool over() const override { return over_; }
  /// item,answer,seconds: s from the question's beginning to its last answer. Of pointing,
  /// answer: whole degrees, counter-clockwise from straight ahead (left positive), (-180, 180];
  /// seconds: from the end of the spoken question to the push of the stick that led to the answer,
  /// 0 if pushed before. Who declines: kDeclined, and seconds as of other questions.
  [[nodiscard]] std::string record() const override;

  /// The keys of all texts.
  [[nodiscard]] static std::vector<std::string> texts();

 private:
  struct Answer {
    std::optional<std::size_t> chosen;  ///< of the question's values
    std::string given;                  ///< empty: not answered yet
    double seconds = 0.0;
    std::optional<int> degrees = {};  ///< pointed at
    double reaction = 0.0;            ///< s, of pointing
  };

  void obey(drive::Button button);
  void lean(const drive::Stick& stick);
  void point(const drive::Stick& stick);
  void tell_pointed(bool at_once);
  void confirm();
  void change(bool more);
  void give(const std::string& answer);
  void go_to(std::size_t question);
  void tell();
  [[nodiscard]] bool all_asked() const { return at_ == questions_.size(); }

  std::vector<Question> questions_;
  std::vector<Answer> answers_;
  Teller teller_;
  std::size_t at_ = 0;           ///< the question; their number: all are asked
  double time_ = 0.0;            ///< s, of the last update
  double asked_ = 0.0;           ///< s, when the question came
  std::optional<double> heard_;  ///< s, when the question had been spoken
  Pointing pointing_;
  double leaned_ = 0.0;  ///< s, when the stick last counted as a press
  bool leans_ = false;
  bool begun_ = false;
  bool finished_ = false;
  bool over_ = false;
};

}  // namespace navvi_feedback::lessons
