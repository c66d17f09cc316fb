#include "lessons/questionnaire.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <navvi_files/printable.hpp>
#include <regex>

#include "cues/clock_face.hpp"
#include "navvi_config/reader.hpp"

namespace navvi_feedback::lessons {
namespace {

constexpr double kPushed = 0.6;                  // of the stick
constexpr double kRest = 0.3;                    // it is at rest again
constexpr double kStray = 10.0 * cues::kDegree;  // rad
constexpr double kHeld = 0.5;                    // s
constexpr double kSlack = 1e-9;                  // s, of rounding

using drive::Button;
using navvi_config::ConfigError;

constexpr double kEvery = 0.7;    // s, between two steps while it is held

std::string key(const char* name) { return std::string("ask_") + name; }

void check_spoken(const std::string& text, const std::string& where) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(". ", begin), text.size());
    const std::string sentence = text.substr(begin, end - begin);
    if (!cues::speakable(sentence))
      throw ConfigError(where + " cannot be spoken: \"" + sentence +
                        "\"; allowed are letters, digits, space , . ' - and 80 bytes a sentence.");
    begin = end + 2;
  }
}

void check_values(const Question& question, const std::regex& plain, const std::string& where) {
  if (question.point) {
    if (question.values.empty() && question.spoken.empty()) return;
    throw ConfigError(where + " has point beside values or spoken; allowed is one or the other.");
  }
  if (question.values.empty() || question.values.size() != question.spoken.size())
    throw ConfigError(where + " has " + std::to_string(question.values.size()) + " values and " +
                      std::to_string(question.spoken.size()) +
                      " spoken; allowed is one that is spoken for each value, or point: true.");
  for (const std::string& value : question.values)
    if (!std::regex_match(value, plain))
      throw ConfigError(where + "/values holds \"" + value +
                        "\"; allowed are words of letters, digits, . - and _.");
}

Question read_question(const YAML::Node& item, const std::string& where) {
  using navvi_config::Any;
  Question question;
  const auto describe = [&](navvi_config::Visitor& visit) {
    visit(question.name, "name", Any{}, "", "in the record");
    visit(question.ask, "ask", Any{}, "", "sentences");
    visit(question.values, "values", Any{}, "", "in the record, from least to most");
    visit(question.spoken, "spoken", Any{}, "", "the same, as they are said");
    visit(question.point, "point", Any{}, "", "true: answered by pointing");
  };
  navvi_config::read_fields(describe, item, where);
  static const std::regex plain("[A-Za-z0-9_.-]{1,40}( [A-Za-z0-9_.-]{1,40}){0,9}");
  if (!std::regex_match(question.name, plain))
    throw ConfigError(where + "/name is \"" + question.name +
                      "\"; allowed are letters, digits, . - and _.");
  check_values(question, plain, where);
  check_spoken(question.ask, where + "/ask");
  for (const std::string& text : question.spoken) check_spoken(text, where + "/spoken");
  return question;
}

}  // namespace

std::optional<Pointing::Direction> Pointing::update(const drive::Stick& stick, double time) {
  const double out = std::hypot(stick.x, stick.y);
  if (out < kRest) {
    pushed_.reset();
    taken_ = false;
  }
  if (out < kPushed) {
    since_ = time;
    return std::nullopt;
  }
  const double angle = std::atan2(stick.x, stick.y);
  const bool first = !pushed_;
  if (first) pushed_ = time;
  if (first || std::abs(std::remainder(angle - angle_, 2.0 * M_PI)) > kStray) {
    angle_ = angle;
    since_ = time;
  }
  if (taken_ || time - since_ < kHeld - kSlack) return std::nullopt;
  taken_ = true;
  const int degrees = static_cast<int>(std::lround(angle / cues::kDegree));
  return Direction{degrees == -180 ? 180 : degrees, *pushed_};
}

std::vector<Question> read_questions(const std::filesystem::path& path) {
  const YAML::Node root = navvi_config::load_yaml(path);
  const YAML::Node items = root.IsMap() ? root["items"] : YAML::Node();
  if (!items.IsDefined() || !items.IsSequence() || items.size() == 0 || root.size() != 1)
    throw ConfigError(path.string() + ": allowed is the key items alone, a list of questions.");
  std::vector<Question> questions;
  for (std::size_t i = 0; i < items.size(); ++i)
    questions.push_back(
        read_question(items[i], path.string() + ": items[" + std::to_string(i) + "]"));
  return questions;
}

std::vector<std::string> Questionnaire::texts() {
  std::vector<std::string> keys;
  for (const char* name : {"welcome", "read", "chosen", "choose_first", "pointed", "point_first",
                           "declined", "last", "end"})
    keys.push_back(key(name));
  return keys;
}

Questionnaire::Questionnaire(const cues::Phrases& phrases, const drive::ButtonsConfig& buttons,
                             std::vector<Question> questions)
    : questions_(std::move(questions)),
      answers_(questions_.size()),
      teller_(phrases, buttons, texts()) {}

