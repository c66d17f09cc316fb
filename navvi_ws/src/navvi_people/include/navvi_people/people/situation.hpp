#pragma once

#include <optional>

#include "navvi_people/people/ears.hpp"

namespace navvi_people::people {

/// What a person is about to do, and has in mind of what was told. Signals and words change it by
/// these events; what the hand does, and an ear or a skin takes in, is decided elsewhere:
///
/// | event            | mode                         | course                         | besides       |
/// |------------------|------------------------------|--------------------------------|---------------|
/// | `hear_tick`      | waiting -> driving *         |                                | ticks, news   |
/// | `end_ticks`      | turning, driving -> driving  | as headed, goes on, cruise     | news          |
/// | `keep_course`    |                              | goes on                        | news          |
/// | `change_way`     |                              | ends soon, if driving          |               |
/// | `stand`          | all but backing -> waiting   |                                | careful       |
/// | `turn`           | turning                      | the turn, then the distance    | last turn     |
/// | `go`             | turning or driving           | as headed when told, distance  |               |
/// | `expect_turn`    |                              | ends at the turn, if driving   |               |
/// | `shy_away`       |                              | veers; off what is very close  | careful       |
/// | `back_off`       | backing, waiting from behind | as headed, then veers          | careful       |
/// | `wait_for_go_on` |                              |                                | waits         |
/// | `ask_soon`       | waiting                      |                                | news, long ago|
/// | `try_ahead`      | driving                      | as headed, that far, slow      |               |
///
/// * unless told to halt. Times are s, on the clock of SimulatedOperator::update().
struct Situation {
  enum class Mode { waiting, turning, driving, backing, arrived };
  using Side = Instruction::Side;
  /// The ticks that tell to turn.
  struct Ticks {
    Side side = Side::none;
    double last = 0.0;
    bool much = true;  ///< is left to turn
  };
  struct Course {
    double target = 0.0;           ///< rad, heading to hold
    double stop_at = 0.0;          ///< m on the odometer: further is guessing
    bool straight_before = false;  ///< the last direction that was followed was 12
    double speed = 0.0;            ///< stick
    double turn_speed = 0.0;
    double veer = 0.0;  ///< rad, added to the target
    double veer_until = 0.0;
  };
  /// The last turn by words.
  struct Turned {
    std::optional<double> to = {};  ///< rad, clockwise
    double at = -1e9;
  };

  static constexpr double kTrust = 10.0;       ///< m, driven on without a word after ticks; assumed
  static constexpr double kNearTheEnd = 1.5;   ///< m to where one expects to stop
  static constexpr double kListenFirst = 2.5;  ///< m, likewise
  static constexpr double kShortly = 5.0;      ///< s; what is told after a turn is the rest of it

  double cruise = 0.0;         ///< stick, liked
  double idle_patience = 0.0;  ///< s, of silence while waiting before asking

  Mode mode = Mode::waiting;
  Belief at = {};
  Course course = {};
  Turned turned = {};
  std::optional<Ticks> ticks = {};
  double ticks_led = -1e9;      ///< when they last led a turn
  std::optional<double> waits = {};  ///< since when for "go on"
  bool told_to_halt = false;
  bool spoken_to = false;
  std::optional<double> start = {};  ///< of all
  double news = 0.0;            ///< the last
  double asked = -1e9;
  double shown = -1e9;    ///< what leads all the time, last
  double pressed = -1e9;  ///< start
  double bumped = -1e9;
  double careful_until = 0.0;
  double backs_until = 0.0;
  bool off_left = false;  ///< after the last bump into nobody knows what
  bool pulled = false;    ///< the stick was moved last to drive back

  /// \param much  is left to turn; nullopt: as slow ticks tell
  void hear_tick(Side side, std::optional<bool> much, double time);
  void end_ticks(double time);
  void keep_course(double time);
  void change_way();
  void stand(double time);
  /// \param angle  rad, clockwise, as told \return rad, to turn: back from where one has just
  /// turned, by less
  [[nodiscard]] double begin_turn(double angle, double time);
  /// \param angle  of begin_turn() \param made  rad, clockwise, as the robot will turn
  void turn(const Sentence& sentence, const Instruction& told, double angle, double made);
  void go(const Sentence& sentence, const Instruction& told);
  void expect_turn(const Sentence& sentence, const Instruction& told);
  void shy_away(Side side, bool very_close, double time);
  void back_off(Side side, double time);
  void wait_for_go_on(const Sentence& sentence);
  void ask_soon(double time);
  /// \param way  m
  void try_ahead(double way = 0.5 * kTrust);
  /// Words and taps ask for it at about the same time.
  void press_start(double time);

  /// No word to wait changes that.
  [[nodiscard]] bool busy() const { return mode == Mode::backing || mode == Mode::arrived; }
  /// m, to where one expects to stop
  [[nodiscard]] double left() const { return course.stop_at - at.odometer; }
  [[nodiscard]] bool shown_lately(double time) const;
  /// rad, clockwise, of a turn: 1 or 11 after straight on is an edge that was just passed
  [[nodiscard]] double angle_of(const Instruction& told) const;

 private:
  void go_for(const Sentence& sentence, const Instruction& told);
  void veer(Side side, double angle, double until);
};

}  // namespace navvi_people::people
