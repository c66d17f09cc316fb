// What a simulated person makes of short sounds, and of rows of pulses in the hand.

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::people {

constexpr double kOffAhead = 0.5;  // m, away from what holds a robot that was driven back

void SimulatedOperator::react(const Tone& tone, double time) {
  switch (tone.earcon) {
    case Earcon::turn:
    case Earcon::turn_click:
      return now_.hear_tick(tone.side, tone.much, time);
    case Earcon::on_course:
      return now_.keep_course(time);
    case Earcon::turn_stop:
      return now_.end_ticks(time);
    case Earcon::hit_shelf:
    case Earcon::hit_obstacle:
      if (!now_.busy()) now_.mode = Mode::waiting;
      return;
    case Earcon::shelf_near:
    case Earcon::worker_near:
    case Earcon::forklift_near:
    case Earcon::pallet_robot_near:
    case Earcon::thing_near:
      return now_.shy_away(tone.side, false, time);
    case Earcon::shelf_close:
    case Earcon::worker_close:
    case Earcon::forklift_close:
    case Earcon::pallet_robot_close:
    case Earcon::thing_close:
      return now_.shy_away(tone.side, true, time);
    case Earcon::arrived:
    case Earcon::beacon:
    case Earcon::unsaid:
    case Earcon::flow:
      return;
  }
}

void SimulatedOperator::react(Meaning meaning, double time) {
  if (now_.mode == Mode::arrived) return;
  // Where nothing is said, the lesson has taught to drive off a little from what holds the robot.
  const bool untold = config_.lead == "hand" && !ears_.listen();
  switch (meaning) {
    case Meaning::none:
      return;
    case Meaning::stuck:
      if (!untold) return;
      if (now_.pulled) return now_.try_ahead(kOffAhead);
      return now_.back_off(Instruction::Side::none, time);
    case Meaning::ready:
      // Once under way, what feels like it is something else.
      if (now_.at.odometer == 0.0) now_.press_start(time);
      return;
    case Meaning::begun:
      now_.told_to_halt = false;
      now_.news = time;
      return;
    case Meaning::new_way:
      // The old direction no longer holds; there is a word or a pull to wait for.
      return now_.change_way();
    case Meaning::hit:
      if (untold) return now_.back_off(Instruction::Side::none, time);
      [[fallthrough]];
    case Meaning::halt:
    case Meaning::stop:
      return now_.stand(time);
    case Meaning::arrived:
      now_.mode = Mode::arrived;
      return;
  }
}

}  // namespace navvi_people::people