Taught Questionnaire::update(const Observation& seen, double time) {
  time_ = time;
  teller_.hands(seen.devices.keyboard);
  if (!begun_) {
    begun_ = true;
    teller_.tell(key("welcome"));
    go_to(0);
  }
  if (!finished_) {
    for (const Button button : seen.pressed) obey(button);
    !all_asked() && questions_[at_].point ? point(seen.stick) : lean(seen.stick);
  }
  Taught taught;
  taught.cues = teller_.update(!seen.voice_busy);
  const bool silent = teller_.done() && !seen.voice_busy && taught.cues.empty();
  if (!heard_ && silent) heard_ = time;
  over_ = finished_ && silent;
  return taught;
}

void Questionnaire::obey(Button button) {
  switch (button) {
    case Button::previous:
    case Button::next:
      return change(button == Button::previous);
    case Button::choose:
    case Button::start:
      if (all_asked()) {
        finished_ = true;
        return teller_.tell(key("end"));
      }
      return confirm();
    case Button::back:
      teller_.forget();
      return go_to(at_ == 0 ? 0 : at_ - 1);
    case Button::repeat:
      teller_.forget();
      return tell();
    case Button::end:
      if (all_asked()) return;
      answers_[at_].chosen.reset();
      answers_[at_].degrees.reset();
      teller_.tell(key("declined"));
      return give(kDeclined);
    default:
      return;
  }
}

/// The stick up or down is a press of more or less, again and again while it is held.
void Questionnaire::lean(const drive::Stick& stick) {
  if (std::abs(stick.y) < kRest) leans_ = false;
  if (std::abs(stick.y) < kPushed || (leans_ && time_ - leaned_ < kEvery)) return;
  leans_ = true;
  leaned_ = time_;
  change(stick.y > 0.0);
}

void Questionnaire::point(const drive::Stick& stick) {
  leans_ = true;  // while it stays pushed it takes no step of a question that follows, either
  leaned_ = std::numeric_limits<double>::infinity();
  const auto direction = pointing_.update(stick, time_);
  if (!direction) return;
  Answer& answer = answers_[at_];
  answer.degrees = direction->degrees;
  answer.reaction = heard_ ? std::max(0.0, direction->pushed - *heard_) : 0.0;
  if (!heard_) heard_ = time_;  // the words are cut
  tell_pointed(true);
}

void Questionnaire::tell_pointed(bool at_once) {
  const double clockwise = -*answers_[at_].degrees * cues::kDegree;
  const int hour = *cues::clock_hour(clockwise, cues::Rounding::nearest);
  const Teller::Fillings fillings{{"way", teller_.phrases().way(hour)}};
  at_once ? teller_.tell(key("pointed"), fillings) : teller_.then(key("pointed"), fillings);
}

void Questionnaire::confirm() {
  Answer& answer = answers_[at_];
  if (questions_[at_].point) {
    if (!answer.degrees) return teller_.tell(key("point_first"));
    give(std::to_string(*answer.degrees));
    answer.seconds = answer.reaction;
    return;
  }
  if (answer.chosen) return give(questions_[at_].values[*answer.chosen]);
  teller_.tell(key("choose_first"));
}

void Questionnaire::change(bool more) {
  if (all_asked() || questions_[at_].point) return;
  const std::size_t last = questions_[at_].values.size() - 1;
  std::optional<std::size_t>& chosen = answers_[at_].chosen;
  if (!chosen) {
    chosen = last % 2 == 0 ? last / 2 : last / 2 + (more ? 1 : 0);  // from the middle
  } else if (more ? *chosen < last : *chosen > 0) {
    chosen = more ? *chosen + 1 : *chosen - 1;
  }
  teller_.tell(key("chosen"), {{"text", questions_[at_].spoken[*chosen]}});
}

void Questionnaire::give(const std::string& answer) {
  if (answers_[at_].given != answer) answers_[at_].seconds = time_ - asked_;
  answers_[at_].given = answer;
  go_to(at_ + 1);
}

void Questionnaire::go_to(std::size_t question) {
  at_ = question;
  asked_ = time_;
  heard_.reset();
  pointing_ = Pointing();
  tell();
}

void Questionnaire::tell() {
  if (all_asked()) return teller_.then(key("last"));
  teller_.then(key("read"), {{"text", questions_[at_].ask}});
  if (answers_[at_].degrees) tell_pointed(false);
  if (const auto chosen = answers_[at_].chosen)
    teller_.then(key("chosen"), {{"text", questions_[at_].spoken[*chosen]}});
}

std::string Questionnaire::record() const {
  std::string table = "item,answer,seconds\n";
  for (std::size_t i = 0; i < questions_.size(); ++i) {
    if (answers_[i].given.empty()) continue;
    table += questions_[i].name + "," + answers_[i].given + "," +
             navvi_files::fixed(answers_[i].seconds, 1) + "\n";
  }
  return table;
}

}  // namespace navvi_feedback::lessons
