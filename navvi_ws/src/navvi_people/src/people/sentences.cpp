// What a simulated person makes of words: of the first ones of a sentence, and of all of it.

#include <algorithm>
#include <cmath>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {

void SimulatedOperator::hear_words(const Speech& speech, double time) {
  if (!config_.hearing.words) return;
  switch (speech.moment) {
    case Speech::Moment::begins:
      now_.spoken_to = true;
      return ears_.begins(speech, now_.at, time);
    case Speech::Moment::breaks_off:
      return ears_.breaks_off(speech.id);
    case Speech::Moment::ends:
      return understood(speech.id, time);
  }
}

void SimulatedOperator::understood(std::uint32_t id, double time) {
  const Sentence* const sentence = ears_.ends(id, attention_.elsewhere(time), time);
  if (sentence == nullptr) return;
  // A thing nearby, or a later turn, is no news while waiting for a direction.
  const auto idle = [](const Instruction& part) {
    return part.asks == Ask::beware || part.asks == Ask::turn_ahead;
  };
  if (now_.mode != Mode::waiting ||
      !std::all_of(sentence->parts.begin(), sentence->parts.end(), idle))
    now_.news = time;
}

void SimulatedOperator::be_startled(double time) {
  constexpr double kStartled = 0.4;  // s, from a word to the hand
  for (const auto& [id, sentence] : ears_.begun()) {
    const double heard = (time - sentence.begun - kStartled) * kLettersPerSecond;
    const Listener::FirstWord word = ears_.listener().first_word(sentence.text, heard);
    if (now_.mode == Mode::arrived || heard <= 0.0 || !word.startles) continue;
    now_.mode = Mode::waiting;
    if (word.holds) now_.wait_for_go_on(sentence);
  }
}

void SimulatedOperator::react(const Sentence& sentence, double time) {
  const std::vector<Instruction>& parts = sentence.parts;
  if (!parts.empty() && parts.front().holds) now_.wait_for_go_on(sentence);
  if (!parts.empty() && parts.front().goes_on && now_.waits && sentence.begun > *now_.waits)
    now_.waits.reset();
  // Where a display leads, its end is to stand, whatever direction is told besides.
  const bool shown = now_.shown_lately(time);
  for (const Instruction& part : parts) {
    const bool leads = part.asks == Ask::turn || part.asks == Ask::go;
    if (!(leads && (now_.waits || shown))) obey(sentence, part, time);
  }
}

void SimulatedOperator::obey(const Sentence& sentence, const Instruction& told, double time) {
  switch (told.asks) {
    case Ask::nothing:
      break;
    case Ask::ready:
      now_.told_to_halt = false;
      break;
    case Ask::turn:
      now_.told_to_halt = false;
      // Ticks lead this turn whether or not the words are kept in mind.
      if (memory_.keeps(config_.driving.cruise, time)) turn_to(sentence, told, time);
      break;
    case Ask::go:
      now_.told_to_halt = false;
      now_.go(sentence, told);
      break;
    case Ask::turn_ahead:
      now_.expect_turn(sentence, told);
      break;
    case Ask::beware:
      if (told.side == Instruction::Side::ahead && now_.mode == Mode::driving) now_.ask_soon(time);
      now_.shy_away(told.side, told.very_close, time);
      break;
    case Ask::back:
      now_.told_to_halt = true;
      now_.back_off(told.side, time);
      break;
    case Ask::halt:
      now_.told_to_halt = true;
      now_.mode = Mode::waiting;
      break;
    case Ask::begin:
      now_.press_start(time);
      break;
    case Ask::rest:
      now_.mode = Mode::arrived;
      break;
  }
}

void SimulatedOperator::turn_to(const Sentence& sentence, const Instruction& told, double time) {
  const Situation::Turned before = now_.turned;
  const double asked = now_.angle_of(told);
  if (before.to && sentence.begun > before.at && sentence.begun - before.at < Situation::kShortly)
    learning_.turned(*before.to, asked);
  const double angle = now_.begin_turn(asked, time);
  const double learnt = std::copysign(learning_.bias(), angle);
  now_.turn(sentence, told, angle, turning_.made((angle + learnt) * driving_.turn_gain()));
}

}  // namespace navvi_people::people
