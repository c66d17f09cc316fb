#include "devices/earcons.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace navvi_feedback::devices {
namespace {

constexpr double kLowest = 0.5;  // times the pitch of full speed: an octave down, at rest

constexpr double kTwoPi = 6.28318530717958647692;
constexpr int kRate = 44100;       // Hz
constexpr double kAttack = 0.003;  // s

enum class Voicing {
  flute,  ///< a sine and a little of its octave: it holds
  bell,   ///< the same, dying away
  horn,   ///< odd partials, as a warning horn: it holds
  clang,  ///< partials of struck metal, dying away
  drone,  ///< a motor's hum, without ends: to be repeated
  knock   ///< low and short, as on wood
};

struct Note {
  Voicing voicing;
  double from;     ///< Hz
  double to;       ///< Hz, where it glides
  double seconds;  ///< 0 Hz: a rest
};

/// A partial's multiple of the note's frequency, and its share.
using Partials = std::vector<std::array<double, 2>>;

const Partials& partials(Voicing voicing) {
  static const Partials flute = {{1.0, 0.85}, {2.0, 0.15}};
  static const std::map<Voicing, Partials> others = {
      {Voicing::horn, {{1.0, 0.6}, {3.0, 0.25}, {5.0, 0.15}}},
      {Voicing::clang, {{1.0, 0.3}, {2.76, 0.3}, {5.4, 0.25}, {8.93, 0.15}}},
      {Voicing::drone, {{0.5, 0.2}, {1.0, 0.35}, {2.0, 0.2}, {3.0, 0.15}, {5.0, 0.1}}},
      {Voicing::knock, {{1.0, 0.7}, {1.6, 0.3}}}};
  const auto found = others.find(voicing);
  return found != others.end() ? found->second : flute;
}

std::vector<Note> notes(sounds::Earcon earcon) {
  using sounds::Earcon;
  using V = Voicing;
  constexpr Note kRest = {V::flute, 0.0, 0.0, 0.05};
  const auto twice = [&](std::vector<Note> once) {
    const std::vector<Note> again = once;
    once.push_back(kRest);
    once.insert(once.end(), again.begin(), again.end());
    return once;
  };
  switch (earcon) {
    case Earcon::turn:
      return {{V::flute, 700.0, 700.0, 0.05}};
    case Earcon::turn_click:
      return {{V::flute, 4000.0, 4000.0, 0.01}};
    case Earcon::turn_stop:
      return {{V::bell, 1568.0, 1568.0, 0.07}, {V::bell, 1046.5, 1046.5, 0.2}};
    case Earcon::on_course:
      return {{V::bell, 240.0, 240.0, 0.15}};
    case Earcon::hit_shelf:
      return {{V::clang, 220.0, 210.0, 0.45}};
    case Earcon::hit_obstacle:
      return twice({{V::knock, 130.0, 80.0, 0.12}});
    case Earcon::shelf_near:
      return {{V::clang, 620.0, 620.0, 0.12}};
    case Earcon::worker_near:  // a whistle
      return {{V::flute, 900.0, 1500.0, 0.12}, {V::flute, 1500.0, 1100.0, 0.12}};
    case Earcon::forklift_near:
      return {{V::horn, 1000.0, 1000.0, 0.3}};
    case Earcon::pallet_robot_near:  // three steps down
      return {{V::flute, 2000.0, 2000.0, 0.05},
              {V::flute, 1500.0, 1500.0, 0.05},
              {V::flute, 1000.0, 1000.0, 0.05}};
    case Earcon::thing_near:
      return {{V::knock, 420.0, 380.0, 0.1}};
    case Earcon::shelf_close:
    case Earcon::worker_close:
    case Earcon::forklift_close:
    case Earcon::pallet_robot_close:
    case Earcon::thing_close:
      return twice(notes(static_cast<Earcon>(static_cast<int>(earcon) - 1)));
    case Earcon::arrived:
      return {{V::bell, 523.3, 523.3, 0.12},
              {V::bell, 659.3, 659.3, 0.12},
              {V::bell, 784.0, 784.0, 0.12},
              {V::bell, 1046.5, 1046.5, 0.35}};
    case Earcon::beacon:
      return {{V::bell, 880.0, 880.0, 0.08}};
    case Earcon::flow:
      return {{V::drone, 220.0, 220.0, 1.0}};
    case Earcon::unsaid:  // as a mumbled word
      return {{V::horn, 330.0, 262.0, 0.15}, kRest, {V::horn, 330.0, 196.0, 0.3}};
  }
  return {};
}

double loudness(const Note& note, double time) {
  if (note.voicing == Voicing::drone) return 0.3;
  const bool dies = note.voicing != Voicing::flute && note.voicing != Voicing::horn;
  const double edges = std::min({1.0, time / kAttack, (note.seconds - time) / kAttack});
  return edges * (dies ? std::exp(-4.0 * time / note.seconds) : 1.0);
}

}  // namespace

EarconPlayer::EarconPlayer(Mixer& mixer) : mixer_(mixer) {
  for (std::size_t i = 0; i < names(sounds::Earcon{}).size(); ++i) {
    const auto earcon = static_cast<sounds::Earcon>(i);
    sounds_[earcon] = synthesize(earcon);
  }
}

std::vector<sounds::Play> EarconPlayer::play(const std::vector<sounds::Play>& plays) {
  std::vector<sounds::Play> heard;
  for (const sounds::Play& play : plays)
    if (mixer_.play(sounds_.at(play.earcon), play.volume, play.from)) heard.push_back(play);
  return heard;
}

bool EarconPlayer::hold(const haptics::Rumble& flow, double volume) {
  const double sum = flow.left + flow.right;
  if (sum <= 0.0) return mixer_.hold(sounds_.at(sounds::Earcon::flow), 0.0, 1.0, 0.0);
  return mixer_.hold(sounds_.at(sounds::Earcon::flow), volume, kLowest + (1.0 - kLowest) * sum,
                     (flow.left - flow.right) / sum);
}

Sound synthesize(sounds::Earcon earcon) {
  Sound sound;
  sound.rate = kRate;
  for (const Note& note : notes(earcon)) {
    const auto count = static_cast<std::size_t>(note.seconds * kRate);
    double phase = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double time = static_cast<double>(i) / kRate;
      double value = 0.0;
      if (note.from > 0.0)
        for (const auto& [multiple, share] : partials(note.voicing))
          value += share * std::sin(multiple * phase);
      phase += kTwoPi * (note.from + (note.to - note.from) * time / note.seconds) / kRate;
      sound.samples.push_back(
          static_cast<std::int16_t>(std::lround(32000.0 * loudness(note, time) * value)));
    }
  }
  return sound;
}

}  // namespace navvi_feedback::devices
