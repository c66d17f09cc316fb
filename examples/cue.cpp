// A cue in words: example_cue FILE prints what the voice of a phrase file says.
#include <cstdio>

#include "cues/phrases.hpp"

int main(int argc, char** argv) {
  using namespace navvi_feedback::cues;
  const Phrases phrases(argc > 1 ? argv[1] : "navvi_ws/src/navvi_feedback/config/phrases/en.yaml");
  Fillings turn;
  turn.hour = 3;
  turn.distance = 2.0;  // m
  std::puts(phrases.say(navvi_types::CueKind::turn_now, turn).c_str());
  Fillings near;
  near.thing = navvi_types::ThingClass::forklift;
  near.side = Side::left;
  std::puts(phrases.say(navvi_types::CueKind::near, near).c_str());
}
